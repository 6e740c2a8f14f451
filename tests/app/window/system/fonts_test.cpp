#include "app/window/system/style.h"
#include "tests/app/window/panels/null_imgui.h"

#include <doctest/doctest.h>

namespace tyndall::test::fonts_test {

TEST_CASE("what Latin, Greek and Cyrillic fonts do not have is asked for once; broken text is no error") {
  Characters more;
  CHECK_FALSE(add_characters("Ball 3 – Kugel groß, сфера, σφαίρα", more));
  CHECK(add_characters("金の球", more));
  CHECK(more == Characters{0x91d1, 0x306e, 0x7403});
  CHECK_FALSE(add_characters("球", more));
  CHECK_FALSE(add_characters("\xff\xe9\x87 \xf0\x9f\x98\x80 \x80", more));
  CHECK(more.size() == 3);
}

TEST_CASE("fonts are loaded with and without further characters, at any size") {
  NullImGui imgui;
  for (const float size : {0.8f, 1.0f, 2.0f}) {
    const Fonts fonts = load_fonts(size, 1, {0x91d1, 0xac00});
    REQUIRE(fonts.body != nullptr);
    CHECK(fonts.body->FindGlyphNoFallback('A') != nullptr);
    CHECK(fonts.mono->FindGlyphNoFallback('0') != nullptr);
  }
}

}  // namespace tyndall::test::fonts_test
