#pragma once
#include "core/specular/event_sequence.h"
#include "core/trace/lights.h"
#include "core/trace/shade.h"

/// Points of lights where specular paths start, and specular paths at spheres; specular_flat.h and specular_slab.h hold
/// the other kinds. A specular path leads from a point of a light, through or off one sphere, off one flat mirror or
/// through one slab, to a point where light scatters.
namespace tyndall {

/// A specular path: its segments between its ends and the object, and what it contributes. The near end is the shading
/// point, the far end the point of the light.
template <class F>
struct SpecularPath {
  MaskOf<F> found;                ///< the object lets such a path pass
  Vec3<F> direction, arrive;      ///< unit directions in which the path leaves the near end and arrives at the far end
  F near_distance, far_distance;  ///< distances from each end to the object
  IntOf<F> wall;                  ///< element to which the near segment leads
  IntOf<F> from;                  ///< Ray::from of the segment that leads to the far end
  F spread;                ///< area at the far end, across the path or on the light, over solid angle at the near end
  F throughput = F(1.0f);  ///< fraction of light that the surfaces send along this path
  F queries = F(1.0f);     ///< expected number of times that a query tries its events: see expected_queries()
  F count = F(1.0f);       ///< for slabs 1 / probability of the event sequence, which `queries` leaves out
  F optical_depth = F(0.0f);  ///< of media in a slab: density times length of the path inside
};

/// Copies members of a struct in the lanes `here`.
template <class F, class T>
TYNDALL_INLINE void put(MaskOf<F> here, const T& from, T& to, auto... members) {
  const auto put_member = [here](const auto& in, auto& out) __attribute__((always_inline)) {
    if constexpr (std::is_same_v<decltype(out), MaskOf<F>&>)
      out = mask_or(mask_and(here, in), mask_and_not(out, here));
    else
      out = select(here, in, out);
  };
  (put_member(from.*members, to.*members), ...);
}

template <class F>
struct BoundingSphere {
  Vec3<F> center;
  F radius;
};

/// A point on a light's surface, drawn without regard to visibility.
template <class F>
struct LightPoint {
  Vec3<F> point, normal;
  F pdf;  ///< per unit of area
};

/// How points are drawn on a sphere light towards a sphere: by z, the cosine between a point's normal and `axis`.
/// Light outside of the sphere: the axis leads to the sphere's centre. The pdf grows with z from 0 at the edge of the
/// cap that the sphere sees, because the light that reaches the sphere grows likewise.
/// Light's centre in the sphere: most of the light leaves the sphere almost straight. The axis leads to the receiver,
/// and most points are drawn on the half that faces it; the rest serve light that the sphere reflects back.
template <class F>
struct LightSide {
  Vec3<F> center, axis;
  F radius, first;    ///< radius of the light; first: least z that the sphere sees, of a cap or of the whole light
  MaskOf<F> outside;  ///< the light's centre is outside of the sphere
};
/// For a light in the sphere: fractions of points on the half that faces the axis, on the other half, and uniform.
inline constexpr float facing_fraction = 0.75f, averted_fraction = 0.125f, even_fraction = 0.125f;

template <class F>
TYNDALL_INLINE LightSide<F> light_side(const LightColumns<F>& light, const BoundingSphere<F>& b, Vec3<F> receiver,
                                       F time) {
  const Vec3<F> center = sphere_light_center(light, time);
  const F distance = length(b.center - center);
  const auto outside = less(b.radius, distance);
  const Vec3<F> to_axis_end = select(outside, b.center, receiver) - center;
  const F scale = F(1.0f) / max(length(to_axis_end), F(1e-30f));
  const F cap = max((light.length_u - b.radius) / max(distance, F(1e-30f)), F(-1.0f));
  return {center, scale * to_axis_end, light.length_u, select(outside, cap, F(-1.0f)), outside};
}

/// Pdf, per unit of area, of the points that draw_on_light_side() gives at the cosine z.
template <class F>
TYNDALL_INLINE F light_side_pdf(const LightSide<F>& side, F z) {
  const F even = F(static_cast<float>(0.25 / pi)) / (side.radius * side.radius), span = F(1.0f) - side.first;
  const F growing = F(4.0f) * max(z - side.first, F(0.0f)) / (span * span);
  const F slope = select(less(F(0.0f), z), F(4.0f * facing_fraction), F(4.0f * averted_fraction));
  return even * select(side.outside, growing, mul_add(slope, abs(z), F(even_fraction)));
}

/// Draws the cosine z from a random number u in [0, 1).
template <class F>
TYNDALL_INLINE F draw_on_light_side(const LightSide<F>& side, F u) {
  const F growing = mul_add(F(1.0f) - side.first, sqrt(u), side.first);
  const F behind = u - F(facing_fraction), rest = behind - F(averted_fraction);
  const F facing = sqrt(min(u * F(1.0f / facing_fraction), F(1.0f)));
  const F averted = -sqrt(min(max(behind * F(1.0f / averted_fraction), F(0.0f)), F(1.0f)));
  const F even = mul_add(rest, F(2.0f / even_fraction), F(-1.0f));
  const F within = select(less(behind, F(0.0f)), facing, select(less(rest, F(0.0f)), averted, even));
  return select(side.outside, growing, within);
}

/// Draws a point of the light k for a specular path at an object. light: its columns. b: the sphere in which the light
/// sees the object, or beyond a flat one the shading point. receiver: the shading point, as seen from the light.
template <class F>
TYNDALL_INLINE LightPoint<F> sample_light_point(const auto& s, IntOf<F> k, const LightColumns<F>& light,
                                                const BoundingSphere<F>& b, Vec3<F> receiver, F time, Pair<F> u) {
  const Pair<F> drawn = on_flat_light(s, k, light.kind, u);
  const Vec3<F> flat =
      point_at(point_at(light.corner, drawn.x * light.length_u, light.edge_u), drawn.y * light.length_v, light.edge_v);
  LightPoint<F> at{flat, light.normal, F(1.0f) / max(light.area, F(1e-37f))};
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  if (!any(round)) return at;
  const LightSide<F> side = light_side(light, b, receiver, time);
  const F z = draw_on_light_side(side, u.x);
  const Vec3<F> normal = around(side.axis, z, u.y);
  return {select(round, point_at(side.center, side.radius, normal), at.point), select(round, normal, at.normal),
          select(round, light_side_pdf(side, z), at.pdf)};
}

/// Returns a given point of the light, with its normal and the pdf with which sample_light_point() draws it.
template <class F>
TYNDALL_INLINE LightPoint<F> light_point_at(const LightColumns<F>& light, const BoundingSphere<F>& b, Vec3<F> receiver,
                                            F time, Vec3<F> point) {
  LightPoint<F> at{point, light.normal, F(1.0f) / max(light.area, F(1e-37f))};
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  if (!any(round)) return at;
  const LightSide<F> side = light_side(light, b, receiver, time);
  const Vec3<F> normal = normalize(point - side.center);
  return {point, select(round, normal, at.normal), select(round, light_side_pdf(side, dot(normal, side.axis)), at.pdf)};
}

/// Cosine between a light's normal and the direction back along a ray that arrives in `direction`. Flat lights emit on
/// both sides, so that theirs is never negative. Spheres emit outward only: negative for rays that arrive from inside.
template <class F>
TYNDALL_INLINE F light_cosine(const LightColumns<F>& light, Vec3<F> normal, Vec3<F> direction) {
  const F cosine = -dot(direction, normal);
  return select(equal(light.kind, IntOf<F>(Lights::sphere)), cosine, abs(cosine));
}

/// The plane of a specular path. It holds both ends and the sphere's centre.
template <class F>
struct PathPlane {
  Vec3<F> near_out, far_out;    ///< unit vectors from the centre to each end
  Vec3<F> near_side, far_side;  ///< near_out, far_out rotated by 90 degrees, in the sense from near to far end
  F near, far;                  ///< distances of the ends from the centre
  F angle, sine;                ///< angle between the ends, seen from the centre, in [0, pi]; its sine
};

template <class F>
TYNDALL_INLINE PathPlane<F> plane_of(const SpecularSphere<F>& b, Vec3<F> near, Vec3<F> far) {
  const Vec3<F> x = near - b.center, y = far - b.center, normal = cross(x, y);
  PathPlane<F> plane;
  plane.near = max(length(x), F(1e-30f)), plane.far = max(length(y), F(1e-30f));
  const F twice_area = length(normal);
  plane.near_out = (F(1.0f) / plane.near) * x, plane.far_out = (F(1.0f) / plane.far) * y;
  const Vec3<F> unit_vector = (F(1.0f) / max(twice_area, F(1e-37f))) * normal;
  plane.near_side = cross(unit_vector, plane.near_out), plane.far_side = cross(unit_vector, plane.far_out);
  plane.angle = atan2(twice_area, dot(x, y));
  plane.sine = twice_area / (plane.near * plane.far);
  return plane;
}

/// sqrt(reach² - p²) from the parameter s of the deflection, where p = maximum (1 - s²). Exact to rounding even where
/// the path grazes a sphere and the plain difference cancels.
template <class F>
TYNDALL_INLINE F depth_of(const Deflection<F>& deflection, F reach, F s) {
  const F drop = deflection.maximum * s * s;
  return sqrt(max(((reach - deflection.maximum) + drop) * (reach + (deflection.maximum - drop)), F(0.0f)));
}

/// dA / dω for the specular path of parameter s: this times a pdf per unit of area of the light, at the far end, is the
/// pdf of the direction at the near end, per steradian. Derivation: dω = sin θ dθ dψ with n a sin θ = p at the near
/// end, dA · cosine = b sin φ dψ · b cos θ' dφ at the far end, and dφ = deflection'(p) dp. cosine: of the ray at the
/// light. a, b: distances of the ends from the centre. slope: derivative of the deflection by s.
template <class F>
TYNDALL_INLINE F spread_of(const Deflection<F>& deflection, const PathEnds<F>& e, F sine, F s, F slope, F cosine) {
  const F p = max(deflection.maximum * (F(1.0f) - s * s), F(1e-30f));
  const F rate = F(2.0f) * deflection.maximum * s * p * e.far_index * e.far_index;
  const F depths = depth_of(deflection, e.near_reach, s) * depth_of(deflection, e.far_reach, s);
  return (e.near_reach * e.far_reach * sine) * depths * abs(slope) / (rate * max(cosine, F(1e-30f)));
}

/// Length of the path from an end to the sphere surface that it meets first: from outside to the outer sphere, from
/// inside to the wall of the glass or of the hollow in which the end lies. in_glass: lanes in which the end is in the
/// glass of a shell, which has two walls.
template <class F>
TYNDALL_INLINE F distance_to_sphere(const SpecularSphere<F>& b, const Deflection<F>& deflection, F end, F reach, F sign,
                                    F s, MaskOf<F> in_glass) {
  const auto out = less(b.radius, end), inward = mask_and(in_glass, less(F(0.0f), sign));
  const auto in_hollow = mask_and_not(b.hollow, in_glass);
  const F index = select(out, F(1.0f), select(in_hollow, b.inner_index, b.index));
  const auto to_inner = mask_and_not(mask_or(in_hollow, inward), out);
  const F wall = index * select(to_inner, b.inner_radius, b.radius);
  const F from_end = depth_of(deflection, reach, s), to_wall = depth_of(deflection, wall, s);
  return max(select(mask_or(out, inward), from_end - to_wall, mul_add(sign, from_end, to_wall)) / index, F(0.0f));
}

/// One of the specular paths between two points with one event sequence.
template <class F>
struct SolvedPath {
  Deflection<F> deflection;
  EndSigns<F> sign;
  DeflectionRoot<F> root;
};

// The part of a specular path inside its sphere is tested for occlusion only if the sphere is overlapped: if other
// surfaces, media or a light are in it or reach into it.

/// The part of a specular path inside its sphere. It lies in a plane through the sphere's centre; a place on it is
/// given by its angle about the centre, measured from `out` towards `side`.
template <class F>
struct InsidePath {
  Vec3<F> out, side;  ///< unit vectors that span the plane
  F p;                ///< Bouguer's invariant
  F angle;            ///< from `out` to the point where the path first meets the sphere
  MaskOf<F> main;     ///< the path has the main event sequence
};

/// The angle about the centre that a path covers between its closest point to the centre and the radius reach / n, in
/// radians: acos(p / reach), see Deflection. 0 where p > reach, because the path stays outside of that radius.
template <class F>
TYNDALL_INLINE F deflection_above(F p, F reach) {
  const F sine = min(p / max(reach, F(1e-30f)), F(1.0f));
  return acos(sine);
}

/// The point of the path at `angle`, at distance `radius` from the sphere's centre.
template <class F>
TYNDALL_INLINE Vec3<F> point_inside(const SpecularSphere<F>& b, const InsidePath<F>& path, F angle, F radius) {
  const F revolutions = angle * F(static_cast<float>(0.5 / pi));
  const SinCos<F> a = sin_cos_2pi(min(max(revolutions - floor(revolutions), F(0.0f)), F(0.99999994f)));
  return point_at(point_at(b.center, radius * a.cos, path.out), radius * a.sin, path.side);
}

/// Fraction of light that passes along the path inside the sphere: below 1 in media, 0 where a surface blocks it.
/// decisions: those that drew the event sequence, so that the same events follow in the same order.
template <class F>
TYNDALL_INLINE F pass_inside(const auto& s, const SpecularSphere<F>& b, const PathEnds<F>& e, InsidePath<F> path,
                             const Decisions<F>& decisions, F time, MaskOf<F> lanes, std::uint32_t& shadow_rays) {
  using I = IntOf<F>;
  SequenceWalk<F> walk = start_walk(b, e, decisions, path.main);
  walk.open = mask_and(lanes, walk.open);
  auto clear = lanes;
  F throughput = F(1.0f);
  const F glass = deflection_above(path.p, b.index * b.radius);
  const F across = glass - deflection_above(path.p, b.index * b.inner_radius);
  const F chord = F(2.0f) * deflection_above(path.p, b.inner_index * b.inner_radius);
  I at = select(e.deep, I(1), I(0));  // the sphere that the path is at: 0 outer, 1 inner
  // With an end inside the sphere, path.angle already is the angle of the first event: the first round does not move.
  auto moves = e.both_out;
  for (int i = 0; i < max_decisions && any(walk.open); ++i) {
    const auto to_outer = equal(walk.next, I(0)), from_outer = equal(at, I(0));
    const auto same = mask_or(mask_and(to_outer, from_outer), mask_not(mask_or(to_outer, from_outer)));
    const F deflection = select(same, select(to_outer, F(2.0f) * glass, chord), across);
    const F end = select(moves, path.angle + deflection, path.angle);
    const auto here = mask_and(mask_and(clear, walk.open), moves);
    if (any(here)) {
      const Vec3<F> from = point_inside(b, path, path.angle, select(from_outer, b.radius, b.inner_radius));
      const Vec3<F> to = point_inside(b, path, end, select(to_outer, b.radius, b.inner_radius));
      const F length_of = max(length(to - from), F(1e-30f));
      const auto outward = mask_and_not(to_outer, from_outer);
      const Ray<F> ray{from, (F(1.0f) / length_of) * (to - from), time,
                       select(from_outer, b.outer, b.inner) * I(4) + select(outward, I(0), I(1))};
      shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(here)));
      clear =
          mask_and_not(clear, call_blocked(shared_view(s), ray, length_of, select(to_outer, b.outer, b.inner), here));
      if (s.has_media()) throughput = select(here, throughput * pass_media(s, ray, length_of, here), throughput);
    }
    path.angle = end;
    at = select(to_outer, I(0), I(1));
    moves = less(F(-1.0f), F(0.0f));
    step_walk(walk);
  }
  return select(clear, throughput, F(0.0f));
}

}  // namespace tyndall
