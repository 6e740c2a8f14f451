#include "app/window/edit/drag_rounding.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr int min_exponent = -300, max_exponent = 300;  // where powers of ten are numbers

}  // namespace

double DragRounding::size() const { return multiple * std::pow(10.0, exponent); }

DragRounding decimal_below(double size) {
  const double exponent = std::floor(std::log10(size) + 1e-9);
  return {1, static_cast<int>(std::fmin(std::fmax(exponent, min_exponent), max_exponent))};
}

DragRounding nice_below(double size) {
  DragRounding drag_rounding = decimal_below(size);
  for (const int multiple : {2, 5})
    if (multiple * std::pow(10.0, drag_rounding.exponent) <= size * (1 + 1e-9)) drag_rounding.multiple = multiple;
  return drag_rounding;
}

double rounded(double value, DragRounding drag_rounding) {
  // Grains below 1 divide by a power of ten, which is exact: the result prints short.
  if (drag_rounding.exponent < 0) {
    const double per_unit = std::pow(10.0, -drag_rounding.exponent);
    return std::round(value * per_unit / drag_rounding.multiple) * drag_rounding.multiple / per_unit + 0.0;
  }
  return std::round(value / drag_rounding.size()) * drag_rounding.size() + 0.0;
}

Vec3d rounded(Vec3d v, DragRounding drag_rounding) {
  return {rounded(v.x, drag_rounding), rounded(v.y, drag_rounding), rounded(v.z, drag_rounding)};
}

double without_noise(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  return rounded(value, {1, decimal_below(std::abs(value)).exponent - 11});
}

Vec3d without_noise(Vec3d v) { return {without_noise(v.x), without_noise(v.y), without_noise(v.z)}; }

}  // namespace tyndall
