#pragma once
#include "core/base/seconds.h"
#include "core/base/thread_pool.h"
#include "core/film/film.h"
#include "core/image/image.h"
#include "core/system/locks.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

/// Keeps the work of long renders: their film is written now and then, so that what kills the program or the machine
/// costs one interval, not the render.
namespace tyndall {

/// Writes checkpoints into one file. All functions are called on one thread.
///
/// What a kill costs is at most one interval: the time from a film's copy to the moment at which the copy of a later
/// one is on the disk. So each checkpoint begins earlier than that by twice what the slowest one took. Half of the
/// interval is left for writing at most, and for the first one, of which nothing is known (but 30 s pass before it
/// where nobody asks for an interval: short renders are not to pay for it). Where writing takes longer than that half,
/// a kill can cost twice what writing takes; that is told as a problem.
class Checkpoints {
 public:
  /// interval: seconds; absent: 30, or more where checkpoints would take more than 1 % of the time. embedded: what the
  /// file carries beside a film; called in the background.
  Checkpoints(std::filesystem::path file, std::optional<double> interval,
              std::function<Embedded(const Film&)> embedded);
  ~Checkpoints() { finish(); }  ///< waits for the one that is being written

  const std::filesystem::path& file() const { return file_; }
  /// Whether one is to be begun now, so that it is written when the interval is over. False while one is written.
  bool due() const;
  /// Copies the film, with all threads, and begins to write the copy in the background. The memory of the copy is kept
  /// for the next one. Where there is no memory for it, the film itself is written before this returns.
  void take(const Film& film, ThreadPool& thread_pool);
  /// Waits until the last one is written, and gives the memory of the copy back.
  void finish();
  /// What went wrong since the last call, once for each reason. A failed checkpoint leaves the one before it.
  std::optional<std::string> problem();

 private:
  void write(const Film& film);
  void note(const char* what, const char* why);

  std::filesystem::path file_;
  std::optional<double> interval_;
  std::function<Embedded(const Film&)> embedded_;
  Film copy_;
  std::optional<JoinedThread> writer_;
  std::atomic<bool> writing_ = false;       ///< the writer has what follows, but taken_
  Clock::time_point taken_ = Clock::now();  ///< when the last one was taken, at first the start
  double cost_ = 0, slowest_ = 0;           ///< seconds that the last one and the slowest one took; 0 before the first
  bool slow_ = false;                       ///< whether it was told that they take too long
  std::string problem_, last_problem_;
};

}  // namespace tyndall
