#include "app/window/document/job_queue.h"

#include "tests/support/news.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace tyndall::test::job_queue_test {

TEST_CASE("jobs run in order elsewhere, results here, and none is lost at the end") {
  std::vector<int> order;
  std::atomic<int> ran = 0;
  test::News news;
  {
    JobQueue jobs([&] { news.tell(); });
    CHECK(jobs.idle());
    for (int k = 0; k < 3; ++k)
      jobs.run([&, k]() -> JobQueue::Result {
        ++ran;
        return [&, k] { order.push_back(k); };
      });
    CHECK(news.wait_until([&] { return news.told() == 3; }));
    CHECK(order.empty());
    CHECK_FALSE(jobs.idle());
    jobs.collect();
    CHECK(jobs.idle());
    CHECK(order == std::vector<int>{0, 1, 2});
    for (int k = 0; k < 3; ++k)
      jobs.run([&]() -> JobQueue::Result {
        std::this_thread::sleep_for(
            std::chrono::milliseconds(20));  // the queue is destroyed before these jobs have run
        ++ran;
        return {};
      });
  }
  CHECK(ran == 6);
}

TEST_CASE("a thread works when it is asked to or its time has come, after a pause, and once more at its end if asked") {
  std::atomic<int> done = 0;
  test::News news;
  const auto work = [&] {
    news.tell();
    return ++done == 1 ? BackgroundThread::Time(1) : BackgroundThread::never;
  };
  {
    BackgroundThread thread(work);
    thread.ask();
    CHECK(news.wait_until([&] { return done == 2; }));
    thread.ask();
  }
  CHECK(done == 3);
  {
    BackgroundThread thread(work, std::chrono::hours(1));
    thread.ask();
    CHECK(news.wait_until([&] { return done == 4; }));
    thread.ask();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(done == 4);
  }
  CHECK(done == 5);
}

}  // namespace tyndall::test::job_queue_test
