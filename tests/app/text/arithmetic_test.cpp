#include "app/text/numbers.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace tyndall::test::arithmetic_test {

TEST_CASE("sums have the usual order") {
  CHECK(*evaluate("1/4") == 0.25);
  CHECK(*evaluate("2*pi") == doctest::Approx(6.283185307179586).epsilon(1e-15).scale(0));
  CHECK(*evaluate("1 + 2 * 3 - 4 / 8") == 6.5);
  CHECK(*evaluate("8 / 2 / 2") == 2);
  CHECK(*evaluate("8 - 2 - 2") == 4);
  CHECK(*evaluate("-2^2") == -4);
  CHECK(*evaluate("2^3^2") == 512);
  CHECK(*evaluate("2^-1") == 0.5);
  CHECK(*evaluate("(1 + .5)*(2)") == 3);
  CHECK(*evaluate("sqrt(2)/2") == doctest::Approx(std::sqrt(0.5)));
  CHECK(*evaluate("1e-3*2") == 0.002);
}

TEST_CASE("what is no sum has no value") {
  for (const char* text : {"", " ", "1/0", "1//2", "(1", "1)", "pie", "2pi", "sqrt 2", "sqrt(-1)", "nan", "inf", "1 2",
                           "1+", ".", "0x10", "1e999", "."})
    CHECK_MESSAGE(!evaluate(text).has_value(), text);
  CHECK_FALSE(evaluate(std::string(100000, '(')).has_value());
  CHECK_FALSE(evaluate(std::string(100000, '-')).has_value());
}

}  // namespace tyndall::test::arithmetic_test
