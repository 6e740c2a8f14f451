#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>

/// Waiting for what other threads do.
namespace tyndall::test {

/// Told by other threads that something has happened; the test waits for it until a condition holds.
class News {
 public:
  /// Something has happened. From any thread.
  void tell() {
    const std::lock_guard lock(mutex_);
    ++told_;
    changed_.notify_all();
  }
  int told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  /// Asks whether the condition holds, at once and whenever something has happened; false after a minute, which only
  /// ends a test that hangs. What is told to nobody, such as a file that has appeared, is seen within 20 ms.
  template <class Condition>
  bool wait_until(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
      const int before = told();
      if (condition()) return true;
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, std::chrono::milliseconds(20), [&] { return told_ != before; });
    }
    return false;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  int told_ = 0;
};

}  // namespace tyndall::test
