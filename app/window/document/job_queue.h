#pragma once
#include "core/system/locks.h"

#include <chrono>
#include <deque>
#include <functional>
#include <vector>

/// Work in the background.
namespace tyndall {

/// A thread of its own for one piece of work, which is done each time when somebody asks for it, also where that was
/// just before the end.
class BackgroundThread {
 public:
  using Time = std::chrono::milliseconds;

  /// work: returns when it is to be done again though nobody asks; must not throw. pause: least time from one time to
  /// the next.
  explicit BackgroundThread(std::function<Time()> work, Time pause = {});
  ~BackgroundThread();
  void ask();

  static constexpr Time never = std::chrono::hours(10000);

 private:
  Mutex mutex_;
  Condition wake_;
  bool due_ = false;  ///< somebody asked for the work
  bool stops_ = false;
  JoinedThread thread_;  // declared last, because it uses the others
};

/// Work that must not stop the window: jobs run one after another on a thread of their own, and what they return is
/// called by the main thread. The end of the queue waits for all jobs and drops their results.
class JobQueue {
 public:
  using Result = std::function<void()>;
  using Job = std::function<Result()>;  ///< must not throw

  /// on_result: called from the thread when a result waits; must be quick.
  explicit JobQueue(std::function<void()> on_result);

  void run(Job job);
  /// Calls the results that have come; whether there were any. For the main thread.
  bool collect();
  /// Whether the results of all jobs were collected. For the main thread.
  bool idle() const { return open_ == 0; }
  /// Jobs whose results were not collected. For the main thread.
  std::size_t open() const { return open_; }

 private:
  BackgroundThread::Time work();

  std::function<void()> on_result_;
  Mutex mutex_;
  std::deque<Job> jobs_;
  std::vector<Result> results_;
  std::size_t open_ = 0;         ///< jobs whose results were not collected; the main thread's
  BackgroundThread background_;  // declared last, because it uses the others
};

}  // namespace tyndall
