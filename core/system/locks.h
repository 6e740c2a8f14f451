#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>
#ifdef _WIN32
#include <algorithm>
#include <chrono>
#include <limits>
#endif

/// Locks of threads: the standard library's, but on Windows the system's own. There the library's are those of
/// winpthreads, whose conditions now and then let a thread sleep that was woken.
namespace tyndall {

#ifdef _WIN32

class Mutex {
 public:
  Mutex() = default;
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;
  void lock();
  void unlock();

 private:
  friend class Condition;
  void* lock_ = nullptr;  // an SRWLOCK, which is a pointer and begins as 0
};

class Condition {
 public:
  Condition() = default;
  Condition(const Condition&) = delete;
  Condition& operator=(const Condition&) = delete;
  void notify_one();
  void notify_all();
  template <class Predicate>
  void wait(std::unique_lock<Mutex>& lock, Predicate predicate) {
    while (!predicate()) sleep(lock, forever);
  }
  template <class Duration, class Predicate>
  bool wait_for(std::unique_lock<Mutex>& lock, Duration longest, Predicate predicate) {
    const auto end = std::chrono::steady_clock::now() + longest;
    while (!predicate()) {
      const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
      if (rest <= 0) return false;
      sleep(lock, static_cast<unsigned>(std::min<long long>(rest, forever - 1)));
    }
    return true;
  }

 private:
  static constexpr unsigned forever = std::numeric_limits<unsigned>::max();
  /// Until it is woken, or so many milliseconds have passed.
  void sleep(std::unique_lock<Mutex>& lock, unsigned milliseconds);
  void* condition_ = nullptr;  // a CONDITION_VARIABLE, which is a pointer and begins as 0
};

#else

using Mutex = std::mutex;
using Condition = std::condition_variable;

#endif

/// A thread that is joined at its end: the standard library's std::jthread, which libc++ has from version 20 on only.
class JoinedThread {
 public:
  JoinedThread() = default;
  template <class Work>
  explicit JoinedThread(Work work) : thread_(std::move(work)) {}
  JoinedThread(JoinedThread&&) = default;
  ~JoinedThread() {
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::thread thread_;
};

}  // namespace tyndall
