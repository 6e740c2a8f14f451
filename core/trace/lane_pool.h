#pragma once
#include "core/base/vec.h"

#include <cstdint>

/// Items that wait until there are enough of them to fill all lanes.
namespace tyndall {

/// Columns of numbers: one row for each member of an item, one column for each waiting item. With one lane (float,
/// double) nothing waits. A pool must start as zeros, because lanes without an item read what stands behind the last
/// one and use it as an index; only then fewer items wait than there are lanes, so that zeros matter in the first
/// 2 lanes_of<F> columns only. groups: the pool has room for so many groups of lanes. Before a step fewer items wait
/// than there are lanes, and the step adds at most one item for each lane, if nothing else is said where it is used.
template <class F, int numbers, int integers, int groups = 2>
struct LanePool {
  static constexpr bool waits = lanes_of<F> > 1;
  static constexpr int room = waits ? groups * lanes_of<F> : 1;
  alignas(64) float number[numbers][room];
  alignas(64) std::int32_t integer[integers][room];
  int count = 0;
};

/// Bit i is set for each lane i < count. count: at most 32.
TYNDALL_INLINE std::uint32_t first_lanes(int count) { return count >= 32 ? 0xffffffffu : (1u << count) - 1u; }

// each_part(s, thing, number, integer) calls number(row, x) or integer(row, x) for each member of an item.

/// Adds the items in `lanes` to the pool.
template <class F, int numbers, int integers, int groups>
TYNDALL_INLINE void append_lanes(const auto& s, auto& thing, MaskOf<F> lanes,
                                 LanePool<F, numbers, integers, groups>& pool) {
  each_part(
      s, thing, [&](int row, F x) __attribute__((always_inline)) { append(pool.number[row] + pool.count, x, lanes); },
      [&](int row, IntOf<F> x) __attribute__((always_inline)) { append(pool.integer[row] + pool.count, x, lanes); });
  pool.count += __builtin_popcount(bits(lanes));
}

/// Fills the lanes with the pool's items from index `first` on.
template <class F, int numbers, int integers, int groups>
TYNDALL_INLINE void load_lanes(const auto& s, const LanePool<F, numbers, integers, groups>& pool, int first,
                               auto& thing) {
  each_part(
      s, thing, [&](int row, F& x) __attribute__((always_inline)) { x = load<F>(pool.number[row] + first); },
      [&](int row, IntOf<F>& x) __attribute__((always_inline)) { x = load<F>(pool.integer[row] + first); });
}

}  // namespace tyndall
