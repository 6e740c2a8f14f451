#include "core/scene/place.h"

#include <doctest/doctest.h>

namespace tyndall::test::place_test {

TEST_CASE("what is expected, in words: form, range, unit, meaning") {
  CHECK(expected_text({between(0, 1)}, Form::number) == "a number in [0, 1]");
  CHECK(expected_text({inside(0, 180), "°"}, Form::number) == "a number > 0 and < 180 in °");
  CHECK(expected_text({above(0)}, Form::whole) == "a whole number > 0");
  CHECK(expected_text({at_least(0), "", "samples"}, Form::whole) == "a whole number >= 0 (samples)");
  CHECK(expected_text({not_zero()}, Form::number) == "a number other than 0");
  CHECK(expected_text({any_number()}, Form::vector) == "an array of 3 numbers");
}

TEST_CASE("a place's JSON pointer") {
  const Place scene, materials{scene, "materials"}, gold{materials, "a/b~c"};
  CHECK(pointer(scene) == "/");
  CHECK(pointer({gold, std::size_t{2}}) == "/materials/a~1b~0c/2");
}

}  // namespace tyndall::test::place_test
