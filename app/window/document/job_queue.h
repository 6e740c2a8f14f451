#pragma once
#include "core/system/locks.h"

#include <deque>
#include <functional>
#include <vector>

/// Work in the background.
namespace tyndall {

/// Work that must not stop the window: jobs run one after another on a thread of their own, and what they return is
/// called by the main thread.
class JobQueue {
 public:
  using Result = std::function<void()>;
  using Job = std::function<Result()>;  ///< must not throw

  /// on_result: called from the thread when a result waits; must be quick.
  explicit JobQueue(std::function<void()> on_result);
  /// Finishes the jobs that are waiting; their results are dropped.
  ~JobQueue();

  void run(Job job);
  /// Calls the results that have come; whether there were any. For the main thread.
  bool collect();
  /// Whether the results of all jobs were collected. For the main thread.
  bool idle() const { return open_ == 0; }
  /// Jobs whose results were not collected. For the main thread.
  std::size_t open() const { return open_; }

 private:
  void work(const StopToken& stop);

  std::function<void()> on_result_;
  Mutex mutex_;
  StoppableCondition wake_;
  std::deque<Job> jobs_;
  std::vector<Result> results_;
  std::size_t open_ = 0;    ///< jobs whose results were not collected; the main thread's
  StoppableThread thread_;  // declared last, because it uses the others
};

}  // namespace tyndall
