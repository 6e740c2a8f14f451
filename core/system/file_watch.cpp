#include "core/system/file_watch.h"

#include "core/system/files.h"
#include "core/system/locks.h"

#include <chrono>
#include <mutex>
#include <optional>
#include <system_error>
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
  StoppableCondition wake;
  std::optional<StoppableThread> thread;  // declared last, because it uses the others

  void look_on(const StopToken& stop) {
    int moments = 0;  // since a change that was not told of yet; 0: there is none
    for (std::unique_lock lock(mutex);;) {
      wake.wait_for(lock, stop, moments > 0 ? settling : look_interval, [] { return false; });
      if (stop.stop_requested()) return;
      std::vector<FileTrace> now = traces_of(files);
      const bool changed = now != std::exchange(seen, now);
      if (moments > 0 && (!changed || moments >= longest_patience)) {
        moments = 0;
        on_change();
      } else if (changed) {
        ++moments;
      }
    }
  }
};

FileWatch::FileWatch(const std::vector<fs::path>& files, std::function<void()> on_change)
    : state_(std::make_unique<State>()) {
  std::error_code error;
  for (const fs::path& file : files) state_->files.push_back(fs::absolute(file, error));
  state_->on_change = std::move(on_change);
  state_->seen = traces_of(state_->files);
  state_->thread.emplace([state = state_.get()](const StopToken& stop) { state->look_on(stop); });
}

FileWatch::~FileWatch() = default;

}  // namespace tyndall
