#include "app/text/values.h"

#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::name_pattern_test {

TEST_CASE("name pattern: numbers with and without leading zeros, percent signs, values") {
  CHECK(name_for(read_numbered_name("f/%04d.png"), 7) == "f/0007.png");
  CHECK(name_for(read_numbered_name("f/%04d.png"), 12345) == "f/12345.png");
  CHECK(name_for(read_numbered_name("f-%d.png"), 7) == "f-7.png");
  CHECK(name_for(read_numbered_name("100%%-%02d"), 7) == "100%-07");
  CHECK(name_for(read_valued_name("d/%v.exr"), "a/b") == "d/a_b.exr");
}

TEST_CASE("name pattern: a name without its place, or with a second or an unknown one, is refused") {
  for (const char* name : {"f.png", "%04d-%04d.png", "%s.png", "%4d.png", "%.png", "%", "%012d.png", "%v.png"})
    CHECK_THROWS_AS(read_numbered_name(name), UsageError);
  for (const char* name : {"f.exr", "%d.exr", "%v%v.exr", "%4v.exr"})
    CHECK_THROWS_AS(read_valued_name(name), UsageError);
}

}  // namespace tyndall::test::name_pattern_test
