#include "tests/support/cut_pictures.h"

#include <doctest/doctest.h>

/// The same bits for regions, shards and continued films of random scenes. 300 scenes: cut_pictures_slow_test.cpp.
using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("cut pictures: the parts of a dozen random scenes of glass, mirrors and slabs are those of the whole") {
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(std::string(kernels.isa));
    CutPictures found;
    for (unsigned seed = 1; seed <= 12; ++seed) compare_cuts(seed, kernels, found);
    CAPTURE(found.last);
    CHECK(found.pairs == 48);
    CHECK(found.differ == 0);
    CHECK(found.chained >= 9);
  }
}
