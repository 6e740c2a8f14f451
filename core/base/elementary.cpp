#include "core/base/elementary.h"

#include <cmath>
#include <limits>

namespace tyndall {
namespace {

/// A number with about twice the digits: the sum of both, of which the first is the nearest double. The sums and
/// products are those of T. J. Dekker, A Floating-Point Technique for Extending the Available Precision, 1971.
struct Pair {
  double high = 0, low = 0;
};

/// a + b; |a| >= |b|, or a = 0.
Pair quick_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b, exactly.
Pair sum_of(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// The upper and the lower half of a number's digits.
Pair halves(double a) {
  const double shifted = 134217729.0 * a, high = shifted - (shifted - a);  // 2^27 + 1
  return {high, a - high};
}

/// a b, exactly.
Pair product_of(double a, double b) {
  const double product = a * b;
  const Pair x = halves(a), y = halves(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

Pair operator-(Pair a) { return {-a.high, -a.low}; }
Pair operator+(Pair a, Pair b) {
  const Pair sum = sum_of(a.high, b.high);
  return quick_sum(sum.high, sum.low + (a.low + b.low));
}
Pair operator*(Pair a, Pair b) {
  const Pair product = product_of(a.high, b.high);
  return quick_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}
Pair operator/(Pair a, Pair b) {
  const double first = a.high / b.high;
  const Pair rest = a + -(Pair{first} * b);
  return quick_sum(first, rest.high / b.high);
}
Pair root(Pair a) {
  const double first = std::sqrt(a.high);
  if (first == 0) return {};
  const Pair rest = a + -product_of(first, first);
  return quick_sum(first, rest.high / (2 * first));
}
double rounded(Pair a) { return a.high + a.low; }

constexpr Pair half_circle{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr double quarter = 0x1.921fb54442d18p+0;
constexpr Pair log_of_2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr Pair third{0x1.5555555555555p-2, 0x1.5555555555555p-56};

/// 1 / k!, of factorials that are doubles.
struct OverFactorial {
  double all[19] = {1};
  constexpr double operator()(int k) const { return all[k]; }
};
constexpr OverFactorial over_factorial = [] {
  OverFactorial over;
  double factorial = 1;
  for (int k = 1; k < 19; ++k) over.all[k] = 1 / (factorial *= k);
  return over;
}();

/// The sum of term(k) z^k for k from first to last, the largest power first.
template <class Term>
double series(double z, int first, int last, const Term& term) {
  double sum = 0;
  for (int k = last; k >= first; --k) sum = sum * z + term(k);
  return sum;
}

/// Taylor's series of the sine and cosine for |x| <= π/4, whose next terms are below 2^-63 of them; the first terms are
/// exact.
Pair small_sine(Pair x) {
  const auto term = [](int k) { return (k % 2 == 0 ? 1 : -1) * over_factorial(2 * k + 1); };
  const double z = x.high * x.high;
  return quick_sum(x.high, x.high * z * series(z, 1, 8, term) + x.low * (1 - 0.5 * z));
}
Pair small_cosine(Pair x) {
  const auto term = [](int k) { return (k % 2 == 0 ? 1 : -1) * over_factorial(2 * k); };
  const Pair square = product_of(x.high, x.high);
  const double z = square.high;
  const Pair begin = sum_of(1, -0.5 * z);
  return quick_sum(begin.high, begin.low + (z * z * series(z, 2, 9, term) - 0.5 * square.low - x.high * x.low));
}

/// The sine and the cosine of an angle up to about 2^20. The nearest multiple of a quarter is subtracted in parts, of
/// which the first two have 33 bits, so that their products are exact. W. J. Cody and W. Waite, Software Manual for the
/// Elementary Functions, 1980.
struct Direction {
  Pair sine, cosine;
};
Direction direction(Pair x) {
  constexpr double parts[] = {0x1.921fb54400000p+0, 0x1.0b4611a600000p-34, 0x1.3198a2e037073p-69};
  const double n = std::nearbyint(x.high / quarter);
  const Pair rest = sum_of(x.high - n * parts[0], -n * parts[1]) + Pair{-n * parts[2]} + Pair{x.low};
  Direction d{small_sine(rest), small_cosine(rest)};
  for (int k = static_cast<int>(std::fmod(n, 4)) & 3; k > 0; --k) d = {d.cosine, -d.sine};
  return d;
}

/// The angle of the point (x, y), y >= 0: from its share of the way around a square, which is less than 0.08 away, by
/// three steps, each of which makes an error of e one of e^3 / 3.
Pair arc(Pair y, Pair x) {
  if (y.high == 0) return std::signbit(x.high) ? half_circle : Pair{};
  Pair angle{quarter * (1 - x.high / (std::abs(x.high) + y.high))};
  for (int step = 0; step < 3; ++step) {
    const Direction d = direction(angle);
    angle = angle + (y * d.cosine + -(x * d.sine)) / (x * d.cosine + y * d.sine);
  }
  return angle;
}

/// Of a positive normal number m 2^e, m from sqrt(1/2) on: log m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1) / (m + 1).
Pair binary_logarithm_of(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // in [1/2, 1)
  if (m < 0.70710678118654752) m *= 2, --exponent;
  const Pair s = Pair{m - 1} / sum_of(m, 1), square = s * s, cube = s * square;
  const auto term = [](int k) { return 1.0 / (2 * k + 1); };
  const double z = square.high;
  const Pair sum = s + (cube * third + Pair{cube.high * z * series(z, 0, 10, [&](int k) { return term(k + 2); })});
  return Pair{static_cast<double>(exponent)} + Pair{2 * sum.high, 2 * sum.low} / log_of_2;
}

/// 2^x: e^(r log 2) for the rest r of x beside a whole number.
double power_of_2(Pair x) {
  const double whole = std::nearbyint(x.high);
  const Pair r = (x + Pair{-whole}) * log_of_2;
  const auto term = [](int k) { return over_factorial(k); };
  const Pair begin = sum_of(1, r.high);
  const double more = begin.low + (r.low + r.high * r.high * series(r.high, 2, 15, term) + r.low * r.high);
  return std::ldexp(begin.high + more, static_cast<int>(whole));
}

}  // namespace

double sine(double x) { return rounded(direction({x}).sine); }
double cosine(double x) { return rounded(direction({x}).cosine); }
double tangent(double x) {
  const Direction d = direction({x});
  return rounded(d.sine / d.cosine);
}

double arc_cosine(double x) { return 2 * rounded(arc(root(sum_of(1, -x)), root(sum_of(1, x)))); }
double arc_tangent(double y, double x) { return std::copysign(rounded(arc({std::abs(y)}, {x})), y); }

double binary_logarithm(double x) { return rounded(binary_logarithm_of(x)); }

double to_the_power(double base, double exponent) {
  if (exponent == 0) return 1;
  if (base == 0) return exponent > 0 ? 0 : std::numeric_limits<double>::infinity();
  return power_of_2(Pair{exponent} * binary_logarithm_of(base));
}

}  // namespace tyndall
