#include "app/window/document/job_queue.h"

#include <utility>

namespace tyndall {

BackgroundThread::BackgroundThread(std::function<Time()> work, Time pause)
    : thread_([this, work = std::move(work), pause] {
        std::unique_lock lock(mutex_);
        Time rest = never;
        for (;;) {
          wake_.wait_for(lock, rest, [this] { return due_ || stops_; });
          if (stops_ && !due_) return;
          due_ = false;
          lock.unlock();
          rest = work();
          lock.lock();
          wake_.wait_for(lock, pause, [this] { return stops_; });
        }
      }) {}

BackgroundThread::~BackgroundThread() {
  const std::lock_guard lock(mutex_);
  stops_ = true;
  wake_.notify_one();
}

void BackgroundThread::ask() {
  const std::lock_guard lock(mutex_);
  due_ = true;
  wake_.notify_one();
}

JobQueue::JobQueue(std::function<void()> on_result)
    : on_result_(std::move(on_result)), background_([this] { return work(); }) {}

void JobQueue::run(Job job) {
  ++open_;
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  background_.ask();
}

bool JobQueue::collect() {
  std::vector<Result> results;
  {
    const std::lock_guard lock(mutex_);
    results.swap(results_);
  }
  open_ -= results.size();
  for (const Result& result : results)
    if (result) result();
  return !results.empty();
}

BackgroundThread::Time JobQueue::work() {
  for (;;) {
    Job job;
    {
      const std::lock_guard lock(mutex_);
      if (jobs_.empty()) return BackgroundThread::never;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    Result result = job();
    {
      const std::lock_guard lock(mutex_);
      results_.push_back(std::move(result));
    }
    on_result_();
  }
}

}  // namespace tyndall
