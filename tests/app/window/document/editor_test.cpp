#include "app/window/document/editor.h"

#include <doctest/doctest.h>

namespace tyndall::test::editor_test {

TEST_CASE("two scenes give the same picture if they differ in name and display only") {
  Scene a, b;
  b.name = "b";
  b.display.exposure = 1;
  CHECK(same_picture(a, b));
  b.camera.vfov = 50;
  CHECK_FALSE(same_picture(a, b));
}

}  // namespace tyndall::test::editor_test
