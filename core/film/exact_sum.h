#pragma once
#include "core/base/lanes.h"

/// Sums that are equal to the last bit whatever the order of their numbers, so that threads, tiles, pauses and machines
/// cannot change a picture.
namespace tyndall {

/// A sum in fixed point, held as two integers: `high` counts 2^-29 of the film's `quantum`, `low` counts 2^-61 of it.
/// Smaller bits of each number are cut off before it is added. 2^24 numbers below 2^30 quanta fit if their sum is below
/// 2^34 quanta. The samples of a pixel meet this: their mean is at most one quantum, so that a sample of 2^30 quanta
/// has a probability of at most 2^-30, and 16 of them among 2^24 samples one of 2^-140.
struct ExactSum {
  std::int64_t high = 0, low = 0;

  /// x: the number divided by the film's quantum, |x| < 2^30.
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
  /// The sum divided by the film's quantum, rounded to double.
  double value() const { return static_cast<double>(high) * 0x1p-29 + static_cast<double>(low) * 0x1p-61; }
  bool operator==(const ExactSum&) const = default;
};

// Four numbers side by side: the compiler computes with all of them at once if the CPU can.
using FourDoubles [[gnu::vector_size(32)]] = double;
using FourIntegers [[gnu::vector_size(32)]] = std::int64_t;
using TwoIntegers [[gnu::vector_size(16)]] = std::int64_t;

/// Adds a number to each of three sums, as ExactSum::add() does.
TYNDALL_INLINE void add_each(ExactSum (&to)[3], double x, double y, double z) {
  const FourDoubles scaled = FourDoubles{x, y, z, 0} * 0x1p29;
  const auto whole = __builtin_convertvector(scaled, FourIntegers);
  const FourDoubles rest = (scaled - __builtin_convertvector(whole, FourDoubles)) * 0x1p32;
  const auto low = __builtin_convertvector(rest, FourIntegers);
  void *const of_xy = &to[0], *const of_z = &to[2];
  FourIntegers xy;
  TwoIntegers z_alone;
  __builtin_memcpy(&xy, of_xy, sizeof xy), __builtin_memcpy(&z_alone, of_z, sizeof z_alone);
  xy += __builtin_shufflevector(whole, low, 0, 4, 1, 5);
  z_alone += __builtin_shufflevector(whole, low, 2, 6);
  __builtin_memcpy(of_xy, &xy, sizeof xy), __builtin_memcpy(of_z, &z_alone, sizeof z_alone);
}

}  // namespace tyndall
