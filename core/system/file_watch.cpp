#include "core/system/file_watch.h"

#include <chrono>
#include <mutex>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto look_interval = 200ms, settling = 50ms;
constexpr int longest_patience = 20;  // moments in which a file is written again and again

std::vector<fs::path> absolute(std::vector<fs::path> files) {
  std::error_code error;
  for (fs::path& file : files) file = fs::absolute(file, error);
  return files;
}

}  // namespace

FileWatch::FileWatch(const std::vector<fs::path>& files, std::function<void()> on_change)
    : files_(absolute(files)), on_change_(std::move(on_change)), seen_(traces()), thread_([this] { look_on(); }) {}

FileWatch::~FileWatch() {
  const std::lock_guard lock(mutex_);
  stops_ = true;
  wake_.notify_one();
}

std::vector<FileTrace> FileWatch::traces() const {
  std::vector<FileTrace> traces;
  for (const fs::path& file : files_) traces.push_back(trace_of(file));
  return traces;
}

void FileWatch::look_on() {
  int moments = 0;  // since a change that was not told of yet; 0: there is none
  for (std::unique_lock lock(mutex_);;) {
    wake_.wait_for(lock, moments > 0 ? settling : look_interval, [this] { return stops_; });
    if (stops_) return;
    std::vector<FileTrace> now = traces();
    const bool changed = now != std::exchange(seen_, now);
    if (moments > 0 && (!changed || moments >= longest_patience)) {
      moments = 0;
      on_change_();
    } else if (changed) {
      ++moments;
    }
  }
}

}  // namespace tyndall
