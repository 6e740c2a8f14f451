#pragma once
#include "core/film/film.h"
#include "core/image/image.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

/// Keeps the work of long renders: their film is written now and then, so that what kills the program or the machine
/// costs one interval, not the render.
namespace tyndall {

/// Without an interval of the user's, checkpoints are this far apart at least, seconds; and at least so many times the
/// time that the last one took: then they take at most 1 % of the time.
inline constexpr double least_checkpoint_interval = 30, checkpoint_interval_over_cost = 100;

/// Writes checkpoints into one file. All functions are called on one thread.
class Checkpoints {
 public:
  /// interval: seconds; absent: as above. embedded: what the file carries beside a film; called in the background.
  Checkpoints(std::filesystem::path file, std::optional<double> interval,
              std::function<Embedded(const Film&)> embedded);
  ~Checkpoints();  ///< waits for the one that is being written
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  const std::filesystem::path& file() const { return file_; }
  /// Whether one is to be taken now: the interval is over, and the last one is written.
  bool due() const;
  /// Copies the film and begins to write the copy in the background. The memory of the copy is kept for the next one.
  /// Where there is no memory for it, the film itself is written before this returns.
  void take(const Film& film);
  /// Waits until the last one is written, and gives the memory of the copy back.
  void finish();
  /// What went wrong since the last call, once for each reason. A failed checkpoint leaves the one before it.
  std::optional<std::string> problem();

 private:
  using Clock = std::chrono::steady_clock;
  bool write_in_background(const Film& film);
  void write(const Film& film);
  void note(const char* problem);

  std::filesystem::path file_;
  std::optional<double> interval_;
  std::function<Embedded(const Film&)> embedded_;
  Film copy_;
  std::thread writer_;
  std::atomic<bool> writing_ = false;
  Clock::time_point taken_ = Clock::now();  ///< when the last one was taken, at first the start
  std::atomic<double> cost_ = 0;            ///< seconds that the last one took
  std::mutex mutex_;
  std::string problem_, last_problem_;  ///< guarded by mutex_
};

}  // namespace tyndall
