#include "core/base/thread_pool.h"
#include "core/system/processors.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace tyndall::test::thread_pool_test {

TEST_CASE("crew: every index is called exactly once, in every round") {
  for (const int size : {1, 2, 7}) {
    ThreadPool thread_pool(size);
    CHECK(thread_pool.size() == size);
    for (const int count : {0, 1, 2, 6, 1000, 20000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count) + 1);
      thread_pool.for_each(count, [&](int i) { ++calls[static_cast<std::size_t>(std::min(i, count))]; });
      CHECK(std::all_of(calls.begin(), calls.end() - 1, [](const auto& n) { return n == 1; }));
      CHECK(calls.back() == 0);
    }
  }
}

TEST_CASE("crew: threads that all reach for the next index at once get different ones") {
  ThreadPool thread_pool(4);
  constexpr int count = 200'000;
  for (int round = 0; round < 30; ++round) {
    std::atomic<int> calls = 0;
    thread_pool.for_each(count, [&](int) { calls.fetch_add(1, std::memory_order_relaxed); });
    REQUIRE(calls == count);
  }
}

TEST_CASE("crew: size 0 means as many as the process may use") { CHECK(ThreadPool(0).size() == thread_count().count); }

TEST_CASE("crew: what the jobs wrote is there when for_each returns, round after round") {
  ThreadPool thread_pool(3);
  int sum[3] = {};  // no atomics: for_each itself must order the accesses
  for (int round = 0; round < 3000; ++round) thread_pool.for_each(3, [&](int i) { sum[i] += i + round; });
  for (int i = 0; i < 3; ++i) CHECK(sum[i] == 3000 * i + 2999 * 3000 / 2);
}

TEST_CASE("crew: jobs run on its threads, all at once, never on the caller's") {
  ThreadPool thread_pool(3);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  std::atomic<int> waiting = 0;
  // Each job waits for the two others: with fewer threads than three this would time out.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  thread_pool.for_each(3, [&](int) {
    ++waiting;
    while (waiting < 3 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  CHECK(waiting == 3);
  CHECK(threads.size() == 3);
  CHECK(threads.count(std::this_thread::get_id()) == 0);
}

TEST_CASE("crew: poll is called now and then on the calling thread while the job runs") {
  ThreadPool thread_pool(1);
  int polls = 0;
  bool elsewhere = false;
  std::atomic<bool> polled = false;
  const auto caller = std::this_thread::get_id();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto job = [&](int) {
    while (!polled && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  };
  thread_pool.for_each(1, job, [&] {
    elsewhere |= std::this_thread::get_id() != caller;
    if (++polls == 3) polled = true;
  });
  CHECK(polls >= 3);
  CHECK_FALSE(elsewhere);
}

TEST_CASE("crew: a crew that never worked, and one that just did, end cleanly") {
  for (int i = 0; i < 50; ++i) {
    ThreadPool idle(2), busy(2);
    busy.for_each(5, [](int) {});
  }
}

TEST_CASE("crew: where the poll throws, that comes out when no job runs any more") {
  ThreadPool thread_pool(2);
  std::atomic<int> running = 0, begun = 0;
  const auto job = [&](int) {
    ++running, ++begun;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    --running;
  };
  CHECK_THROWS_WITH(thread_pool.for_each(100'000, job, [] { throw std::runtime_error("poll"); }), "poll");
  CHECK(running == 0);
  CHECK(begun < 100'000);
  int after = 0;
  thread_pool.for_each(1, [&](int) { ++after; });
  CHECK(after == 1);
}

TEST_CASE("crew: what a job throws comes out when no job runs any more, once, and no further ones begin") {
  ThreadPool thread_pool(2);
  std::atomic<int> running = 0, begun = 0;
  const auto job = [&](int i) {
    ++running, ++begun;
    if (i == 3) {
      --running;
      throw std::runtime_error("job 3");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --running;
  };
  CHECK_THROWS_WITH(thread_pool.for_each(100'000, job), "job 3");
  CHECK(running == 0);
  CHECK(begun < 100'000);
  int after = 0;
  thread_pool.for_each(1, [&](int) { ++after; });
  CHECK(after == 1);
}

}  // namespace tyndall::test::thread_pool_test
