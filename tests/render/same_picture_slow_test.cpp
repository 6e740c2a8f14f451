#include "tests/support/same_picture.h"

namespace tyndall::test::same_picture_slow_test {

TEST_CASE("same picture: for any number of threads and any tiles, from one pixel to more than the picture") {
  same_picture::check_threads_and_tiles({{7, 1}, {2, 0}, {2, 8}, {2, 64}, {2, 1000}, {7, 5}, {7, 8}, {7, 1000}});
}

TEST_CASE("same picture: the parts of 300 random scenes of glass, mirrors and slabs are those of the whole") {
  same_picture::check_cuts(100, 300);
}

}  // namespace tyndall::test::same_picture_slow_test
