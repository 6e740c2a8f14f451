#include "app/text/markup.h"
#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::templates_test {

TEST_CASE("a template gets its texts where their names stand; a name that it has not is refused") {
  const std::string script = from_template("blender.py", {{"scene", "\"{{scene}} {{more}}\""}});
  CHECK(script.find("\nDATA = \"{{scene}} {{more}}\"\n") != std::string::npos);  // what was put in is not looked at
  CHECK_THROWS_AS(from_template("blender.py", {{"scene", ""}, {"more", ""}}), IoError);
  CHECK_THROWS_AS(from_template("no such file", {{"scene", ""}}), IoError);
}

}  // namespace tyndall::test::templates_test
