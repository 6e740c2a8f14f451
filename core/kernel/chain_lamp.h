#pragma once
#include "core/kernel/chain_word.h"
#include "core/kernel/lights.h"

/// Points of lamps, for chains: where the light starts.
namespace tyndall {

/// A point on a lamp's surface, drawn without regard to what is in between.
template <class F>
struct LampPoint {
  Vec3<F> point, normal;
  F density;  ///< per unit of area
};

/// A ball sees a cap of a sphere lamp: the points whose normals are close to the axis towards the ball. This is the
/// least cosine between normal and axis in the cap; -1, for the whole lamp, if the ball holds the lamp's centre.
/// distance: between the two centres.
template <class F>
TYNDALL_INLINE F seen_from_ball(F distance, F lamp_radius, F ball_radius) {
  return select(less(ball_radius, distance), max((lamp_radius - ball_radius) / max(distance, F(1e-30f)), F(-1.0f)),
                F(-1.0f));
}

/// How points are drawn on a sphere lamp: by z, the cosine between a point's normal and `axis`.
/// If the lamp is outside of the ball, the axis leads to the ball's centre, and the density grows with z from 0 at the
/// edge of the cap that the ball sees, because the light that reaches the ball from there grows likewise. If the lamp's
/// centre is in the ball, most of its light leaves the ball almost straight. Then the axis leads to the point that asks
/// for light, and most points are drawn on the half that faces it; the others are for light that the ball throws back.
template <class F>
struct LampSide {
  Vec3<F> center, axis;
  F radius, first;    ///< of the lamp; least z that the ball sees
  MaskOf<F> outside;  ///< the lamp's centre is outside of the ball
};
/// For a lamp in the ball: shares of points on the half that faces the axis, on the other half, and anywhere.
inline constexpr float facing_share = 0.75f, averted_share = 0.125f, even_share = 0.125f;

template <class F>
TYNDALL_INLINE LampSide<F> lamp_side(const LightColumns<F>& light, const ChainBall<F>& b, Vec3<F> asking, F time) {
  const Vec3<F> center = sphere_light_center(light, time);
  const F distance = length(b.center - center);
  const auto outside = less(b.radius, distance);
  const Vec3<F> way = select(outside, b.center, asking) - center;
  const F scale = F(1.0f) / max(length(way), F(1e-30f));
  return {center, scale * way, light.length_u, seen_from_ball(distance, light.length_u, b.radius), outside};
}

/// Density, per unit of area, of the points that draw_on_lamp_side() gives at the cosine z.
template <class F>
TYNDALL_INLINE F lamp_side_density(const LampSide<F>& side, F z) {
  const F even = F(static_cast<float>(0.25 / pi)) / (side.radius * side.radius), span = F(1.0f) - side.first;
  const F growing = F(4.0f) * max(z - side.first, F(0.0f)) / (span * span);
  const F share = select(less(F(0.0f), z), F(4.0f * facing_share), F(4.0f * averted_share));
  return even * select(side.outside, growing, mul_add(share, abs(z), F(even_share)));
}

/// The cosine z for a random number u in [0, 1).
template <class F>
TYNDALL_INLINE F draw_on_lamp_side(const LampSide<F>& side, F u) {
  const F growing = mul_add(F(1.0f) - side.first, sqrt(u), side.first);
  const F behind = u - F(facing_share), rest = behind - F(averted_share);
  const F facing = sqrt(min(u * F(1.0f / facing_share), F(1.0f)));
  const F averted = -sqrt(min(max(behind * F(1.0f / averted_share), F(0.0f)), F(1.0f)));
  const F even = mul_add(rest, F(2.0f / even_share), F(-1.0f));
  const F within = select(less(behind, F(0.0f)), facing, select(less(rest, F(0.0f)), averted, even));
  return select(side.outside, growing, within);
}

/// Draws a point of a lamp whose light is to go by ball `b`. asking: the point that asks for the chain.
template <class F>
TYNDALL_INLINE LampPoint<F> sample_lamp(const LightColumns<F>& light, const ChainBall<F>& b, Vec3<F> asking, F time,
                                        Pair<F> u) {
  const Vec3<F> flat =
      along(along(light.corner, u.x * light.length_u, light.edge_u), u.y * light.length_v, light.edge_v);
  LampPoint<F> at{flat, light.normal, F(1.0f) / max(light.area, F(1e-37f))};
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  if (!any(round)) return at;
  const LampSide<F> side = lamp_side(light, b, asking, time);
  const F z = draw_on_lamp_side(side, u.x);
  const Vec3<F> normal = around(side.axis, z, u.y);
  return {select(round, along(side.center, side.radius, normal), at.point), select(round, normal, at.normal),
          select(round, lamp_side_density(side, z), at.density)};
}

/// A given point of the lamp, with its normal and the density with which sample_lamp() would have drawn it.
template <class F>
TYNDALL_INLINE LampPoint<F> lamp_point(const LightColumns<F>& light, const ChainBall<F>& b, Vec3<F> asking, F time,
                                       Vec3<F> point) {
  LampPoint<F> at{point, light.normal, F(1.0f) / max(light.area, F(1e-37f))};
  const auto round = equal(light.kind, IntOf<F>(Lights::sphere));
  if (!any(round)) return at;
  const LampSide<F> side = lamp_side(light, b, asking, time);
  const Vec3<F> normal = normalize(point - side.center);
  return {point, select(round, normal, at.normal),
          select(round, lamp_side_density(side, dot(normal, side.axis)), at.density)};
}

/// Cosine between a lamp's normal and the way back from it, where a ray arrives in `direction`. Flat lamps shine to
/// both sides; spheres shine outward only, so that their cosine is negative for rays that arrive from within.
template <class F>
TYNDALL_INLINE F lamp_cosine(const LightColumns<F>& light, Vec3<F> normal, Vec3<F> direction) {
  const F cosine = -dot(direction, normal);
  return select(equal(light.kind, IntOf<F>(Lights::sphere)), cosine, abs(cosine));
}

}  // namespace tyndall
