#include "app/text/numbers.h"

#include "core/base/math.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

constexpr int deepest = 50;  // nested parentheses

/// Reads a sum from left to right; `failed` once something is not as expected.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::optional<double> all() {
    const double value = sum();
    skip();
    if (failed_ || !rest().empty() || !std::isfinite(value)) return {};
    return value;
  }

 private:
  std::string_view rest() const { return std::string_view(text_).substr(at_); }
  void skip() { at_ = std::min(text_.find_first_not_of(' ', at_), text_.size()); }
  bool take(std::string_view word) {
    skip();
    if (!rest().starts_with(word)) return false;
    at_ += word.size();
    return true;
  }

  double sum() {
    double value = product();
    for (;;) {
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = signed_power();
    for (;;) {
      if (take("*"))
        value *= signed_power();
      else if (take("/"))
        value /= signed_power();
      else
        return value;
    }
  }
  double signed_power() {
    if (++depth_ > deepest) return fail();
    double value = 0;
    if (take("-"))
      value = -signed_power();
    else if (take("+"))
      value = signed_power();
    else
      value = power();
    --depth_;
    return value;
  }
  double power() {
    const double base = single();
    return take("^") ? std::pow(base, signed_power()) : base;
  }
  double single() {
    if (take("pi") || take("π")) return pi;
    const bool root = take("sqrt");
    if (take("(")) {
      const double value = sum();
      if (!take(")")) return fail();
      return root ? std::sqrt(value) : value;
    }
    return root ? fail() : number();
  }
  double number() {
    skip();
    const char first = at_ < text_.size() ? text_[at_] : '\0';
    if (first != '.' && (first < '0' || first > '9')) return fail();  // no signs and no words here
    const auto digits = [&](std::size_t from) {
      return std::min(text_.find_first_not_of("0123456789", from), text_.size());
    };
    std::size_t end = digits(at_);
    if (end < text_.size() && text_[end] == '.') end = digits(end + 1);
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      const std::size_t sign = end + 1 < text_.size() && (text_[end + 1] == '+' || text_[end + 1] == '-') ? 1 : 0;
      const std::size_t after = digits(end + 1 + sign);
      if (after > end + 1 + sign) end = after;
    }
    if (text_.substr(at_, end - at_) == ".") return fail();
    const double value = std::strtod(text_.substr(at_, end - at_).c_str(), nullptr);
    at_ = end;
    return value;
  }
  double fail() {
    failed_ = true;
    at_ = text_.size();
    return 0;
  }

  std::string text_;
  std::size_t at_ = 0;
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
  std::string number = text;
  std::replace(number.begin(), number.end(), ',', '.');
  const auto trim = [&] {
    number.erase(0, std::min(number.find_first_not_of(' '), number.size()));
    number.erase(number.find_last_not_of(' ') + 1);
  };
  trim();
  if (!unit.empty() && number.size() > unit.size() && number.ends_with(unit))
    number.resize(number.size() - unit.size());
  trim();
  const auto typed = evaluate(number);
  if (typed) value = *typed;
  return typed.has_value();
}

std::optional<double> evaluate(std::string_view text) { return Reader(text).all(); }

}  // namespace tyndall
