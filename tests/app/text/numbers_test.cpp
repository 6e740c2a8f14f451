#include "app/text/numbers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace tyndall::test::numbers_test {

constexpr Slider fuzz{0, 1}, radius{0.01, 10, true}, density{0.001, 100, true}, power{0.1, 100, true};

TEST_CASE("a slider's position gives a value, and the value gives the position back") {
  CHECK(slider_position(fuzz, 0.25) == doctest::Approx(0.25));
  CHECK(slider_value(fuzz, 0.25, 0.1) == 0.25);
  CHECK(slider_position(density, 0.001) == doctest::Approx(0));
  CHECK(slider_position(density, 100) == doctest::Approx(1));
  CHECK(slider_position(density, 0.316228) == doctest::Approx(0.5).epsilon(1e-4).scale(0));
  CHECK(slider_value(density, 0.5, 1) == 0.316);
  CHECK(slider_value(density, 1, 1) == 100);
  CHECK(slider_position(radius, -0.5) == doctest::Approx(slider_position(radius, 0.5)));  // shows the size,
  CHECK(slider_value(radius, 0.5, -0.9) < 0);                                             // and keeps the sign
  CHECK(slider_value(radius, 0.5, 0.9) > 0);
}

TEST_CASE("beyond a slider's ends are its end values; it makes room for values beyond, where those are valid") {
  const Slider ior{0.5, 3};
  CHECK(slider_value(ior, -1, 1) == 0.5);
  CHECK(slider_value(ior, 2, 1) == 3);
  CHECK(slider_position(ior, 9) == 1);
  CHECK(slider_position(ior, -9) == 0);
  CHECK(widened(radius, not_zero(), 1000).high == 1000);
  CHECK(widened(radius, not_zero(), -170).high == 1000);
  CHECK(widened(density, at_least(0), 1e-5).low == doctest::Approx(1e-5));
  CHECK(widened(density, at_least(0), 0).low == 0.001);
  CHECK(widened(fuzz, between(0, 1), 1).high == 1);
  CHECK(widened({1, 120}, inside(0, 180), 150).high == 180);
  CHECK(widened(ior, above(0), 1.5).high == 3);
}

TEST_CASE("a slider gives numbers that print short, finer ones a digit more") {
  for (int k = 0; k <= 1000; ++k) {
    const double v = slider_value(fuzz, k / 1000.0, 0);
    CHECK(v == doctest::Approx(k / 1000.0));
    CHECK(std::to_string(v).substr(5) == "000");
  }
  CHECK(slider_value(fuzz, 0.12345, 0) == 0.123);
  CHECK(slider_value(fuzz, 0.12345, 0, 1) == 0.1235);
  CHECK(dragged(fuzz, 0.5, 0.5, 1) == 0.5013);
}

TEST_CASE("a drag of 400 units crosses the whole slider, and a drag of 0 changes nothing") {
  CHECK(dragged(fuzz, 0.2, 200) == doctest::Approx(0.7));
  CHECK(dragged(radius, 0.1, 400.0 / 3) == doctest::Approx(1));
  CHECK(dragged(radius, -0.1, 400.0 / 3) == doctest::Approx(-1));
  CHECK(dragged(fuzz, 2.0 / 3, 0) == 2.0 / 3);
}

TEST_CASE("numbers are shown with the digits that a slider gives") {
  CHECK(format_value(fuzz, 0.18) == "0.180");
  CHECK(format_value({1, 120}, 34) == "34.0");
  CHECK(format_value({0, 5}, 0.4) == "0.40");
  CHECK(format_value(density, 1.1) == "1.100");
  CHECK(format_value(density, 0) == "0.000");
  CHECK(format_value(power, 794.5) == "794.5");
  CHECK(format_value(power, 1e-5) == "1e-05");
  CHECK(format_short(-800) == "-800");
  CHECK(format_short(-0.0) == "0");
  CHECK(format_count(1024) == "1,024");
  CHECK(format_count(999) == "999");
  CHECK(format_count(1234567) == "1,234,567");
}

TEST_CASE("snapping gives round numbers, ten times as many when it is fine") {
  CHECK(snapped(fuzz, 0.234, false) == 0.25);
  CHECK(snapped(fuzz, 0.234, true) == doctest::Approx(0.235).epsilon(0.003).scale(0));
  CHECK(snapped({-180, 180}, 37, false) == 40);
  CHECK(snapped(radius, 0.3, false) == 0.2);
  CHECK(snapped(radius, -3.4, false) == -5);
  CHECK(snapped(radius, 9, false) == 10);
  CHECK(snapped(radius, 0.3456, true) == 0.35);
  CHECK(snapped(fuzz, 0, false) == 0);
}

TEST_CASE("typed numbers: units, blanks and decimal commas are fine; sums have the usual order") {
  for (const auto& [text, expected] :
       {std::pair{" 34.5° ", 34.5}, std::pair{"0,25", 0.25}, std::pair{"-1e-3", -1e-3}, std::pair{" 360/8 ° ", 45.0},
        std::pair{"1/4", 0.25}, std::pair{"1 + 2 * 3 - 4 / 8", 6.5}, std::pair{"8 / 2 / 2", 2.0},
        std::pair{"8 - 2 - 2", 4.0}, std::pair{"-2^2", -4.0}, std::pair{"2^3^2", 512.0}, std::pair{"2^-1", 0.5},
        std::pair{"(1 + .5)*(2)", 3.0}, std::pair{"1e-3*2", 0.002}, std::pair{"2*pi", 6.283185307179586},
        std::pair{"sqrt(2)/2", std::sqrt(0.5)}}) {
    CAPTURE(text);
    double value = 0;
    CHECK(parse_number(text, "°", value));
    CHECK(value == doctest::Approx(expected).epsilon(1e-15).scale(0));
  }
}

TEST_CASE("what is no sum, or has no finite value, is no number") {
  double value = 7;
  for (const char* text : {"",    " ",   "1/0", "1//2", "(1", "1)",   "pie",   "2pi", "sqrt 2", "sqrt(-1)",
                           "nan", "inf", "1 2", "1+",   ".",  "0x10", "1e999", "abc", "1.2.3",  "°"})
    CHECK_MESSAGE(!parse_number(text, "°", value), text);
  CHECK_FALSE(parse_number(std::string(100000, '('), "", value));
  CHECK_FALSE(parse_number(std::string(100000, '-'), "", value));
  CHECK(value == 7);
}

}  // namespace tyndall::test::numbers_test
