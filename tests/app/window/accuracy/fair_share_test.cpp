#include "app/window/accuracy/fair_share.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace tyndall;

namespace {

/// Renderers whose passes take so long; returns the greatest difference in seconds after the first two seconds.
double greatest_lead(double first_pass, double second_pass, bool together) {
  double first = 0, second = 0, greatest = 0;
  Turn turn = Turn::both;
  for (int pass = 0; pass < 400; ++pass) {
    if (turn != Turn::second) first += first_pass;
    if (turn != Turn::first) second += second_pass;
    turn = next_turn(turn, {first, false}, {second, false}, together);
    if (first + second > 2) greatest = std::max(greatest, std::abs(first - second));
  }
  return greatest;
}

}  // namespace

TEST_CASE("two renderers get equal seconds, in turns or side by side") {
  CHECK(greatest_lead(0.1, 0.1, false) < 0.5);
  CHECK(greatest_lead(0.02, 0.3, false) < 0.7);
  CHECK(greatest_lead(0.3, 0.02, false) < 0.7);
  CHECK(greatest_lead(0.1, 0.13, true) < 0.7);
  CHECK(greatest_lead(0.13, 0.1, true) < 0.7);
}

TEST_CASE("in turns one works at a time; side by side both, unless one is far ahead") {
  CHECK(next_turn(Turn::both, {1, false}, {1.2, false}, true) == Turn::both);
  CHECK(next_turn(Turn::both, {1, false}, {1.6, false}, true) == Turn::first);
  CHECK(next_turn(Turn::first, {1.5, false}, {1.6, false}, true) == Turn::first);
  CHECK(next_turn(Turn::first, {1.7, false}, {1.6, false}, true) == Turn::both);
  CHECK(next_turn(Turn::both, {1, false}, {1.2, false}, false) == Turn::first);
  CHECK(next_turn(Turn::first, {1.4, false}, {1.2, false}, false) == Turn::first);
  CHECK(next_turn(Turn::first, {1.6, false}, {1.2, false}, false) == Turn::second);
}

TEST_CASE("one that has finished keeps nobody waiting") {
  for (const bool together : {false, true})
    for (const Turn now : {Turn::both, Turn::first, Turn::second}) {
      CHECK(next_turn(now, {9, true}, {1, false}, together) == Turn::both);
      CHECK(next_turn(now, {1, false}, {9, true}, together) == Turn::both);
    }
}
