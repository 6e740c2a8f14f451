#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <limits>

namespace tyndall::test::finite_test {

TEST_CASE("not finite: how many pixels, and the first of them with its value") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  LinearImage image{3, 2, std::vector<float>(18, 0.5f)};
  CHECK(not_finite_text(image).empty());
  CHECK(is_finite(image, 5));
  image.rgb[3 * 5 + 2] = -infinity;
  CHECK(not_finite_text(image) == "1 of 6 pixels is not finite, the first at 2,1 (blue is -inf)");
  CHECK_FALSE(is_finite(image, 5));
  image.rgb[3 * 1 + 1] = nan, image.rgb[3 * 1 + 2] = nan;  // one pixel, whatever its channels
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 1,0 (green is nan)");
  image.frame = ImageFrame{{0, 0, 9, 9}, {4, -3, 7, -1}};  // an EXR's data window: the place is the picture's
  CHECK(not_finite_text(image) == "2 of 6 pixels are not finite, the first at 5,-3 (green is nan)");
}

}  // namespace tyndall::test::finite_test
