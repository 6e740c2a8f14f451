#include "core/system/file_watch.h"

#include "core/system/files.h"
#include "core/system/locks.h"

#include <chrono>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::vector<FileTrace> traces_of(const std::vector<fs::path>& files) {
  std::vector<FileTrace> traces;
  for (const fs::path& file : files) traces.push_back(trace_of(file));
  return traces;
}

constexpr auto look_interval = 200ms, settling = 50ms;
constexpr int longest_patience = 20;  // moments in which a file is written again and again

}  // namespace

struct FileWatch::State {
  std::vector<fs::path> files;
  std::function<void()> on_change;
  std::vector<FileTrace> seen;
  Mutex mutex;
  Condition wake;
  bool leaves = false;  ///< guarded by the mutex
  std::thread thread;

  void look_on() {
    int moments = 0;  // since a change that was not told of yet; 0: there is none
    for (std::unique_lock lock(mutex); !leaves;) {
      wake.wait_for(lock, moments > 0 ? settling : look_interval, [this] { return leaves; });
      if (leaves) return;
      lock.unlock();
      std::vector<FileTrace> now = traces_of(files);
      const bool changed = now != std::exchange(seen, now);
      if (moments > 0 && (!changed || moments >= longest_patience)) {
        moments = 0;
        on_change();
      } else if (changed) {
        ++moments;
      }
      lock.lock();
    }
  }
};

FileWatch::FileWatch(const std::vector<fs::path>& files, std::function<void()> on_change)
    : state_(std::make_unique<State>()) {
  std::error_code error;
  for (const fs::path& file : files) state_->files.push_back(fs::absolute(file, error));
  state_->on_change = std::move(on_change);
  state_->seen = traces_of(state_->files);
  state_->thread = std::thread([state = state_.get()] { state->look_on(); });
}

FileWatch::~FileWatch() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->leaves = true;
  }
  state_->wake.notify_all();
  state_->thread.join();
}

}  // namespace tyndall
