#include "app/window/document/job_queue.h"

#include <utility>

namespace tyndall {

JobQueue::JobQueue(std::function<void()> on_result)
    : on_result_(std::move(on_result)), thread_([this](const StopToken& stop) { work(stop); }) {}

JobQueue::~JobQueue() {
  thread_.request_stop();
  thread_.join();
}

void JobQueue::run(Job job) {
  ++open_;
  const std::lock_guard lock(mutex_);
  jobs_.push_back(std::move(job));
  wake_.notify_one();
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

void JobQueue::work(const StopToken& stop) {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, stop, [&] { return !jobs_.empty(); });
      if (jobs_.empty()) return;  // asked to stop, and nothing is left to do
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
