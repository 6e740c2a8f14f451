#include "core/system/file_watch.h"

#include <sys/stat.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// What changes with a file: which one it is, its size, and when its bytes, name or mode were changed last.
using Trace = std::array<std::int64_t, 7>;

/// Zeros where there is no file.
Trace trace_of(const fs::path& file) {
  struct stat s {};
  if (stat(file.c_str(), &s) != 0) return {};
  return {static_cast<std::int64_t>(s.st_dev),
          static_cast<std::int64_t>(s.st_ino),
          s.st_size,
          s.st_mtim.tv_sec,
          s.st_mtim.tv_nsec,
          s.st_ctim.tv_sec,
          s.st_ctim.tv_nsec};
}

std::vector<Trace> traces_of(const std::vector<fs::path>& files) {
  std::vector<Trace> traces;
  for (const fs::path& file : files) traces.push_back(trace_of(file));
  return traces;
}

constexpr auto look_interval = 200ms, settling = 50ms;
constexpr int longest_patience = 20;  // moments in which a file is written again and again

}  // namespace

struct FileWatch::State {
  std::vector<fs::path> files;
  std::function<void()> on_change;
  std::vector<Trace> seen;
  std::mutex mutex;
  std::condition_variable wake;
  bool leaves = false;  ///< guarded by the mutex
  std::thread thread;

  void look_on() {
    int moments = 0;  // since a change that was not told of yet; 0: there is none
    for (std::unique_lock lock(mutex); !leaves;) {
      wake.wait_for(lock, moments > 0 ? settling : look_interval, [this] { return leaves; });
      if (leaves) return;
      lock.unlock();
      std::vector<Trace> now = traces_of(files);
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
