#pragma once
#include "core/base/vec.h"

/// The names of paths by what they meet: near-specular surfaces (glass, mirrors, metal of little fuzz) in order.
namespace tyndall {

inline constexpr int max_guided_events = 10;
inline constexpr int max_guided_things = 31;  ///< near-specular elements that a scene's guide knows

/// A sequence of up to max_guided_events events. Each takes six bits, 2 · (element's index + 1) + (1: reflected), where
/// the index counts near-specular elements. The last event is in the lowest bits.
template <class F>
struct OrderedEvents {
  using I = IntOf<F>;
  I low, high;  ///< the last five events; those before them

  TYNDALL_INLINE static OrderedEvents none() { return {I(0), I(0)}; }
  /// Of paths that meet something else, or too much.
  TYNDALL_INLINE static OrderedEvents unknown() { return {I(-1), I(0)}; }
  TYNDALL_INLINE MaskOf<F> is_known() const { return less_equal(I(0), low); }
  TYNDALL_INLINE MaskOf<F> has_events() const { return less(I(0), low); }
};

template <class F>
TYNDALL_INLINE MaskOf<F> same_events(const OrderedEvents<F>& a, const OrderedEvents<F>& b) {
  return mask_and(equal(a.low, b.low), equal(a.high, b.high));
}

template <class F>
TYNDALL_INLINE OrderedEvents<F> select(MaskOf<F> m, const OrderedEvents<F>& a, const OrderedEvents<F>& b) {
  return {select(m, a.low, b.low), select(m, a.high, b.high)};
}

/// `before` and one more event. thing: index of the element; -1: an element that is not near-specular.
template <class F>
TYNDALL_INLINE OrderedEvents<F> append_event(const OrderedEvents<F>& before, IntOf<F> thing, MaskOf<F> reflected) {
  using I = IntOf<F>;
  const I code = thing + thing + I(2) + select(reflected, I(1), I(0));
  const I low = as_int(shift_left<6>(as_uint(before.low & I(0x00ffffff)))) + code;
  const I carry = as_int(shift_right<24>(as_uint(before.low)));
  const I high = as_int(shift_left<6>(as_uint(before.high))) + carry;
  const auto full = less(I(0x00ffffff), before.high);
  const auto fits = mask_and_not(mask_and(before.is_known(), less_equal(I(0), thing)), full);
  return select(fits, OrderedEvents<F>{low, high}, OrderedEvents<F>::unknown());
}

}  // namespace tyndall
