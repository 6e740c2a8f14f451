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
  double least() const { return std::pow(10.0, first); }
  double most() const { return std::pow(10.0, last); }
};

/// The whole decades that hold all values from `least` > 0 to `most`, and at least `count` >= 1 of them.
inline Decades decades_around(double least, double most, int count) {
  const int first = static_cast<int>(std::floor(std::log10(least)));
  return {first, std::max(static_cast<int>(std::ceil(std::log10(most))), first + count)};
}

}  // namespace tyndall
