#pragma once
#include "core/base/lanes_simd_arithmetic.h"

/// Sums of neighbouring lanes, for groups of lanes; core/clean/cells.h has the one for plain numbers.
namespace tyndall {
namespace HWY_NAMESPACE {

/// The sums of lanes 0 and 1, 2 and 3, … of `a`, then those of `b`.
TYNDALL_INLINE Floats pair_sums(Floats a, Floats b) {
  const TagF tag;
  a.v = hn::Add(hn::ConcatEven(tag, b.v, a.v), hn::ConcatOdd(tag, b.v, a.v));
  return a;
}

}  // namespace HWY_NAMESPACE
}  // namespace tyndall
