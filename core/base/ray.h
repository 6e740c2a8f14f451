#pragma once
#include "core/base/random.h"

/// Rays, and what shapes, materials and media are told about a hit and answer.
namespace tyndall {

/// How a ray starts on or in a shape. A ray knows which shape it leaves and on which side. That is right at every scale
/// and where surfaces coincide, while a least distance would skip thin gaps or meet the same point again.
enum class Side : std::int32_t {
  outward = 0,  ///< on it, leaving along its geometric outward normal: cannot meet the shape again (all are convex)
  inward = 1,   ///< on it, going in: meets the far side
  within = 2,   ///< somewhere inside: meets the far side
};

inline constexpr std::int32_t from_nowhere =
    -4;  ///< a start neither on nor in a shape that rays keep track of, for example at the camera

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

/// The ray's start with regard to one shape.
template <class F>
struct Start {
  MaskOf<F> here;  ///< it starts on or in this very shape
  MaskOf<F> out;   ///< ... and leaves outward
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

/// What meets a surface, for one scattering event.
template <class F>
struct Incident {
  Vec3<F> direction;  ///< unit, towards the surface
  Vec3<F> normal;     ///< unit, the surface's own (reversed for a negative radius)
  Vec3<F> facing;     ///< the normal, turned against the direction
  F cosine;           ///< between facing and the reversed direction, in [0, 1]
  MaskOf<F> along;    ///< the direction goes along the normal: leaving what the surface encloses
  Vec3<F> unit;       ///< uniform on the unit sphere, from the event's direction dimensions
  bool schlick;       ///< the books' approximation of Fresnel's equations
  const Dice<F>* dice;
};

/// Whether a shadow ray is sent to a light where a material scatters: never (mirrors and glass send light into single
/// directions), always, or only where integrator mis weights it, because the lobe may be so narrow that a direction
/// towards a light almost never falls into it (`weighted`).
enum class LightSampling { never, weighted, always };

/// What leaves a surface after a scattering event.
template <class F>
struct Scattered {
  Vec3<F> direction;      ///< unit
  MaskOf<F> absorbed;     ///< nothing leaves
  MaskOf<F> transmitted;  ///< the direction is on the other side of the surface
  F density;              ///< of the direction, per steradian; `one_direction`: it was the only one, or one of two
};

/// Marks a direction that light sampling cannot choose: a mirror's, glass's, the camera's.
inline constexpr float one_direction = -1.0f;

}  // namespace tyndall
