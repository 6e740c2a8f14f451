#include "tests/app/window/random_edits.h"
#include "tests/support/peak_memory.h"

#include <doctest/doctest.h>

#include <malloc.h>

using namespace tyndall;

TEST_CASE("10,000 random edits: the picture is that of the saved scene, and memory stays what it was after 1,000") {
  std::int64_t early = 0, late = 0;
  const auto memory = [] {
    malloc_trim(0);
    return test::process_memory("VmRSS");
  };
  test::check_random_edits("many_random_edits", 10000, 7, [&](int edits) {
    if (edits == 1000) early = memory();
    if (edits == 10000) late = memory();
  });
  MESSAGE("MB after 1,000 edits: ", early / 1000000, ", after 10,000: ", late / 1000000);
  CHECK(static_cast<double>(late) < 1.05 * static_cast<double>(early));
}
