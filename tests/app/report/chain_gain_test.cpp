#include "app/report/chain_gain.h"

#include "tests/support/pictures.h"

#include <doctest/doctest.h>

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("chain gain: chains take longer and leave far less error; without them nothing is measured") {
  const ChainGain shell = measure_chain_gain(small_scene("stress-bulb", 48, 36, 1), "");
  CHECK(shell.measured);
  CHECK(shell.time > 0.5);
  CHECK(shell.time < 20);
  CHECK(shell.error < 0.5);
  CHECK_FALSE(measure_chain_gain(small_scene("cornell-box", 48, 36, 1), "").measured);
}
