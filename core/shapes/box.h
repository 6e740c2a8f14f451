#pragma once
#include "core/shapes/quad.h"

/// Boxes: what users set, and where rays enter and leave one.
namespace tyndall {

/// A solid block between two corners; a transform may rotate it.
template <class F = double>
struct Box {
  static constexpr const char* type = "box";
  static constexpr const char* about = "A cuboid along the axes, before its transform.";
  Vec3<F> min, max{F(1), F(1), F(1)};
  bool operator==(const Box&) const = default;
};

template <class F>
constexpr auto fields(const Box<F>*) {
  return std::tuple{Field{"min", &Box<F>::min, any_number(), no_slider(), "", "lower corner, scene units", true}
                        .called("Low corner")
                        .also("box size"),
                    Field{"max", &Box<F>::max, any_number(), no_slider(), "", "upper corner, scene units", true}
                        .called("High corner")
                        .also("upper corner")};
}

/// 1 / d, where |d| < 1e-20 counts as 1e-20 with d's sign: then a line parallel to a slab is either inside or outside
/// of the slab, and 0·∞ cannot occur.
template <class F>
TYNDALL_INLINE F safe_reciprocal(F d) {
  const F minimum = F(1e-20f);
  return F(1.0f) / select(less(abs(d), minimum), copy_sign(minimum, d), d);
}

/// Where a line is inside a box, and the distances at which it crosses the faces.
template <class F>
struct BoxSlabs {
  Interval<F> inside;
  Vec3<F> near, far;  ///< for each axis the distances at which the line enters and leaves the slab
  Vec3<F> slope;      ///< 1 / direction in the box's own frame
};

/// The intersection of three slabs. T. Kay, J. Kajiya, Ray Tracing Complex Scenes, SIGGRAPH 1986.
template <class F>
TYNDALL_INLINE BoxSlabs<F> box_slabs(const auto& box, Vec3<F> origin, Vec3<F> direction) {
  const Vec3<F> slope{safe_reciprocal(affine_direction(box, 0, direction)),
                      safe_reciprocal(affine_direction(box, 1, direction)),
                      safe_reciprocal(affine_direction(box, 2, direction))};
  // First the distances to the faces along each axis: near a face these differences are exact, as dense media need.
  const Vec3<F> p{affine_point(box, 0, origin), affine_point(box, 1, origin), affine_point(box, 2, origin)};
  const Vec3<F> low{(F(-1.0f) - p.x) * slope.x, (F(-1.0f) - p.y) * slope.y, (F(-1.0f) - p.z) * slope.z};
  const Vec3<F> high{(F(1.0f) - p.x) * slope.x, (F(1.0f) - p.y) * slope.y, (F(1.0f) - p.z) * slope.z};
  const Vec3<F> near{min(low.x, high.x), min(low.y, high.y), min(low.z, high.z)};
  const Vec3<F> far{max(low.x, high.x), max(low.y, high.y), max(low.z, high.z)};
  const F t0 = max(near.x, max(near.y, near.z)), t1 = min(far.x, min(far.y, far.z));
  return {{t0, t1, less_equal(t0, t1)}, near, far, slope};
}

/// Corrects the interval of a line for rays that start on or in the box. Rays that go outward never hit the box again;
/// all others are inside it from their start on.
template <class F>
TYNDALL_INLINE Interval<F> leave_box(Interval<F> line, Start<F> start) {
  return {select(start.here, F(-1.0f), line.near), select(start.here, max(line.far, F(1e-37f)), line.far),
          mask_and_not(mask_or(line.hit, start.here), start.out)};
}

/// Where a ray leaves the box that it starts in. Rounding may put a start inside onto a face: it was inside by up to
/// half of the spacing of floats, on average a quarter (2^-26 of half an edge if the box is around the origin). This
/// matters in media whose mean free path is only a few dozen such spacings.
template <class F>
TYNDALL_INLINE F leave_from_within(const BoxSlabs<F>& s) {
  const F quarter = F(0x1p-26f);
  return min(max(s.far.x, quarter * abs(s.slope.x)),
             min(max(s.far.y, quarter * abs(s.slope.y)), max(s.far.z, quarter * abs(s.slope.z))));
}

/// The face by which a ray enters the box, or leaves it where `entering` is false: 0 … 5 for x-, x+, y-, y+, z-, z+ of
/// the box's own axes.
template <class F>
TYNDALL_INLINE IntOf<F> box_face(const BoxSlabs<F>& s, MaskOf<F> entering) {
  using I = IntOf<F>;
  const Vec3<F> t = select(entering, s.near, s.far);
  const F extreme = select(entering, max(t.x, max(t.y, t.z)), min(t.x, min(t.y, t.z)));
  const auto is_x = equal(t.x, extreme), is_y = equal(t.y, extreme);
  const I axis = select(is_x, I(0), select(is_y, I(2), I(4)));
  const F slope = select(is_x, s.slope.x, select(is_y, s.slope.y, s.slope.z));
  const auto rising = less(F(0.0f), slope);  // the ray goes towards the + face of that axis
  const auto plus = mask_or(mask_and(entering, mask_not(rising)), mask_and_not(rising, entering));
  return select(plus, axis + I(1), axis);
}

}  // namespace tyndall
