#pragma once
#include "core/system/locks.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

/// Threads that share work.
namespace tyndall {

inline constexpr int max_threads = 4096;  ///< the largest number that options and the window accept

/// A fixed set of threads that run one job at a time: a function that is called for each index below a count.
class ThreadPool {
 public:
  /// size: number of threads; 0: see thread_count(). Throws IoError, which names the limit, if the system does not
  /// allow so many threads.
  explicit ThreadPool(int size);
  ~ThreadPool();

  int size() const { return static_cast<int>(threads_.size()); }

  /// Calls job(i) once for each i in [0, count) on the pool's threads, and returns when all calls have returned. If a
  /// call throws, no further calls begin, and the first exception is thrown here when all have returned. Only one call
  /// of for_each() at a time, and none from within a job. poll: if given, is called on the calling thread every 50 ms.
  void for_each(int count, const std::function<void(int)>& job, const std::function<void()>& poll = {});

 private:
  void work();
  void stop();

  Mutex mutex_;
  Condition wake_, done_;
  bool stops_ = false;
  const std::function<void(int)>* job_ = nullptr;
  int count_ = 0, busy_ = 0;
  std::uint64_t round_ = 0;
  std::atomic<int> next_ = 0;
  std::exception_ptr failure_;         ///< what a job of this round threw first
  std::vector<JoinedThread> threads_;  // declared last, so that the threads end before what they use goes
};

/// Returns the pointer in which jobs keep memory on the calling pool thread from one job to the next; null at first.
/// Only one kind of job may use it. (A thread_local with a destructor would end the program where there is no memory to
/// register the destructor.)
std::shared_ptr<void>& thread_pool_memory();

}  // namespace tyndall
