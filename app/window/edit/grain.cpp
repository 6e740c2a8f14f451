#include "app/window/edit/grain.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr int least_exponent = -300, most_exponent = 300;  // where powers of ten are numbers

}  // namespace

double Grain::size() const { return multiple * std::pow(10.0, exponent); }

Grain decimal_below(double size) {
  const double exponent = std::floor(std::log10(size) + 1e-9);
  return {1, static_cast<int>(std::fmin(std::fmax(exponent, least_exponent), most_exponent))};
}

Grain nice_below(double size) {
  Grain grain = decimal_below(size);
  for (const int multiple : {2, 5})
    if (multiple * std::pow(10.0, grain.exponent) <= size * (1 + 1e-9)) grain.multiple = multiple;
  return grain;
}

double rounded(double value, Grain grain) {
  // Grains below 1 divide by a power of ten, which is exact: the result prints short.
  if (grain.exponent < 0) {
    const double per_unit = std::pow(10.0, -grain.exponent);
    return std::round(value * per_unit / grain.multiple) * grain.multiple / per_unit + 0.0;
  }
  return std::round(value / grain.size()) * grain.size() + 0.0;
}

Vec3d rounded(Vec3d v, Grain grain) { return {rounded(v.x, grain), rounded(v.y, grain), rounded(v.z, grain)}; }

double without_noise(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  return rounded(value, {1, decimal_below(std::abs(value)).exponent - 11});
}

Vec3d without_noise(Vec3d v) { return {without_noise(v.x), without_noise(v.y), without_noise(v.z)}; }

}  // namespace tyndall
