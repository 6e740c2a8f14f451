#include "tests/support/cut_pictures.h"

TEST_CASE("cut pictures: the parts of 300 random scenes of glass, mirrors and slabs are those of the whole") {
  tyndall::test::check_cuts(100, 300);
}
