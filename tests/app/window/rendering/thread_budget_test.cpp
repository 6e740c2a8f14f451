#include "app/window/rendering/thread_budget.h"

#include "tests/support/news.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

using namespace tyndall;

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
  explicit Sharing(int threads) {
    second_ = std::make_unique<Renderer>(Renderer::Options{threads, ""}, [this] { on_frame(true); });
    budget_.split_with(second_.get());
    const auto scene = std::make_shared<const Scene>(test::small_scene("cornell-box", 60, 60, 1000000));
    const RenderRequest wanted{.scene = scene, .threads = threads};
    budget_.request(wanted, wanted);
  }
  ~Sharing() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;  // the two are destroyed one after the other: neither must wait for the other any more
    }
    budget_.split_with(nullptr);
  }
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;

  /// Waits until each has rendered that many passes.
  bool both_make(int passes) {
    return news_.wait_until([&] {
      const std::lock_guard lock(mutex_);
      return passes_[0] >= passes && passes_[1] >= passes;
    });
  }
  /// In seconds of rendering, over the passes that began after both renderers had begun.
  double greatest_lead() const {
    const std::lock_guard lock(mutex_);
    return greatest_;
  }

 private:
  void on_frame(bool second) {
    {
      const std::lock_guard lock(mutex_);
      if (ended_) return;
      const auto mine = (second ? *second_ : first_).latest(), other = (second ? first_ : *second_).latest();
      double& before = seconds_[second];
      // The other one may have gone on since this pass began: its lead was at least this.
      if (mine && other && before > 0) greatest_ = std::max(greatest_, before - other->seconds);
      if (mine) before = mine->seconds;
      ++passes_[second];
    }
    budget_.on_frame();
    news_.tell();
  }

  mutable std::mutex mutex_;
  double seconds_[2] = {0, 0}, greatest_ = 0;
  int passes_[2] = {0, 0};
  bool ended_ = false;
  test::News news_;
  ThreadBudget budget_{first_};
  Renderer first_{{1, ""}, [this] { on_frame(false); }};
  std::unique_ptr<Renderer> second_;  // declared last, so that it stops first
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

TEST_CASE("a renderer that has finished does not keep the other one waiting") {
  for (const bool together : {false, true})
    for (const Active now : {Active::both, Active::first, Active::second}) {
      CHECK(next_active(now, {9, true}, {1, false}, together) == Active::both);
      CHECK(next_active(now, {1, false}, {9, true}, together) == Active::both);
    }
}
