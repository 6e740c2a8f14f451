#include "app/text/numbers.h"

#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace tyndall {
namespace {

/// Rounds to a power of ten without leaving digits behind: 0.18, not 0.18000000000000002.
double round_to(double value, int exponent) {
  if (exponent >= 0) {
    const double step = std::pow(10.0, exponent);
    return std::round(value / step) * step;
  }
  const double per_unit = std::pow(10.0, -exponent);
  return std::round(value * per_unit) / per_unit;
}

double with_digits(double value, int digits) {
  if (value == 0) return 0;
  return round_to(value, static_cast<int>(std::floor(std::log10(std::abs(value)))) - digits + 1);
}

/// The number of 1, 2, 5 and 10 times a power of ten that is nearest by proportion. size > 0.
double nearest_of_1_2_5(double size) {
  const double power = std::floor(std::log10(size) + 1e-12), part = size / std::pow(10.0, power);
  const double multiple = part < std::sqrt(2.0) ? 1 : part < std::sqrt(10.0) ? 2 : part < std::sqrt(50.0) ? 5 : 10;
  return with_digits(multiple * std::pow(10.0, power), 1);
}

int step_exponent(const Slider& slider) {
  return static_cast<int>(std::floor(std::log10((slider.high - slider.low) / 500) + 1e-9));
}

/// Reads a sum from left to right, with the usual order of operations.
class Reader {
 public:
  explicit Reader(const std::string& text) : rest_(text.c_str()) {}

  /// Nothing for what is no sum, or has no finite value.
  std::optional<double> all() {
    const double value = terms("+-");
    if (next() != '\0' || failed_ || !std::isfinite(value)) return {};
    return value;
  }

 private:
  static constexpr int deepest = 50;  // nested parentheses and signs

  char next() {
    while (*rest_ == ' ') ++rest_;
    return *rest_;
  }
  bool take(std::string_view word) {
    next();
    if (!std::string_view(rest_).starts_with(word)) return false;
    rest_ += word.size();
    return true;
  }
  /// signs: "+-" of a sum of products, "*/" of a product of powers.
  double terms(std::string_view signs) {
    const auto part = [&] { return signs == "+-" ? terms("*/") : signed_power(); };
    double value = part();
    while (next() != '\0' && signs.find(*rest_) != signs.npos) {
      const char sign = *rest_++;
      const double right = part();
      value = sign == '+' ? value + right : sign == '-' ? value - right : sign == '*' ? value * right : value / right;
    }
    return value;
  }
  double signed_power() {
    if (++depth_ > deepest) return fail();
    const double sign = take("-") ? -1 : take("+") ? 1 : 0;
    const double base = sign != 0 ? sign * signed_power() : single();
    const double value = sign == 0 && take("^") ? std::pow(base, signed_power()) : base;
    --depth_;
    return value;
  }
  double single() {
    if (take("pi") || take("π")) return pi;
    const bool root = take("sqrt");
    if (!take("(")) return root ? fail() : number();
    const double value = terms("+-");
    if (!take(")")) return fail();
    return root ? std::sqrt(value) : value;
  }
  /// Without sign, and no words: std::strtod() reads "inf" and "0x10", too.
  double number() {
    const char first = next(), second = first == '\0' ? first : rest_[1];
    char* end = nullptr;
    const double value = std::strtod(rest_, &end);
    if ((first != '.' && (first < '0' || first > '9')) || second == 'x' || second == 'X' || end == rest_) return fail();
    rest_ = end;
    return value;
  }
  double fail() {
    failed_ = true;
    rest_ = "";
    return 0;
  }

  const char* rest_;  ///< what is not read yet
  int depth_ = 0;
  bool failed_ = false;
};

}  // namespace

Slider widened(const Slider& slider, const Valid& valid, double value) {
  Slider wide = slider;
  const double size = slider.logarithmic ? std::abs(value) : value;
  if (size > slider.high) wide.high = std::min(std::pow(10.0, std::ceil(std::log10(size))), valid.high);
  if (slider.logarithmic && size > 0 && size < slider.low) wide.low = std::pow(10.0, std::floor(std::log10(size)));
  return wide;
}

double slider_position(const Slider& slider, double value) {
  if (!slider.logarithmic) return std::clamp((value - slider.low) / (slider.high - slider.low), 0.0, 1.0);
  const double size = std::max(std::abs(value), slider.low);
  return std::clamp(std::log(size / slider.low) / std::log(slider.high / slider.low), 0.0, 1.0);
}

double slider_value(const Slider& slider, double position, double before, int finer) {
  const double t = std::clamp(position, 0.0, 1.0);
  if (!slider.logarithmic)
    return std::clamp(round_to(slider.low + t * (slider.high - slider.low), step_exponent(slider) - finer), slider.low,
                      slider.high) +
           0.0;
  const double size = with_digits(slider.low * std::pow(slider.high / slider.low, t), 3 + finer);
  return std::copysign(std::clamp(size, slider.low, slider.high), before < 0 ? -1.0 : 1.0);
}

double dragged(const Slider& slider, double before, double steps, int finer) {
  if (steps == 0) return before;
  if (slider.logarithmic && before != 0) {
    const double factor = std::exp(steps / 400 * std::log(slider.high / slider.low));
    return with_digits(before * factor, 3 + finer);
  }
  const double range = slider.high - slider.low;
  return round_to(before + steps / 400 * range, step_exponent(slider) - finer) + 0.0;
}

double snapped(const Slider& slider, double value, bool fine) {
  if (value == 0) return value;
  if (slider.logarithmic)
    return std::copysign(fine ? with_digits(std::abs(value), 2) : nearest_of_1_2_5(std::abs(value)), value);
  const double step = nearest_of_1_2_5((slider.high - slider.low) / (fine ? 200 : 20));
  return with_digits(std::round(value / step) * step, 12) + 0.0;
}

std::string format_value(const Slider& slider, double value) {
  const double size = std::abs(value);
  if (size >= 1e4 || (size != 0 && size < 1e-3)) return format_short(value);
  if (!slider.logarithmic && size < 100) return fmt::format("{:.{}f}", value, std::clamp(-step_exponent(slider), 0, 6));
  return fmt::format("{:.{}f}", value, size < 10 ? 3 : size < 100 ? 2 : size < 1000 ? 1 : 0);
}

std::string format_short(double value) { return fmt::format("{:.4g}", value + 0.0); }

std::string format_count(unsigned long long n) {
  std::string text = std::to_string(n);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

bool parse_number(const std::string& text, const std::string& unit, double& value) {
  std::string number = text.substr(0, text.find_last_not_of(' ') + 1);
  if (!unit.empty() && number.size() > unit.size() && number.ends_with(unit))
    number.resize(number.size() - unit.size());
  std::replace(number.begin(), number.end(), ',', '.');
  const auto typed = Reader(number).all();
  value = typed.value_or(value);
  return typed.has_value();
}

}  // namespace tyndall
