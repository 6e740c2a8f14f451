#include "tests/support/cut_pictures.h"

/// The same bits for regions, shards and continued films of random scenes. 300 scenes: cut_pictures_slow_test.cpp.
TEST_CASE("cut pictures: the parts of four random scenes of glass, mirrors and slabs are those of the whole") {
  tyndall::test::check_cuts(1, 4);
}
