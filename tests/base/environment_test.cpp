#include "core/base/environment.h"
#include "core/base/error.h"

#include <doctest/doctest.h>

#include <cstdlib>

namespace tyndall::test::environment_test {

TEST_CASE("environment: a switch says yes or no, and nothing else") {
  constexpr const char* name = "TYNDALL_SOME_SWITCH";
  for (const char* yes : {"1", "yes", "true", "on", "YES", "On"}) {
    ::setenv(name, yes, 1);
    CHECK(is_on(name));
  }
  for (const char* no : {"", "0", "no", "false", "off", "NO", "False"}) {
    ::setenv(name, no, 1);
    CHECK_FALSE(is_on(name));
    CHECK(is_set(name) == (*no != '\0'));
  }
  for (const char* neither : {"2", "maybe", " 1"}) {
    ::setenv(name, neither, 1);
    CHECK_THROWS_WITH_AS(is_on(name), doctest::Contains(name), UsageError);
    CHECK_THROWS_WITH_AS(is_on(name), doctest::Contains(neither), UsageError);
  }
  ::unsetenv(name);
  CHECK_FALSE(is_on(name));
  CHECK_FALSE(is_set(name));
}

}  // namespace tyndall::test::environment_test
