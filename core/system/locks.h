#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>
#if defined(_WIN32)
#define TYNDALL_OWN_LOCKS 1
#include <algorithm>
#include <limits>
#endif
#if !defined(__cpp_lib_jthread) || defined(TYNDALL_OWN_LOCKS)
#include <chrono>
#include <functional>
#include <memory>
#include <utility>
#endif

/// Locks of threads: the standard library's, but on Windows the system's own. There the library's are those of
/// winpthreads, whose conditions now and then let a thread sleep that was woken.
namespace tyndall {

#if defined(_WIN32)

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
  void wait(std::unique_lock<Mutex>& lock) { sleep(lock, forever); }
  template <class Predicate>
  void wait(std::unique_lock<Mutex>& lock, Predicate predicate) {
    while (!predicate()) sleep(lock, forever);
  }
  template <class Duration, class Predicate>
  bool wait_for(std::unique_lock<Mutex>& lock, Duration longest, Predicate predicate) {
    const auto end = std::chrono::steady_clock::now() + longest;
    while (!predicate())
      if (wait_until(lock, end) == std::cv_status::timeout) return predicate();
    return true;
  }
  template <class Time>
  std::cv_status wait_until(std::unique_lock<Mutex>& lock, Time end) {
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Time::clock::now()).count();
    const bool woken = rest > 0 && sleep(lock, static_cast<unsigned>(std::min<long long>(rest, forever - 1)));
    return woken || Time::clock::now() < end ? std::cv_status::no_timeout : std::cv_status::timeout;
  }

 private:
  static constexpr unsigned forever = std::numeric_limits<unsigned>::max();
  /// false: so many milliseconds have passed.
  bool sleep(std::unique_lock<Mutex>& lock, unsigned milliseconds);
  void* condition_ = nullptr;  // a CONDITION_VARIABLE, which is a pointer and begins as 0
};

#else

using Mutex = std::mutex;
using Condition = std::condition_variable;

#endif

/// Threads that are asked to stop and joined when their owner is destroyed: the standard library's where it has them,
/// and where the locks are its own. libc++ has them from version 20 on; else this file has the parts that the program
/// uses.
#if defined(__cpp_lib_jthread) && !defined(TYNDALL_OWN_LOCKS)

using StopToken = std::stop_token;
using StoppableThread = std::jthread;
using StoppableCondition = std::condition_variable_any;

#else

/// Whether the thread that got this token was asked to stop.
class StopToken {
 public:
  bool stop_requested() const {
    const std::lock_guard lock(state_->mutex);
    return state_->requested;
  }

 private:
  friend class StoppableThread;
  friend class StoppableCondition;
  struct State {
    Mutex mutex;
    bool requested = false;
    std::function<void()> wake;  ///< empty: the thread does not sleep
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

class StoppableThread {
 public:
  template <class Work>
  explicit StoppableThread(Work work)
      : token_(), thread_([work = std::move(work), token = token_]() mutable { work(token); }) {}
  StoppableThread(StoppableThread&&) = default;
  ~StoppableThread() {
    if (!thread_.joinable()) return;
    request_stop();
    thread_.join();
  }
  void request_stop() {
    std::function<void()> wake;
    {
      const std::lock_guard lock(token_.state_->mutex);
      token_.state_->requested = true;
      wake = token_.state_->wake;
    }
    if (wake) wake();
  }
  void join() { thread_.join(); }

 private:
  StopToken token_;  // declared first, because the thread gets a copy
  std::thread thread_;
};

class StoppableCondition : public Condition {
 public:
  using Condition::wait, Condition::wait_for;
  /// Sleeps until the predicate holds or a stop is requested. Returns the predicate's value.
  template <class Predicate>
  bool wait(std::unique_lock<Mutex>& lock, const StopToken& stop, Predicate predicate) {
    return sleep(lock, stop, predicate, [&] { return wait(lock), true; });
  }
  /// The same, for no longer than this.
  template <class Duration, class Predicate>
  bool wait_for(std::unique_lock<Mutex>& lock, const StopToken& stop, Duration longest, Predicate predicate) {
    const auto end = std::chrono::steady_clock::now() + longest;
    return sleep(lock, stop, predicate, [&] { return wait_until(lock, end) == std::cv_status::no_timeout; });
  }

 private:
  /// Sleeps by calling once() until the predicate holds. once(): sleeps until it is woken; false: stop sleeping.
  template <class Predicate, class Once>
  bool sleep(std::unique_lock<Mutex>& lock, const StopToken& stop, Predicate predicate, Once once) {
    const auto wake = [this, mutex = lock.mutex()] {
      { const std::lock_guard between_test_and_sleep(*mutex); }
      notify_all();
    };
    while (!predicate()) {
      {
        const std::lock_guard state(stop.state_->mutex);
        stop.state_->wake = wake;
        if (stop.state_->requested) return false;
      }
      if (!once()) return predicate();
    }
    return true;
  }
};

#endif

}  // namespace tyndall
