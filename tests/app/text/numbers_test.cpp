#include "app/text/numbers.h"

#include <doctest/doctest.h>

namespace tyndall::test::numbers_test {

TEST_CASE("a slider's position gives a value, and the value gives the position back") {
  const Slider fuzz{0, 1}, density{0.001, 100, true};
  CHECK(slider_position(fuzz, 0.25) == doctest::Approx(0.25));
  CHECK(slider_value(fuzz, 0.25, 0.1) == 0.25);
  CHECK(slider_position(density, 0.001) == doctest::Approx(0));
  CHECK(slider_position(density, 100) == doctest::Approx(1));
  CHECK(slider_position(density, 0.316228) == doctest::Approx(0.5).epsilon(1e-4).scale(0));
  CHECK(slider_value(density, 0.5, 1) == 0.316);
  CHECK(slider_value(density, 1, 1) == 100);
}

TEST_CASE("positions beyond a slider's ends give the end values, and values beyond are shown at the ends") {
  const Slider ior{0.5, 3};
  CHECK(slider_value(ior, -1, 1) == 0.5);
  CHECK(slider_value(ior, 2, 1) == 3);
  CHECK(slider_position(ior, 9) == 1);
  CHECK(slider_position(ior, -9) == 0);
}

TEST_CASE("a slider gives numbers that print short") {
  for (int k = 0; k <= 1000; ++k) {
    const double v = slider_value({0, 1}, k / 1000.0, 0);
    CHECK(v == doctest::Approx(k / 1000.0));
    CHECK(std::to_string(v).substr(5) == "000");
  }
}

TEST_CASE("a logarithmic slider shows the size of a negative radius and keeps the sign") {
  const Slider radius{0.01, 10, true};
  CHECK(slider_position(radius, -0.5) == doctest::Approx(slider_position(radius, 0.5)));
  CHECK(slider_value(radius, 0.5, -0.9) < 0);
  CHECK(slider_value(radius, 0.5, 0.9) > 0);
}

TEST_CASE("sliders make room for values beyond them, where those are valid") {
  CHECK(widened({0.01, 10, true}, not_zero(), 1000).high == 1000);
  CHECK(widened({0.01, 10, true}, not_zero(), -170).high == 1000);
  CHECK(widened({0.001, 100, true}, at_least(0), 1e-5).low == doctest::Approx(1e-5));
  CHECK(widened({0.001, 100, true}, at_least(0), 0).low == 0.001);
  CHECK(widened({0, 1}, between(0, 1), 1).high == 1);
  CHECK(widened({1, 120}, inside(0, 180), 150).high == 180);
  CHECK(widened({0.5, 3}, above(0), 1.5).high == 3);
}

TEST_CASE("a drag of 400 units crosses the whole slider, and a drag of 0 changes nothing") {
  CHECK(dragged({0, 1}, 0.2, 200) == doctest::Approx(0.7));
  CHECK(dragged({0.01, 10, true}, 0.1, 400.0 / 3) == doctest::Approx(1));
  CHECK(dragged({0.01, 10, true}, -0.1, 400.0 / 3) == doctest::Approx(-1));
  CHECK(dragged({0, 1}, 2.0 / 3, 0) == 2.0 / 3);
}

TEST_CASE("numbers are shown with the digits that a slider gives") {
  CHECK(format_value({0, 1}, 0.18) == "0.180");
  CHECK(format_value({1, 120}, 34) == "34.0");
  CHECK(format_value({0, 5}, 0.4) == "0.40");
  CHECK(format_value({0.001, 100, true}, 1.1) == "1.100");
  CHECK(format_value({0.001, 100, true}, 0) == "0.000");
  CHECK(format_value({0.1, 100, true}, 794.5) == "794.5");
  CHECK(format_value({0.1, 100, true}, 1e-5) == "1e-05");
  CHECK(format_short(-800) == "-800");
  CHECK(format_short(-0.0) == "0");
  CHECK(format_count(1024) == "1,024");
  CHECK(format_count(999) == "999");
  CHECK(format_count(1234567) == "1,234,567");
}

TEST_CASE("typed numbers: units, blanks and decimal commas are fine, the rest is no number") {
  double v = 0;
  CHECK(parse_number(" 34.5° ", "°", v));
  CHECK(v == 34.5);
  CHECK(parse_number("0,25", "", v));
  CHECK(v == 0.25);
  CHECK(parse_number("-1e-3", "", v));
  CHECK(v == -1e-3);
  for (const char* text : {"", " ", "abc", "1.2.3", "1 2", "nan", "inf", "1e999", "°"})
    CHECK_FALSE(parse_number(text, "°", v));
  CHECK(v == -1e-3);
  CHECK(parse_number(" 360/8 ° ", "°", v));
  CHECK(v == 45);
}

TEST_CASE("snapping gives round numbers, ten times as many when it is fine") {
  CHECK(snapped({0, 1}, 0.234, false) == 0.25);
  CHECK(snapped({0, 1}, 0.234, true) == doctest::Approx(0.235).epsilon(0.003).scale(0));
  CHECK(snapped({-180, 180}, 37, false) == 40);
  CHECK(snapped({0.01, 10, true}, 0.3, false) == 0.2);
  CHECK(snapped({0.01, 10, true}, -3.4, false) == -5);
  CHECK(snapped({0.01, 10, true}, 9, false) == 10);
  CHECK(snapped({0.01, 10, true}, 0.3456, true) == 0.35);
  CHECK(snapped({0, 1}, 0, false) == 0);
}

TEST_CASE("finer drags and sliders give a digit more") {
  CHECK(slider_value({0, 1}, 0.12345, 0) == 0.123);
  CHECK(slider_value({0, 1}, 0.12345, 0, 1) == 0.1235);
  CHECK(dragged({0, 1}, 0.5, 0.5, 1) == 0.5013);
}

}  // namespace tyndall::test::numbers_test
