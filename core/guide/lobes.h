#pragma once
#include "core/base/random.h"
#include "core/base/sampling.h"
#include "core/guide/light_image.h"
#include "core/trace/scene_view.h"

/// Draws directions towards images of small lights in near-specular surfaces, and gives their pdf. Both are functions
/// of the point, the direction and the sequence of events alone.
namespace tyndall {

inline constexpr float lobe_widening = 1.5f;  ///< axes of a lobe over its standard deviations
inline constexpr float tail_width = 8;        ///< axes of a lobe's tail over those of the lobe
inline constexpr float tail_fraction = 0.1f;  ///< of the directions in the tail
inline constexpr float cone_fraction = 0.1f;  ///< of the directions spread evenly over the sphere that is met first
inline constexpr float min_lobe_variance = 1e-8f;

/// The coordinates of the cell in which a point is. Cells are shifted, so that surfaces at round heights do not lie
/// between two of them.
template <class F>
struct CellPlace {
  IntOf<F> x, y, z;
};
template <class F>
TYNDALL_INLINE CellPlace<F> cell_at(const Guide& g, Vec3<F> point, int level) {
  const F scale = splat<F>(g.inverse_size[level]);
  const auto whole = [&](F v) { return to_int(floor(min(max(mul_add(v, scale, F(0.37f)), F(-1e9f)), F(1e9f)))); };
  return {whole(point.x), whole(point.y), whole(point.z)};
}

/// A number that names a cell, not 0. Two cells may share a name, and then share what is found in them.
template <class F>
TYNDALL_INLINE UintOf<F> tag_of(const CellPlace<F>& c, int level) {
  using U = UintOf<F>;
  const U seed = U(static_cast<std::uint32_t>(level) * golden_ratio);
  return hash(as_uint(c.x) * U(0x9e3779b1u) + as_uint(c.y) * U(0x85ebca6bu) + as_uint(c.z) * U(0xc2b2ae35u) + seed) |
         U(1u);
}

/// The slot of the cell of a point at one level, in the lanes `wanted`; -1: there is none.
template <class F>
TYNDALL_INLINE IntOf<F> find_slot(const Guide& g, Vec3<F> point, int level, MaskOf<F> wanted) {
  using I = IntOf<F>;
  const UintOf<F> name = tag_of<F>(cell_at(g, point, level), level);
  const I tag = as_int(name), mask = splat<F>(g.slot_mask);
  I at = as_int(shift_right<1>(name)) & mask, found = I(-1);
  for (auto open = wanted; any(open); at = (at + I(1)) & mask) {
    const I here = record_in<F>(g.cells, at)(&GuideCell::tag);
    const auto same = mask_and(open, equal(here, tag));
    found = select(same, at, found);
    open = mask_and_not(mask_and_not(open, same), equal(here, I(0)));
  }
  return found;
}

/// The slot of the finest cell that holds a point; -1: there is none.
template <class F>
TYNDALL_INLINE IntOf<F> find_cell(const Guide& g, Vec3<F> point, MaskOf<F> wanted) {
  using I = IntOf<F>;
  const I middle = find_slot(g, point, guide_middle_level, wanted);
  auto refined = mask_and(wanted, less_equal(I(0), middle));
  I found = middle;
  for (int level = guide_middle_level + 1; level < guide_levels; ++level) {
    const auto missing = mask_and(wanted, less(found, I(0)));
    if (!any(missing)) break;
    found = select(missing, find_slot(g, point, level, missing), found);
  }
  for (int level = guide_middle_level - 1; level >= 0; --level) {
    const auto cell = record_in<F>(g.cells, select(refined, found, I(0)));
    refined = mask_and(refined, equal(cell(&GuideCell::is_refined), I(1)));
    if (!any(refined)) break;
    const I finer = find_slot(g, point, level, refined);
    refined = mask_and(refined, less_equal(I(0), finer));
    found = select(refined, finer, found);
  }
  return found;
}

/// Probability with which an event at a diffuse surface queries guided light.
template <class F>
[[gnu::noinline]] static F guided_query_probability(const SceneView& s, Vec3<F> point, MaskOf<F> wanted) {
  const IntOf<F> cell = find_cell(s.guide, point, wanted);
  const auto found = mask_and(wanted, less_equal(IntOf<F>(0), cell));
  const auto its = record_in<F>(s.guide.cells, select(found, cell, IntOf<F>(0)));
  return select(found, its(&GuideCell::query_probability), F(0.0f));
}

/// A lobe as a point sees it: an ellipse of heavy tails in the plane across `center`.
template <class F>
struct SeenLobe {
  Vec3<F> center, u, v;  ///< unit: towards the light by way of the surfaces; the two axes
  F length_u, length_v;  ///< of the axes, as tangents of angles
  MaskOf<F> exists;      ///< false where the point does not see the light
};

/// Where a point sees a light by a wave front: its curvature B at the lobe's point becomes B (I + t B)^-1 at a distance
/// t along the flight. No light is seen at a focus. offset: of the point from the lobe's.
template <class F>
TYNDALL_INLINE SeenImage<F> see_by_front(Vec3<F> offset, Vec3<F> flight, Vec3<F> axis, F b11, F b12, F b22) {
  const Vec3<F> other = cross(flight, axis);
  const F ahead = dot(offset, flight), p = dot(offset, axis), q = dot(offset, other);
  const F one = F(1.0f), spread = b11 * b22 - b12 * b12;
  const F determinant = (one + ahead * b11) * (one + ahead * b22) - ahead * ahead * b12 * b12;
  const F scale = one / select(less(abs(determinant), F(1e-3f)), one, determinant);
  const F c11 = scale * (b11 + ahead * spread), c12 = scale * b12, c22 = scale * (b22 + ahead * spread);
  const Vec3<F> light =
      point_at(point_at(flight, c11 * p + c12 * q, axis), c12 * p + c22 * q, other);  // its flight, not unit
  return {-normalize(light), less_equal(F(1e-3f), abs(determinant))};
}

/// How a point sees the lobe of a sequence: around the light's image if the sequence has one, else around the direction
/// that the wave front tells.
template <class F>
TYNDALL_INLINE SeenLobe<F> see_lobe(const Guide& g, IntOf<F> sequence, Vec3<F> point) {
  using I = IntOf<F>;
  const auto lobe = record_in<F>(g.lobe, sequence);
  const Vec3<F> offset = point - lobe(&GuideLobe::point), flight = lobe(&GuideLobe::flight),
                axis = lobe(&GuideLobe::axis);
  const I image = record_in<F>(g.sequences, sequence)(&GuideSequence::image);
  const auto by_image = less_equal(I(0), image);
  SeenImage<F> light{-flight, by_image};
  if (any(mask_not(by_image))) {
    const Vec3<F> curvature = lobe(&GuideLobe::curvature);
    light = see_by_front(offset, flight, axis, curvature.x, curvature.y, curvature.z);
  }
  if (any(by_image)) {
    using Record = LightImage<float>;
    const auto its = record_in<F>(g.images, select(by_image, image, I(0)));
    const SeenImage<F> seen =
        see_image(LightImage<F>{its(&Record::light), its(&Record::sphere), its(&Record::radius)}, point);
    light.direction = select(by_image, seen.direction, light.direction);
    light.exists = mask_or(mask_and_not(light.exists, by_image), mask_and(seen.exists, by_image));
  }
  SeenLobe<F> seen;
  seen.center = light.direction;
  // The axes rotated by the least rotation that takes the flight's reverse into the centre.
  const Vec3<F> both = seen.center - flight, other = cross(flight, axis);
  const F cosine = F(1.0f) - dot(flight, seen.center);
  seen.exists = mask_and(light.exists, less(F(1e-3f), cosine));
  const F rotation = F(-1.0f) / max(cosine, F(1e-3f));
  seen.u = point_at(axis, rotation * dot(axis, seen.center), both);
  seen.v = point_at(other, rotation * dot(other, seen.center), both);
  const F far = dot(offset, offset) * lobe(&GuideLobe::inverse_size2);
  const F error = mul_add(lobe(&GuideLobe::error), F(0.05f) + far, F(min_lobe_variance));
  seen.length_u = F(lobe_widening) * sqrt(lobe(&GuideLobe::variance_u) + error);
  seen.length_v = F(lobe_widening) * sqrt(lobe(&GuideLobe::variance_v) + error);
  return seen;
}

/// Pdf of a direction from one lobe, per steradian: 1 / (pi a b (1 + rho^2)^2 cos^3), where rho is the distance from
/// the centre in the plane across it, in lengths of the axes a and b; likewise for the tail.
template <class F>
TYNDALL_INLINE F lobe_pdf(const SeenLobe<F>& l, Vec3<F> direction) {
  const F cosine = dot(direction, l.center), inverse = F(1.0f) / max(cosine, F(1e-6f));
  const F x = dot(direction, l.u) * inverse / l.length_u, y = dot(direction, l.v) * inverse / l.length_v;
  const F rho2 = mul_add(x, x, y * y), near = F(1.0f) + rho2,
          far = mul_add(rho2, F(1 / (tail_width * tail_width)), F(1.0f));
  const F shape = F(1 - tail_fraction) / (near * near) + F(tail_fraction / (tail_width * tail_width)) / (far * far);
  const F scale = F(static_cast<float>(1 / pi)) / (l.length_u * l.length_v) * inverse * inverse * inverse;
  return select(mask_and(l.exists, less(F(1e-6f), cosine)), scale * shape, F(0.0f));
}

/// A sequence of events in a cell, for each lane.
template <class F>
struct GuidedSequence {
  IntOf<F> index;  ///< -1: none
  F probability;   ///< that an event in the cell queries guided light, and that of this sequence
};

/// The cone of directions towards the sphere that a sequence meets first.
template <class F>
struct FirstCone {
  Vec3<F> axis;
  F sine2;          ///< squared sine of its half angle
  F one_minus_cos;  ///< 1 - cosine of it
  MaskOf<F> exists;
};
template <class F>
TYNDALL_INLINE FirstCone<F> first_cone(const Guide& g, IntOf<F> sequence, Vec3<F> point) {
  const auto its = record_in<F>(g.sequences, sequence);
  const Vec3<F> to_center = its(&GuideSequence::cone_center) - point;
  const F radius = its(&GuideSequence::cone_radius), d2 = max(dot(to_center, to_center), F(1e-30f)),
          sine2 = radius * radius / d2;
  const auto exists = mask_and(less(F(0.0f), radius), less(sine2, F(0.999f)));
  const F safe = select(exists, sine2, F(0.5f));
  return {(F(1.0f) / sqrt(d2)) * to_center, safe, safe / (F(1.0f) + sqrt(F(1.0f) - safe)), exists};
}

/// The directions that a point's queries draw for a sequence of events.
template <class F>
struct GuidedDirections {
  SeenLobe<F> lobe;
  FirstCone<F> cone;
  F probability;     ///< of GuidedSequence
  MaskOf<F> exists;  ///< there is a sequence
};
template <class F>
TYNDALL_INLINE GuidedDirections<F> guided_directions(const Guide& g, const GuidedSequence<F>& sequence, Vec3<F> point) {
  const auto exists = less_equal(IntOf<F>(0), sequence.index);
  const IntOf<F> safe = select(exists, sequence.index, IntOf<F>(0));
  return {see_lobe(g, safe, point), first_cone(g, safe, point), sequence.probability, exists};
}

/// Pdf, per steradian, with which guided queries take the sequence in `direction`.
template <class F>
TYNDALL_INLINE F guided_pdf(const GuidedDirections<F>& d, Vec3<F> direction) {
  const F by_lobe = lobe_pdf(d.lobe, direction);
  const F cosine = dot(direction, d.cone.axis);
  const Vec3<F> across = point_at(direction, -cosine, d.cone.axis);
  const auto inside = mask_and(less(F(0.0f), cosine), less_equal(dot(across, across), d.cone.sine2));
  const F even = F(static_cast<float>(cone_fraction * 0.5 / pi)) / d.cone.one_minus_cos;
  const F pdf = mul_add(F(1 - cone_fraction), by_lobe, select(inside, even, F(0.0f)));
  return select(d.exists, d.probability * select(d.cone.exists, pdf, by_lobe), F(0.0f));
}

/// The sequence of a point's cell with the given events.
template <class F>
TYNDALL_INLINE GuidedSequence<F> find_sequence(const Guide& g, Vec3<F> point, const OrderedEvents<F>& events,
                                               MaskOf<F> wanted) {
  using I = IntOf<F>;
  const I cell = find_cell(g, point, wanted);
  auto open = mask_and(wanted, less_equal(I(0), cell));
  const auto own = record_in<F>(g.cells, select(open, cell, I(0)));
  I at = own(&GuideCell::first), found = I(-1);
  const I end = own(&GuideCell::end);
  for (open = mask_and(open, less(at, end)); any(open); open = mask_and(open, less(at, end))) {
    const auto its = record_in<F>(g.sequences, select(open, at, I(0)));
    const OrderedEvents<F> its_events{its(&GuideSequence::low), its(&GuideSequence::high)};
    const auto same = mask_and(open, same_events(its_events, events));
    found = select(same, at, found);
    open = mask_and_not(open, same);
    at = at + I(1);
  }
  const auto exists = less_equal(I(0), found);
  const F weight = record_in<F>(g.sequences, select(exists, found, I(0)))(&GuideSequence::weight);
  return {found, own(&GuideCell::query_probability) * weight};
}

/// Draws a sequence of a point's cell by u in [0, 1).
template <class F>
TYNDALL_INLINE GuidedSequence<F> draw_guided_sequence(const Guide& g, Vec3<F> point, F u, MaskOf<F> wanted) {
  using I = IntOf<F>;
  const I cell = find_cell(g, point, wanted);
  auto open = mask_and(wanted, less_equal(I(0), cell));
  const auto own = record_in<F>(g.cells, select(open, cell, I(0)));
  I at = own(&GuideCell::first);
  const I end = own(&GuideCell::end);
  GuidedSequence<F> drawn{I(-1), own(&GuideCell::query_probability)};
  F weight = F(0.0f);
  for (open = mask_and(open, less(at, end)); any(open); open = mask_and(open, less(at, end))) {
    const F its = record_in<F>(g.sequences, select(open, at, I(0)))(&GuideSequence::weight);
    const auto here = mask_and(open, less(u, its));
    drawn.index = select(here, at, drawn.index);
    weight = select(here, its, weight);
    open = mask_and_not(open, here);
    u = select(open, u - its, u);
    at = at + I(1);
  }
  drawn.probability = drawn.probability * weight;
  return drawn;
}

/// Draws a direction with guided_pdf() by random numbers in [0, 1). exists: false where the lobe does not exist that
/// was to be drawn from.
template <class F>
TYNDALL_INLINE Vec3<F> draw_guided_direction(const GuidedDirections<F>& d, F strategy, Pair<F> u, MaskOf<F>& exists) {
  const F fraction = select(d.cone.exists, F(cone_fraction), F(0.0f)), one = F(1.0f);
  const auto by_cone = less(strategy, fraction);
  const auto in_tail = less(strategy, mul_add(one - fraction, F(tail_fraction), fraction));
  const F rho = select(in_tail, F(tail_width), one) * sqrt(u.x / (one - u.x));
  const SinCos<F> around = sin_cos_2pi(u.y);
  const Vec3<F> by_lobe = normalize(point_at(point_at(d.lobe.center, d.lobe.length_u * rho * around.cos, d.lobe.u),
                                             d.lobe.length_v * rho * around.sin, d.lobe.v));
  exists = mask_and(d.exists, mask_or(by_cone, d.lobe.exists));
  if (!any(by_cone)) return by_lobe;
  const F low = u.x * d.cone.one_minus_cos, sine = sqrt(max(low * (F(2.0f) - low), F(0.0f)));
  const Basis<F> b = basis_around(d.cone.axis);
  const Vec3<F> in_cone = point_at(point_at((one - low) * d.cone.axis, sine * around.cos, b.s), sine * around.sin, b.t);
  return select(by_cone, in_cone, by_lobe);
}

}  // namespace tyndall
