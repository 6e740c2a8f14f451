#include "app/window/rendering/renderer_pair.h"

#include "tests/support/news.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

namespace tyndall::test::thread_budget_test {

namespace {

/// Simulates two renderers whose passes take the given seconds. Returns by how much one was ever ahead of the other, in
/// seconds of rendering, after the first two seconds.
double greatest_lead(double first_pass, double second_pass, bool together) {
  double first = 0, second = 0, greatest = 0;
  Active active = Active::both;
  for (int pass = 0; pass < 400; ++pass) {
    if (active != Active::second) first += first_pass;
    if (active != Active::first) second += second_pass;
    active = next_active(active, {first, false}, {second, false}, together);
    if (first + second > 2) greatest = std::max(greatest, std::abs(first - second));
  }
  return greatest;
}

/// Two renderers that share threads, and how far each was ahead of the other when it began a pass.
class Sharing {
 public:
  explicit Sharing(int threads) : pair_(threads, "", [this] { on_frame(); }) {
    const auto scene = std::make_shared<const Scene>(test::small_scene("cornell-box", 60, 60, 1000000));
    const RenderRequest wanted{.scene = scene, .threads = threads};
    pair_.request(wanted, wanted);
  }

  /// Waits until each has rendered that many passes.
  bool both_make(int passes) {
    return news_.wait_until([&] {
      const std::lock_guard lock(mutex_);
      return halves_[0].passes >= passes && halves_[1].passes >= passes;
    });
  }
  /// In seconds of rendering, over the passes that began after both renderers had begun.
  double greatest_lead() const {
    const std::lock_guard lock(mutex_);
    return greatest_;
  }

 private:
  struct Seen {
    std::uint64_t pass = 0;  ///< the newest one
    int passes = 0;
    double seconds = 0;
  };
  void on_frame() {
    {
      const std::lock_guard lock(mutex_);
      const std::shared_ptr<const Frame> now[2] = {pair_.latest(Half::current), pair_.latest(Half::kept)};
      for (const int k : {0, 1}) {
        Seen& mine = halves_[k];
        const Frame* other = now[1 - k].get();
        if (!now[k] || now[k]->pass == mine.pass) continue;
        // The other one may have gone on since this pass began: its lead was at least this.
        if (other && mine.seconds > 0) greatest_ = std::max(greatest_, mine.seconds - other->seconds);
        mine = {now[k]->pass, mine.passes + 1, now[k]->seconds};
      }
    }
    news_.tell();
  }

  mutable std::mutex mutex_;
  Seen halves_[2];
  double greatest_ = 0;
  test::News news_;
  RendererPair pair_;  // declared last, so that it stops first
};

}  // namespace

TEST_CASE("two renderers get equal seconds, in turns or side by side") {
  CHECK(greatest_lead(0.1, 0.1, false) < 0.5);
  CHECK(greatest_lead(0.02, 0.3, false) < 0.7);
  CHECK(greatest_lead(0.3, 0.02, false) < 0.7);
  CHECK(greatest_lead(0.1, 0.13, true) < 0.7);
  CHECK(greatest_lead(0.13, 0.1, true) < 0.7);
}

TEST_CASE("in turns one works at a time; side by side both, unless one is far ahead") {
  CHECK(next_active(Active::both, {1, false}, {1.2, false}, true) == Active::both);
  CHECK(next_active(Active::both, {1, false}, {1.6, false}, true) == Active::first);
  CHECK(next_active(Active::first, {1.5, false}, {1.6, false}, true) == Active::first);
  CHECK(next_active(Active::first, {1.7, false}, {1.6, false}, true) == Active::both);
  CHECK(next_active(Active::both, {1, false}, {1.2, false}, false) == Active::first);
  CHECK(next_active(Active::first, {1.4, false}, {1.2, false}, false) == Active::first);
  CHECK(next_active(Active::first, {1.6, false}, {1.2, false}, false) == Active::second);
}

TEST_CASE("renderers that share threads begin no pass while they are well ahead, however slow the machine is") {
  for (const int threads : {1, 2}) {
    Sharing sharing(threads);
    REQUIRE(sharing.both_make(12));
    CHECK(sharing.greatest_lead() < 0.5 + 1e-9);
  }
}

TEST_CASE(
    "of an even number of threads each half gets one half, of an odd one all in turns; without a second one all") {
  const RenderRequest both{.threads = 6, .paused = false};
  ThreadBudget budget;
  budget.begin(6, false);
  CHECK(budget.part_of(both, Half::current) == both);
  CHECK_FALSE(budget.go_on({9, false}, {0, false}));
  budget.begin(6, true);
  for (const Half half : {Half::current, Half::kept}) {
    CHECK(budget.part_of(both, half).threads == 3);
    CHECK_FALSE(budget.part_of(both, half).paused);
  }
  budget.begin(5, true);
  CHECK(budget.part_of({.threads = 5}, Half::current).threads == 5);
  CHECK_FALSE(budget.part_of({.threads = 5}, Half::current).paused);
  CHECK(budget.part_of({.threads = 5}, Half::kept).paused);
  CHECK(budget.go_on({1, false}, {0, false}));
  CHECK(budget.part_of({.threads = 5}, Half::current).paused);
  CHECK_FALSE(budget.part_of({.threads = 5}, Half::kept).paused);
  CHECK(budget.part_of({.threads = 5, .paused = true}, Half::kept).paused);
}

TEST_CASE("a renderer that has finished does not keep the other one waiting") {
  for (const bool together : {false, true})
    for (const Active now : {Active::both, Active::first, Active::second}) {
      CHECK(next_active(now, {9, true}, {1, false}, together) == Active::both);
      CHECK(next_active(now, {1, false}, {9, true}, together) == Active::both);
    }
}

TEST_CASE("a picture that is started over is not finished before it is there again") {
  test::News news;
  RendererPair pair(1, "", [&] { news.tell(); });
  const auto scene = std::make_shared<const Scene>(test::small_scene("cornell-box", 60, 60, 64));
  RenderRequest wanted{.scene = scene, .threads = 1};
  pair.request(wanted);
  REQUIRE(news.wait_until([&] { return pair.finished(); }));
  ++wanted.restarts;
  pair.request(wanted);
  CHECK_FALSE(pair.finished());
  CHECK(news.wait_until([&] { return pair.finished(); }));
}

}  // namespace tyndall::test::thread_budget_test
