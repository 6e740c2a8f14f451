#pragma once
#include <algorithm>
#include <cmath>

/// Logarithmic axes, as all charts of this program have them.
namespace tyndall {

/// An axis from 10^first to 10^last.
struct Decades {
  int first = 0, last = 1;

  /// Where a value > 0 is on the axis: 0 at its beginning, 1 at its end.
  double part_of(double value) const { return (std::log10(value) - first) / (last - first); }
  /// The value at that part of the axis.
  double value_at(double part) const { return std::pow(10.0, first + part * (last - first)); }
  double minimum() const { return std::pow(10.0, first); }
  double maximum() const { return std::pow(10.0, last); }
};

/// The whole decades that hold all values from `minimum` > 0 to `maximum`, and at least `count` >= 1 of them.
inline Decades decades_around(double minimum, double maximum, int count) {
  const int first = static_cast<int>(std::floor(std::log10(minimum)));
  return {first, std::max(static_cast<int>(std::ceil(std::log10(maximum))), first + count)};
}

}  // namespace tyndall
