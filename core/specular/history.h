#pragma once
#include "core/base/vec.h"

/// Counts what a path has met since it last scattered at a diffuse surface or in a medium, so that a light which it
/// then hits can be weighed against the specular path that could have found the same light.
namespace tyndall {

/// Counts of the events at one specular object, packed into one integer, because a path carries it through each step:
///
///   0                 nothing was met yet
///   -1                something was met that no specular path meets, or more events of one kind than can be counted
///   otherwise         the object's index + 1 in bits 14 and up, and below them three counts and where the path began
///                         at a sphere, a shell or a flat mirror            at a slab
///       bits 0-3      events at the outer sphere                           events at the two faces across edge 0
///       bits 4-7      events at the inner sphere                           across edge 1
///       bits 8-11     reflections at the inner sphere                      across edge 2
///       bits 12-13    1: the path first moved away from the centre; or 0   the edge across which it met the first face
template <class F>
struct SpecularHistory {
  using I = IntOf<F>;

  I packed;

  TYNDALL_INLINE MaskOf<F> is_empty() const { return equal(packed, I(0)); }
  /// False after something that no specular path meets.
  TYNDALL_INLINE MaskOf<F> goes_on() const { return less_equal(I(0), packed); }
  TYNDALL_INLINE MaskOf<F> has_object() const { return less(I(0), packed); }
  /// The object's index where has_object(), else any number.
  TYNDALL_INLINE I object() const { return as_int(shift_right<14>(as_uint(packed))) - I(1); }
  template <int k>
  TYNDALL_INLINE F count() const {
    return from_int<F>(as_int(shift_right<4 * k>(as_uint(packed))) & I(15));
  }
  TYNDALL_INLINE I start() const { return as_int(shift_right<12>(as_uint(packed))) & I(3); }

  /// The history after an event at `object`. first: start() if nothing was met before. added: 1 in the bits of the
  /// counts that it increases. limit: the bits of the count that must not be full.
  TYNDALL_INLINE SpecularHistory after(I object, I first, I added, I limit) const {
    const I name = as_int(shift_left<14>(as_uint(object + I(1))));
    const I before = select(is_empty(), name + as_int(shift_left<12>(as_uint(first))), packed);
    const auto same = equal(before & I(~0x3fff), name);
    return {select(mask_and_not(same, equal(before & limit, limit)), before + added, I(-1))};
  }
};

}  // namespace tyndall
