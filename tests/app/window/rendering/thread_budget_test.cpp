#include "app/window/rendering/renderer_pair.h"
#include "tests/support/news.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

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

RenderRequest request_of(std::uint32_t spp, int threads) {
  return {.scene = std::make_shared<const Scene>(small_scene("cornell-box", 60, 60, spp)), .threads = threads};
}

}  // namespace

TEST_CASE("two renderers get equal seconds, in turns or side by side, unless one is far ahead or has finished") {
  struct Passes {
    double first, second;
    bool together;
  };
  for (const auto& [first, second, together] :
       {Passes{0.1, 0.1, false}, {0.02, 0.3, false}, {0.3, 0.02, false}, {0.1, 0.13, true}, {0.13, 0.1, true}})
    CHECK(greatest_lead(first, second, together) < (first == second ? 0.5 : 0.7));
  using enum Active;
  struct Turn {
    bool together;
    Active now;
    double first, second;
    Active next;
  };
  for (const auto& [together, now, first_s, second_s, next] : {Turn{true, both, 1, 1.2, both},
                                                               {true, both, 1, 1.6, first},
                                                               {true, first, 1.5, 1.6, first},
                                                               {true, first, 1.7, 1.6, both},
                                                               {false, both, 1, 1.2, first},
                                                               {false, first, 1.4, 1.2, first},
                                                               {false, first, 1.6, 1.2, second}})
    CHECK(next_active(now, {first_s, false}, {second_s, false}, together) == next);
  for (const bool together : {false, true})
    for (const Active now : {both, first, second}) {
      CHECK(next_active(now, {9, true}, {1, false}, together) == both);
      CHECK(next_active(now, {1, false}, {9, true}, together) == both);
    }
}

TEST_CASE("of an even number of threads each half gets one half, of an odd one all in turns, alone all") {
  ThreadBudget budget;
  const auto threads_of = [&](const RenderRequest& wanted, Half half) {  // 0: it is paused
    const RenderRequest part = budget.part_of(wanted, half);
    return part.paused ? 0 : part.threads;
  };
  budget.begin(6, false);
  CHECK(threads_of({.threads = 6}, Half::current) == 6);
  CHECK_FALSE(budget.go_on({9, false}, {0, false}));
  budget.begin(6, true);
  for (const Half half : {Half::current, Half::kept}) CHECK(threads_of({.threads = 6}, half) == 3);
  budget.begin(5, true);
  CHECK(threads_of({.threads = 5}, Half::current) == 5);
  CHECK(threads_of({.threads = 5}, Half::kept) == 0);
  CHECK(budget.go_on({1, false}, {0, false}));
  CHECK(threads_of({.threads = 5}, Half::current) == 0);
  CHECK(threads_of({.threads = 5}, Half::kept) == 5);
  CHECK(threads_of({.threads = 5, .paused = true}, Half::kept) == 0);
}

TEST_CASE("a picture that is started over is not finished before it is there again") {
  News news;
  RendererPair pair(1, "", [&] { news.tell(); });
  RenderRequest wanted = request_of(64, 1);
  pair.request(wanted);
  REQUIRE(news.wait_until([&] { return pair.finished(); }));
  ++wanted.restarts;
  pair.request(wanted);
  CHECK_FALSE(pair.finished());
  CHECK(news.wait_until([&] { return pair.finished(); }));
}

}  // namespace tyndall::test::thread_budget_test
