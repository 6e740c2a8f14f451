#pragma once
#include "core/base/vec.h"

/// Counts what a path has met since it last scattered at a diffuse surface or in a medium, so that a light which it
/// then hits can be weighed against the specular path that could have found the same light.
namespace tyndall {

/// Bits [first, first + width) of an integer in each lane.
template <int first, int width, class F>
struct BitField {
  static constexpr std::int32_t one = 1 << first;               ///< adds one event
  static constexpr std::int32_t maximum = (1 << width) - 1;     ///< the largest count
  static constexpr std::int32_t mask = maximum * (1 << first);  ///< the bits of this field
  TYNDALL_INLINE static IntOf<F> of(IntOf<F> packed) {
    if constexpr (first == 0) return packed & IntOf<F>(maximum);
    return as_int(shift_right<first>(as_uint(packed))) & IntOf<F>(maximum);
  }
  TYNDALL_INLINE static MaskOf<F> is_full(IntOf<F> packed) { return equal(packed & IntOf<F>(mask), IntOf<F>(mask)); }
};

/// Counts of the events at one specular object, packed into one integer, because a path carries it through each step:
///
///   0                 nothing was met yet
///   -1                something was met that no specular path meets, or more events than can be counted
///   otherwise         the object's index + 1 in bits 14 and up, and below them
///     at a sphere, a shell or a flat mirror (which counts as a sphere: see SpecularPairs)
///       bits 0-3      events at the outer sphere
///       bits 4-8      events at the inner sphere
///       bits 9-12     reflections at the inner sphere
///       bit 13        the path first moved away from the centre
///     at a slab
///       bits 0-3, 4-7, 8-11   events at the two faces across its first, second and third edge
///       bits 12-13            the edge across which the first face was met
template <class F>
struct SpecularHistory {
  using I = IntOf<F>;
  using Outer = BitField<0, 4, F>;
  using Inner = BitField<4, 5, F>;
  using InnerReflected = BitField<9, 4, F>;
  static constexpr std::int32_t away_from_center = 1 << 13;
  static constexpr int name_shift = 14;

  I packed;

  TYNDALL_INLINE static SpecularHistory nothing() { return {I(0)}; }
  TYNDALL_INLINE MaskOf<F> is_empty() const { return equal(packed, I(0)); }
  /// False after something that no specular path meets.
  TYNDALL_INLINE MaskOf<F> goes_on() const { return less_equal(I(0), packed); }
  TYNDALL_INLINE MaskOf<F> has_object() const { return less(I((1 << name_shift) - 1), packed); }
  /// The object's index where has_object(), else any number.
  TYNDALL_INLINE I object() const { return as_int(shift_right<name_shift>(as_uint(packed))) - I(1); }
  /// The packed integer in which only an object's name, its index + 1, is set.
  TYNDALL_INLINE static I name_of(I object) { return as_int(shift_left<name_shift>(as_uint(object + I(1)))); }
  TYNDALL_INLINE static I name_in(I packed) { return packed & I(~((1 << name_shift) - 1)); }

  TYNDALL_INLINE I outer() const { return Outer::of(packed); }
  TYNDALL_INLINE I inner() const { return Inner::of(packed); }
  TYNDALL_INLINE I inner_reflected() const { return InnerReflected::of(packed); }
  TYNDALL_INLINE MaskOf<F> began_away() const { return mask_not(equal(packed & I(away_from_center), I(0))); }

  /// Events at the faces across an edge of a slab: 0, 1 or 2.
  template <int edge>
  TYNDALL_INLINE I at_faces() const {
    return BitField<4 * edge, 4, F>::of(packed);
  }
  TYNDALL_INLINE I first_edge() const { return as_int(shift_right<12>(as_uint(packed))) & I(3); }
};

/// An event at an object. start: what a history begins with at this event, without the object's name. count: what the
/// event adds to the counts. is_full: lanes without room for another one.
template <class F>
struct HistoryEvent {
  IntOf<F> start, count;
  MaskOf<F> is_full;
};

/// An event at a sphere, shell or mirror. inner: at the inner sphere. away: the path first moved away from the centre.
template <class F>
TYNDALL_INLINE HistoryEvent<F> event_at_sphere(IntOf<F> packed, MaskOf<F> inner, MaskOf<F> reflected, MaskOf<F> away) {
  using I = IntOf<F>;
  using H = SpecularHistory<F>;
  const I at_inner = select(reflected, I(H::Inner::one + H::InnerReflected::one), I(H::Inner::one));
  return {select(away, I(H::away_from_center), I(0)), select(inner, at_inner, I(H::Outer::one)),
          mask_or(mask_or(H::Outer::is_full(packed), H::Inner::is_full(packed)), H::InnerReflected::is_full(packed))};
}

/// An event at a face of a slab. edge: 0, 1 or 2, the edge across which the face lies.
template <class F>
TYNDALL_INLINE HistoryEvent<F> event_at_slab(IntOf<F> packed, IntOf<F> edge) {
  using I = IntOf<F>;
  const I one = select(equal(edge, I(0)), I(1), select(equal(edge, I(1)), I(16), I(256)));
  return {as_int(shift_left<12>(as_uint(edge))), one, equal(packed & (one * I(15)), one * I(15))};
}

/// `before` after another event, at `object`; -1 if it was at another object or has no room.
template <class F>
TYNDALL_INLINE SpecularHistory<F> append_event(SpecularHistory<F> before, IntOf<F> object,
                                               const HistoryEvent<F>& event) {
  using H = SpecularHistory<F>;
  const IntOf<F> name = H::name_of(object);
  const IntOf<F> old = select(before.is_empty(), name + event.start, before.packed);
  const auto other = mask_not(equal(H::name_in(old), name));
  return {select(mask_or(other, event.is_full), IntOf<F>(-1), old + event.count)};
}

}  // namespace tyndall
