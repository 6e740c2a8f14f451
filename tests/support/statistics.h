#pragma once
#include "core/render/measure.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// How tests judge numbers that were drawn at random. Seeds are fixed, so a test that passes once passes always.
namespace tyndall::test {

/// A mean and its standard error.
struct Estimate {
  double mean = 0, error = 0;
};

/// From independent values of equal weight.
inline Estimate estimate(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double v : values) sum += v;
  const double mean = sum / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / (n * (n - 1)))};
}

/// Checks that two independent measurements of one thing agree.
inline void check_agree(const Estimate& a, const Estimate& b) {
  CAPTURE(a.mean);
  CAPTURE(a.error);
  CAPTURE(b.mean);
  CAPTURE(b.error);
  CHECK(std::abs(a.mean - b.mean) <= 4 * std::hypot(a.error, b.error));
}

/// Running sums for means of very many values.
struct Moments {
  double count = 0, sum = 0, squares = 0;
  void add(double v) { ++count, sum += v, squares += v * v; }
  Estimate estimate() const {
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / (count - 1))};
  }
};

/// Gathers z-scores. Each must lie within 4, and their squares must average about 1: else the standard errors are
/// wrong.
class ZScores {
 public:
  /// precision: the largest standard error with which the test still finds faults, as a fraction of the expected value.
  void add(const std::string& what, Estimate measured, double expected, double precision = 0.01) {
    CAPTURE(what);
    CAPTURE(measured.mean);
    CAPTURE(measured.error);
    CAPTURE(expected);
    CHECK(measured.error <= precision * std::abs(expected));
    if (measured.error == 0) {
      CHECK(measured.mean == doctest::Approx(expected).epsilon(1e-6).scale(0));
      return;
    }
    const double z = (measured.mean - expected) / measured.error;
    CHECK(std::abs(z) <= 4);
    squares_ += z * z;
    ++count_;
  }
  ~ZScores() {
    if (count_ == 0) return;
    const double mean_square = squares_ / count_;
    const SquareBand band = mean_square_band(count_);
    CAPTURE(count_);
    CAPTURE(mean_square);
    CHECK(mean_square >= band.low);
    CHECK(mean_square <= band.high);
  }
  ZScores() = default;
  ZScores(const ZScores&) = delete;
  ZScores& operator=(const ZScores&) = delete;

 private:
  double squares_ = 0;
  int count_ = 0;
};

/// A chi-square as a normal deviate (Wilson and Hilferty's cube root).
inline double deviate_of(double chi_square, double freedom) {
  const double spread = 2 / (9 * freedom);
  return (std::cbrt(chi_square / freedom) - (1 - spread)) / std::sqrt(spread);
}

/// The same for counts against equal shares.
inline double chi_square_deviate(const std::vector<int>& counts) {
  double total = 0, chi = 0;
  for (const int n : counts) total += n;
  const double expected = total / static_cast<double>(counts.size());
  for (const int n : counts) chi += (n - expected) * (n - expected) / expected;
  return deviate_of(chi, static_cast<double>(counts.size()) - 1);
}

/// Distance of the drawn values' distribution from `cumulative`, times sqrt(n). Above 2.23 with probability 1e-4
/// (Kolmogorov's limit 2 exp(-2 x^2)).
template <class Cumulative>
double kolmogorov_smirnov(std::vector<double> values, Cumulative cumulative) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double maximum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double c = cumulative(values[i]), k = static_cast<double>(i);
    maximum = std::max({maximum, c - k / n, (k + 1) / n - c});
  }
  return maximum * std::sqrt(n);
}

/// Composite Gauss-Legendre quadrature, 4 points in each of `parts` parts.
template <class Function>
double integrate(Function f, double low, double high, int parts = 1000) {
  constexpr double node[2] = {0.33998104358485626, 0.86113631159405258};
  constexpr double weight[2] = {0.65214515486254614, 0.34785484513745386};
  const double half = (high - low) / (2 * parts);
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double middle = low + (2 * i + 1) * half;
    for (int k = 0; k < 2; ++k) sum += weight[k] * (f(middle - half * node[k]) + f(middle + half * node[k]));
  }
  return sum * half;
}

}  // namespace tyndall::test
