#include "app/text/numbers.h"

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

double three_digits(double value) {
  if (value == 0) return 0;
  return round_to(value, static_cast<int>(std::floor(std::log10(std::abs(value)))) - 2);
}

int step_exponent(const Slider& slider) {
  return static_cast<int>(std::floor(std::log10((slider.high - slider.low) / 500) + 1e-9));
}

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

double slider_value(const Slider& slider, double position, double before) {
  const double t = std::clamp(position, 0.0, 1.0);
  if (!slider.logarithmic)
    return std::clamp(round_to(slider.low + t * (slider.high - slider.low), step_exponent(slider)), slider.low,
                      slider.high) +
           0.0;
  const double size = three_digits(slider.low * std::pow(slider.high / slider.low, t));
  return std::copysign(std::clamp(size, slider.low, slider.high), before < 0 ? -1.0 : 1.0);
}

double dragged(const Slider& slider, double before, double steps) {
  if (steps == 0) return before;
  if (slider.logarithmic && before != 0) {
    const double factor = std::exp(steps / 400 * std::log(slider.high / slider.low));
    return three_digits(before * factor);
  }
  const double range = slider.high - slider.low;
  return round_to(before + steps / 400 * range, step_exponent(slider)) + 0.0;
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
  if (number.empty()) return false;
  char* end = nullptr;
  const double parsed = std::strtod(number.c_str(), &end);
  if (*end != '\0' || !std::isfinite(parsed)) return false;
  value = parsed;
  return true;
}

}  // namespace tyndall
