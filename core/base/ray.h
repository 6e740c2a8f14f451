#pragma once
#include "core/base/random.h"

/// Rays, and the structs that shapes, materials and media take and return.
namespace tyndall {

/// How a ray starts on or in a shape. Each ray knows which shape it leaves and on which side, so that it cannot hit the
/// place where it starts. This is exact at every scale and where surfaces coincide. The usual alternative, to skip hits
/// below a minimum distance, would skip thin gaps or hit the same point again.
enum class Side : std::int32_t {
  outward = 0,  ///< on its surface, going out: cannot meet the shape again, because all shapes are convex
  inward = 1,   ///< on its surface, going in: meets the far side
  within = 2,   ///< somewhere inside: meets the far side
};

/// Ray::from of a ray that starts on no shape that rays keep track of, for example at the camera.
inline constexpr std::int32_t from_nowhere = -4;

/// A group of rays. direction: unit length. from: 4·element + side, or from_nowhere.
template <class F>
struct Ray {
  Vec3<F> origin, direction;
  F time;
  IntOf<F> from;
};

/// Where a line is inside a convex shape: near <= t <= far. Only meaningful where `hit`.
template <class F>
struct Interval {
  F near, far;
  MaskOf<F> hit;
};

/// Whether a ray starts on or in one given shape.
template <class F>
struct Start {
  MaskOf<F> here;  ///< it starts on or in this very shape
  MaskOf<F> out;   ///< it starts on this shape and goes out
};

/// Start for a shape that owns the elements first ... first + count - 1.
template <class F>
TYNDALL_INLINE Start<F> start_on(IntOf<F> from, std::int32_t first, std::int32_t count) {
  using I = IntOf<F>;
  const auto here = mask_and(less(I(4 * first - 1), from), less(from, I(4 * (first + count))));
  return {here, mask_and(here, equal(from & I(3), I(0)))};
}

/// Start for a shape of one element.
template <class F>
TYNDALL_INLINE Start<F> start_on(IntOf<F> from, IntOf<F> element) {
  using I = IntOf<F>;
  const auto here = equal(as_int(shift_right<2>(as_uint(from))), element);
  return {here, mask_and(here, equal(from & I(3), I(0)))};
}

}  // namespace tyndall
