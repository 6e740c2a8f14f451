#pragma once
#include "core/base/lanes.h"

/// Sums that are the same to the last bit in whatever order their numbers come, so that threads, tiles, pauses and
/// machines cannot change a picture.
namespace tyndall {

/// A sum in fixed point, held as two integers: `high` counts 2^-29 of the film's `unit`, `low` counts 2^-61 of it.
/// Smaller bits of each number are cut off before it is added. 2^24 numbers of less than 2^30 units fit if their sum is
/// below 2^34 units. That holds for the samples of a pixel: their mean is at most one unit, so a sample of 2^30 units
/// has a chance of at most 2^-30, and 16 of them among 2^24 samples have one of 2^-140.
struct ExactSum {
  std::int64_t high = 0, low = 0;

  /// x: the number divided by the film's unit, |x| < 2^30.
  TYNDALL_INLINE void add(double x) {
    const double scaled = x * 0x1p29;
    const auto whole = static_cast<std::int64_t>(scaled);
    high += whole;
    low += static_cast<std::int64_t>((scaled - static_cast<double>(whole)) * 0x1p32);
  }
  TYNDALL_INLINE void add(const ExactSum& other) {
    high += other.high;
    low += other.low;
  }
  /// The sum divided by the film's unit, rounded to double.
  double value() const { return static_cast<double>(high) * 0x1p-29 + static_cast<double>(low) * 0x1p-61; }
  bool operator==(const ExactSum&) const = default;
};

}  // namespace tyndall
