#include "tests/support/cut_pictures.h"

#include <doctest/doctest.h>

using namespace tyndall;
using namespace tyndall::test;

TEST_CASE("cut pictures: the parts of 300 random scenes of glass, mirrors and slabs are those of the whole") {
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(std::string(kernels.isa));
    CutPictures found;
    for (unsigned seed = 100; seed < 400; ++seed) compare_cuts(seed, kernels, found);
    CAPTURE(found.last);
    CHECK(found.pairs == 1200);
    CHECK(found.differ == 0);
    CHECK(found.chained > 225);
  }
}
