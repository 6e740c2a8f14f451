#include "core/base/thread_pool.h"

#include "core/base/error.h"
#include "core/system/processors.h"

#include <cassert>
#include <chrono>
#include <string>
#include <system_error>
#include <utility>

namespace tyndall {

ThreadPool::ThreadPool(int size) {
  const int wanted = thread_count(size).count;
  try {
    for (int i = 0; i < wanted; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error& error) {
    stop();
    throw IoError("cannot start thread " + std::to_string(threads_.size() + 1) + " of " + std::to_string(wanted) +
                  ": " + error.code().message() + thread_limit_text() + "; --threads says how many to start");
  }
}

ThreadPool::~ThreadPool() { stop(); }

void ThreadPool::stop() {
  const std::lock_guard lock(mutex_);
  stops_ = true;
  wake_.notify_all();
}

void ThreadPool::for_each(int count, const std::function<void(int)>& job, const std::function<void()>& poll) {
  std::unique_lock lock(mutex_);
  assert(busy_ == 0 && "one call at a time, and none from within a job");
  job_ = &job;
  count_ = count;
  next_ = 0;
  busy_ = size();
  ++round_;
  wake_.notify_all();
  const auto finished = [&] { return busy_ == 0; };
  if (!poll) done_.wait(lock, finished);
  while (poll && !done_.wait_for(lock, std::chrono::milliseconds(50), finished)) {
    lock.unlock();
    try {
      poll();
    } catch (...) {  // the threads still use what would be gone
      next_ = count;
      lock.lock();
      done_.wait(lock, finished);
      failure_ = nullptr;
      throw;
    }
    lock.lock();
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

namespace {

/// Of each thread; null on threads that belong to no thread pool.
thread_local std::shared_ptr<void>* memory_of_thread = nullptr;

}  // namespace

std::shared_ptr<void>& thread_pool_memory() {
  assert(memory_of_thread && "only from within a job");
  return *memory_of_thread;
}

void ThreadPool::work() {
  std::shared_ptr<void> memory;
  memory_of_thread = &memory;
  for (std::uint64_t seen = 0;;) {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stops_ || round_ != seen; });
    if (stops_) return;
    seen = round_;
    const auto& job = *job_;
    const int count = count_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      for (int i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count;) job(i);
    } catch (...) {
      failure = std::current_exception();
      next_ = count;  // no further jobs
    }
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace tyndall
