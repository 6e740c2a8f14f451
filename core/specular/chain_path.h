#pragma once
#include "core/specular/chain_word.h"
#include "core/trace/lights.h"
#include "core/trace/shade.h"

/// A chain is a way of light from a point of a lamp, through or off a ball, off a flat mirror or through a pane, to a
/// point where light scatters. Here are the points of lamps where chains start, and chains by balls; chain_flat.h and
/// chain_pane.h have the others.
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

/// The plane that holds a chain: that of its two ends and the ball's centre. The near end is the point that asks for
/// light, the far end the lamp's point.
template <class F>
struct ChainPlane {
  Vec3<F> near_out, far_out;    ///< unit, from the centre to each end
  Vec3<F> near_side, far_side;  ///< unit, at right angles to these, turning the short way from the near end to the far
  F near, far;                  ///< distances of the ends from the centre
  F angle, sine;                ///< between the ends, seen from the centre, in [0, pi]; and its sine
};

template <class F>
TYNDALL_INLINE ChainPlane<F> plane_of(const ChainBall<F>& b, Vec3<F> near, Vec3<F> far) {
  const Vec3<F> x = near - b.center, y = far - b.center, normal = cross(x, y);
  ChainPlane<F> plane;
  plane.near = max(length(x), F(1e-30f)), plane.far = max(length(y), F(1e-30f));
  const F twice_area = length(normal);
  plane.near_out = (F(1.0f) / plane.near) * x, plane.far_out = (F(1.0f) / plane.far) * y;
  const Vec3<F> unit = (F(1.0f) / max(twice_area, F(1e-37f))) * normal;
  plane.near_side = cross(unit, plane.near_out), plane.far_side = cross(unit, plane.far_out);
  plane.angle = atan2(twice_area, dot(x, y));
  plane.sine = twice_area / (plane.near * plane.far);
  return plane;
}

/// sqrt(reach² - p²), from the parameter s of the turn (p = most (1 - s²)): exact to rounding even where the way grazes
/// a sphere and the plain difference would cancel.
template <class F>
TYNDALL_INLINE F depth_of(const Turn<F>& turn, F reach, F s) {
  const F drop = turn.most * s * s;
  return sqrt(max(((reach - turn.most) + drop) * (reach + (turn.most - drop)), F(0.0f)));
}

/// dA / dω for the chain of parameter s: times a density per unit of area of the lamp, at the far end, this is the
/// density of the direction at the near end, per steradian. It follows from dω = sin θ dθ dψ with n a sin θ = p at the
/// near end, and dA · cosine = b sin φ dψ · b cos θ' dφ at the far end, where dφ = turn' dp and `cosine` is that of the
/// ray at the lamp. a, b: distances of the ends from the centre. slope: of the turn, by s.
template <class F>
TYNDALL_INLINE F spread_of(const ChainTurn<F>& chain, const ChainEnds<F>& e, F sine, F s, F slope, F cosine) {
  const Turn<F>& turn = chain.turn;
  const F p = max(turn.most * (F(1.0f) - s * s), F(1e-30f));
  const F rate = F(2.0f) * turn.most * s * p * e.far_index * e.far_index;
  const F depths = depth_of(turn, e.near_reach, s) * depth_of(turn, e.far_reach, s);
  return (e.near_reach * e.far_reach * sine) * depths * abs(slope) / (rate * max(cosine, F(1e-30f)));
}

/// Distance that light goes from an end to the surface of the ball that it meets first: from outside to the outer
/// sphere, from within to the wall of the glass or of the hollow in which the end is.
template <class F>
TYNDALL_INLINE F way_to_ball(const ChainBall<F>& b, const Turn<F>& turn, F end, F reach, F sign, F s) {
  const auto out = less(b.radius, end);
  const F index = select(out, F(1.0f), select(b.hollow, b.inner_index, b.index));
  const F wall = index * select(out, b.radius, select(b.hollow, b.inner_radius, b.radius));
  const F from_end = depth_of(turn, reach, s), to_wall = depth_of(turn, wall, s);
  return max(select(out, from_end - to_wall, mul_add(sign, from_end, to_wall)) / index, F(0.0f));
}

/// One of the chains that there are between two points by one word.
template <class F>
struct ChainFound {
  ChainTurn<F> chain;
  EndSigns<F> sign;
  TurnRoot<F> root;
};

/// The parts of a chain between its ends and the ball or mirror, and what it is worth.
template <class F>
struct ChainRays {
  MaskOf<F> found;
  Vec3<F> direction, arrive;  ///< unit: in which a path leaves the near end, and in which it arrives at the lamp
  F near_way, far_way;        ///< distances from each end to the ball
  IntOf<F> wall;              ///< the element to which the near end's way leads
  IntOf<F> from;              ///< Ray::from of the way to the lamp
  F share;                    ///< of light that the surfaces send this way
  F density;                  ///< of the direction at the near end, per steradian, with which it is asked for
  F count;                    ///< inverse of the probability to find this one of several with the same density
  F fog;                      ///< within a pane: its density times the length of the way there
};

// The part of a chain that is within its ball. It is tested only if the ball is crowded: if other surfaces, fog or a
// lamp are in it or reach into it.

/// The way of a chain within its ball. It lies in a plane through the ball's centre; its places are told by their angle
/// about the centre, measured from `out` towards `side`.
template <class F>
struct InsideWay {
  Vec3<F> out, side;  ///< unit
  F p;                ///< Bouguer's invariant
  F angle;            ///< from `out` to where the ball is met first
  MaskOf<F> main;     ///< it is that of the main word
};

/// Puts the ways of the lanes `here` among the others.
template <class F>
TYNDALL_INLINE void put(MaskOf<F> here, const InsideWay<F>& from, InsideWay<F>& to) {
  to.out = select(here, from.out, to.out), to.side = select(here, from.side, to.side);
  to.p = select(here, from.p, to.p), to.angle = select(here, from.angle, to.angle);
  to.main = mask_or(mask_and(here, from.main), mask_and_not(to.main, here));
}

/// The angle about the centre by which light turns between its place next to the centre and the radius reach / n: see
/// Turn. 0 where p > reach, as the light stays above that radius.
template <class F>
TYNDALL_INLINE F turn_above(F p, F reach) {
  const F sine = min(p / max(reach, F(1e-30f)), F(1.0f));
  return acos(sine);
}

/// The way through the ball, seen from the end that is in the ball; from the near end if none is. near_sign, far_sign:
/// see EndSigns. sense: see TurnRoot.
template <class F>
TYNDALL_INLINE InsideWay<F> inside_way(const ChainBall<F>& b, const ChainPlane<F>& plane, const ChainEnds<F>& e,
                                       F near_sign, F far_sign, F sense, F p, const ChainWord<F>& word) {
  const auto from_far = mask_and_not(less(plane.far, b.radius), e.both_out);
  const F reach = select(from_far, e.far_reach, e.near_reach), sign = select(from_far, far_sign, near_sign);
  const F within = select(e.deep, b.inner_index * b.inner_radius, b.index * b.radius);
  const F outside = turn_above(p, reach) - turn_above(p, b.radius);
  const F inside = mul_add(sign, turn_above(p, reach), turn_above(p, within));
  return {select(from_far, plane.far_out, plane.near_out),
          select(from_far, -sense * plane.far_side, sense * plane.near_side), p, select(e.both_out, outside, inside),
          same_word(word, main_word(b, e))};
}

/// The point at `angle` on the sphere of `radius` about the ball's centre.
template <class F>
TYNDALL_INLINE Vec3<F> point_at(const ChainBall<F>& b, const InsideWay<F>& way, F angle, F radius) {
  const F turns = angle * F(static_cast<float>(0.5 / pi));
  const SinCos<F> a = sin_cos_turn(min(max(turns - floor(turns), F(0.0f)), F(0.99999994f)));
  return along(along(b.center, radius * a.cos, way.out), radius * a.sin, way.side);
}

/// Share of light that passes along the way within the ball: below 1 in fog, 0 where a surface is in the way.
/// decisions: those by which the word was drawn, so that the same events follow in the same order.
template <class F>
TYNDALL_INLINE F pass_inside(const auto& s, const ChainBall<F>& b, const ChainEnds<F>& e, InsideWay<F> way,
                             const Decisions<F>& decisions, F time, MaskOf<F> lanes, std::uint32_t& shadow_rays) {
  using I = IntOf<F>;
  WordWalk<F> walk = start_walk(b, e, decisions, way.main);
  walk.open = mask_and(lanes, walk.open);
  auto clear = lanes;
  F share = F(1.0f);
  const F glass = turn_above(way.p, b.index * b.radius);
  const F across = glass - turn_above(way.p, b.index * b.inner_radius);
  const F chord = F(2.0f) * turn_above(way.p, b.inner_index * b.inner_radius);
  I at = select(e.deep, I(1), I(0));  // the sphere that the way is at: 1 is the inner one
  // With an end within the ball way.angle already is that of the first event: the first round does not move.
  auto moves = e.both_out;
  for (int i = 0; i < most_decisions && any(walk.open); ++i) {
    const auto to_outer = equal(walk.next, I(0)), from_outer = equal(at, I(0));
    const auto same = mask_or(mask_and(to_outer, from_outer), mask_not(mask_or(to_outer, from_outer)));
    const F turn = select(same, select(to_outer, F(2.0f) * glass, chord), across);
    const F end = select(moves, way.angle + turn, way.angle);
    const auto here = mask_and(mask_and(clear, walk.open), moves);
    if (any(here)) {
      const Vec3<F> from = point_at(b, way, way.angle, select(from_outer, b.radius, b.inner_radius));
      const Vec3<F> to = point_at(b, way, end, select(to_outer, b.radius, b.inner_radius));
      const F length_of = max(length(to - from), F(1e-30f));
      const auto outward = mask_and_not(to_outer, from_outer);
      const Ray<F> ray{from, (F(1.0f) / length_of) * (to - from), time,
                       select(from_outer, b.outer, b.inner) * I(4) + select(outward, I(0), I(1))};
      shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(here)));
      clear = mask_and_not(clear, call_blocked(s, ray, length_of, select(to_outer, b.outer, b.inner), here));
      if (s.has_media()) share = select(here, share * pass_media(s, ray, length_of, here), share);
    }
    way.angle = end;
    at = select(to_outer, I(0), I(1));
    moves = less(F(-1.0f), F(0.0f));
    step_walk(walk);
  }
  return select(clear, share, F(0.0f));
}

}  // namespace tyndall
