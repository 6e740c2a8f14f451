#include "core/base/error_sum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tyndall::test::error_sum_test {

namespace {

std::vector<PixelError> random_errors(std::size_t count) {
  std::mt19937 engine(11);
  std::exponential_distribution<double> size;
  std::vector<PixelError> errors;
  for (std::size_t i = 0; i < count; ++i) errors.push_back({i, i % 5 == 0 ? 0.25 : size(engine)});
  return errors;
}

}  // namespace

TEST_CASE("sum of errors: all are summed, and the largest can be asked for, in whatever parts they came") {
  const std::vector<PixelError> errors = random_errors(1000);
  double sum = 0, squares = 0;
  for (const PixelError& one : errors) sum += one.error, squares += one.error * one.error;
  std::vector<PixelError> sorted = errors;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.error > b.error; });
  for (const std::size_t part : {1ul, 7ul, 300ul, 1000ul}) {
    CAPTURE(part);
    ErrorSum all;
    for (std::size_t first = 0; first < errors.size(); first += part) {
      ErrorSum some;
      for (std::size_t i = first; i < std::min(first + part, errors.size()); ++i) some.add(errors[i]);
      all.add(some);
    }
    CHECK(all.sum() == doctest::Approx(sum).epsilon(1e-12).scale(0));
    CHECK(all.squares() == doctest::Approx(squares).epsilon(1e-12).scale(0));
    const std::vector<PixelError> largest = all.largest();
    REQUIRE(largest.size() == ErrorSum::max_apart);
    for (std::size_t i = 0; i < largest.size(); ++i) CHECK(largest[i].pixel == sorted[i].pixel);
  }
}

TEST_CASE("sum of errors: of equal errors those of the first pixels are the largest; few are all there") {
  ErrorSum all;
  for (std::size_t i = 200; i-- > 0;) all.add({i, 3});
  const std::vector<PixelError> largest = all.largest();
  REQUIRE(largest.size() == ErrorSum::max_apart);
  for (std::size_t i = 0; i + 1 < largest.size(); ++i) CHECK(largest[i].pixel < largest[i + 1].pixel);
  ErrorSum three;
  for (std::size_t i = 0; i < 3; ++i) three.add({i, -1.0});
  CHECK(three.sum() == -3);
  CHECK(three.largest().size() <= 3);
}

TEST_CASE("sum of errors: what a huge error hid is there again once it is replaced") {
  const std::vector<PixelError> errors = random_errors(100);
  ErrorSum all, without;
  all.add({1000, 1e30});
  for (const PixelError& one : errors) all.add(one), without.add(one);
  REQUIRE(all.largest().front().pixel == 1000);
  all.replace({{1000, 0.5}});
  CHECK(all.sum() == doctest::Approx(without.sum() + 0.5).epsilon(1e-12).scale(0));
  CHECK(all.squares() == doctest::Approx(without.squares() + 0.25).epsilon(1e-12).scale(0));
}

TEST_CASE("sum of errors: what is not a number is told by the sum, and is none of the largest") {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ErrorSum all;
  for (const PixelError& one : random_errors(200)) {
    all.add(one);
    all.add({1000 + one.pixel, none});
  }
  CHECK(std::isnan(all.sum()));
  const std::vector<PixelError> largest = all.largest();
  CHECK(largest.size() == ErrorSum::max_apart);
  for (const PixelError& one : largest) CHECK(one.pixel < 1000);
}

}  // namespace tyndall::test::error_sum_test
