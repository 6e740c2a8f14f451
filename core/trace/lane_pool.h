#pragma once
#include "core/base/vec.h"

#include <cstdint>

/// Things that wait until there are enough of them to fill all lanes.
namespace tyndall {

/// Columns of numbers, one row for each part of a thing and one column for each thing that waits. With one lane (float,
/// double) nothing waits. A pool has to begin as zeros, because lanes without a thing take what stands behind the last
/// one, and look things up by it.
template <class F, int numbers, int integers>
struct LanePool {
  static constexpr bool waits = lanes_of<F> > 1;
  /// Before a step fewer things wait than there are lanes, and it adds at most as many as there are.
  static constexpr int room = waits ? 2 * lanes_of<F> : 1;
  alignas(64) float number[numbers][room];
  alignas(64) std::int32_t integer[integers][room];
  int count = 0;
};

/// Bit i is set for each lane i < count. count: at most 32.
TYNDALL_INLINE std::uint32_t first_lanes(int count) { return count >= 32 ? 0xffffffffu : (1u << count) - 1u; }

// each_part(s, thing, number, integer) calls number(row, x) or integer(row, x) for each part of a thing.

/// Adds the things in `lanes` to those that wait.
template <class F, int numbers, int integers>
TYNDALL_INLINE void append_lanes(const auto& s, auto& thing, MaskOf<F> lanes, LanePool<F, numbers, integers>& pool) {
  each_part(
      s, thing, [&](int row, F x) __attribute__((always_inline)) { append(pool.number[row] + pool.count, x, lanes); },
      [&](int row, IntOf<F> x) __attribute__((always_inline)) { append(pool.integer[row] + pool.count, x, lanes); });
  pool.count += __builtin_popcount(bits(lanes));
}

/// Fills the lanes with the things from place `first` on.
template <class F, int numbers, int integers>
TYNDALL_INLINE void load_lanes(const auto& s, const LanePool<F, numbers, integers>& pool, int first, auto& thing) {
  each_part(
      s, thing, [&](int row, F& x) __attribute__((always_inline)) { x = load<F>(pool.number[row] + first); },
      [&](int row, IntOf<F>& x) __attribute__((always_inline)) { x = load_int<F>(pool.integer[row] + first); });
}

}  // namespace tyndall
