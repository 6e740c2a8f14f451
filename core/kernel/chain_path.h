#pragma once
#include "core/kernel/chain_word.h"
#include "core/kernel/lights.h"
#include "core/kernel/shade.h"

/// A chain is a way of light from a point of a lamp, through or off a ball, to a point where light scatters. The first
/// half of this file draws the lamp's point and describes the chain. The second half is for paths that go such a way by
/// chance: a path that scatters into a ball and then finds a lamp is weighed against the chain that would have found
/// the same light. For that, paths remember where they scattered last and what they have met since (ChainTrail).
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

/// What a path remembers, in scenes with chains, so that a lamp which it finds by chance can be weighed against them.
template <class F>
struct ChainTrail {
  Vec3<F> start;  ///< where the path last scattered at a Lambertian surface or in fog
  F density;      ///< of its direction from there, per steradian, over the probability that it asked for a chain there
  /// What it has met since then. 0: nothing yet. -1: something that no chain meets. Else its bits are numbers: 0-3 of
  /// events at the ball's outer sphere, 4-8 of events at the inner one, 9-12 of reflections there; bit 13 says whether
  /// the path first went away from the ball's centre; from bit 14 on, the ball's index + 1.
  IntOf<F> met;
};

/// The new value of trail.met for lanes that leave the surface of `element`. reflected: those that leave it on the side
/// from which they came.
template <class F>
TYNDALL_INLINE IntOf<F> meet_ball(const SceneView& s, const ChainTrail<F>& trail, const Ray<F>& ray, IntOf<F> element,
                                  MaskOf<F> reflected) {
  using I = IntOf<F>;
  const I code = lookup_int<F>(s.chains.ball_of, s.element_count, element);
  const auto none = mask_or(less(code, I(0)), less(trail.met, I(0)));
  const I safe = select(none, I(0), code);
  const I ball = as_int(shift_right<1>(as_uint(safe)));
  const auto inner = equal(safe & I(1), I(1)), first = equal(trail.met, I(0));
  const Vec3<F> center = load_ball<F>(s.chains, ball, ray.time).center;
  const auto away = mask_and(first, less(F(0.0f), dot(ray.direction, trail.start - center)));
  const I name = as_int(shift_left<14>(as_uint(ball + I(1))));
  const I old = select(first, name + select(away, I(1 << 13), I(0)), select(none, I(0), trail.met));
  const auto other = mask_not(equal(old & I(~((1 << 14) - 1)), name));
  const auto full = mask_or(mask_or(equal(old & I(15), I(15)), equal(old & I(31 << 4), I(31 << 4))),
                            equal(old & I(15 << 9), I(15 << 9)));
  const I event = select(inner, select(reflected, I(16 + 512), I(16)), I(1));
  return select(mask_or(none, mask_or(other, full)), I(-1), old + event);
}

/// Probability with which an event asks for a chain: the light that it may get by balls over the light that it may get
/// from lamps directly, both roughly estimated, and within [0.25, 1]. So little time is spent where chains bring
/// little. 1 where there are too many lamps, or pairs of a ball and a lamp, to estimate.
template <class F>
TYNDALL_INLINE F chain_probability(const SceneView& s, Vec3<F> point) {
  const LightView &pairs = s.chains.choice, &lamps = s.lights;
  if (pairs.count > most_lights_by_contribution || lamps.count > most_lights_by_contribution) return F(1.0f);
  return min(max(total_worth<F>(pairs, point) / total_worth<F>(lamps, point), F(0.25f)), F(1.0f));
}

/// Brings the trail up to date after event `e`: it starts anew where light scattered at a Lambertian surface or in fog,
/// and grows by the surface that was met elsewhere. ray: by which the lanes came to the event. reflected: lanes that
/// leave a surface on the side from which they came. density: of the direction in which they go on, per steradian.
template <class F>
TYNDALL_INLINE void follow_chain(const SceneView& s, ChainTrail<F>& trail, const Ray<F>& ray, const auto& e,
                                 MaskOf<F> reflected, F density) {
  const auto spreads = mask_or(e.medium, mask_and(e.surface, equal(e.kind, IntOf<F>(kind_of<Lambertian<double>>()))));
  const auto goes_on = mask_and(mask_and_not(e.surface, spreads), less_equal(IntOf<F>(0), trail.met));
  if (any(goes_on)) trail.met = select(goes_on, meet_ball(s, trail, ray, e.at.element, reflected), trail.met);
  trail.met = select(spreads, IntOf<F>(0), trail.met);
  trail.start = select(spreads, e.point, trail.start);
  trail.density = select(spreads, density / chain_probability(s, e.point), trail.density);
}

/// Takes the events apart that ChainTrail::met counts.
template <class F>
TYNDALL_INLINE ChainWord<F> word_of(IntOf<F> met) {
  using I = IntOf<F>;
  return {from_int<F>(met & I(15)), from_int<F>(as_int(shift_right<4>(as_uint(met))) & I(31)),
          from_int<F>(as_int(shift_right<9>(as_uint(met))) & I(15))};
}

/// Weight of the light of a lamp that the lanes `lit` found by chance at `point`, after the events of their trail; 1
/// where no chain could have found it. By the power heuristic it is r² / (1 + r²). r is the density with which the path
/// scattered into its direction times the probability that the ball's surfaces sent it this way, over the density with
/// which a chain would have been found there.
template <class F>
[[gnu::noinline]] static F found_by_chance_weight(const SceneView& s, ChainTrail<F> trail, Ray<F> ray, IntOf<F> light,
                                                  Vec3<F> point, MaskOf<F> lit) {
  using I = IntOf<F>;
  auto could = mask_and(mask_and(lit, less_equal(I(0), light)), less(I((1 << 14) - 1), trail.met));
  if (!any(could)) return F(1.0f);
  const ChainView& c = s.chains;
  const I ball = select(could, as_int(shift_right<14>(as_uint(trail.met))) - I(1), I(0));
  const I lamp = select(could, light, I(0));
  const I pair = gather_int<F>(c.pair_of, ball * I(s.lights.count) + lamp);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const ChainBall<F> b = load_ball<F>(c, ball, ray.time);
  const LightColumns<F> columns = load_light<F>(s.lights, lamp);
  const LampPoint<F> at = lamp_point(columns, b, trail.start, ray.time, point);
  const ChainPlane<F> plane = plane_of(b, trail.start, point);
  const ChainEnds<F> ends = ends_of(b, plane.near, plane.far);
  const ChainWord<F> word = word_of<F>(trail.met);
  const auto away = mask_not(equal(trail.met & I(1 << 13), I(0)));
  const EndSigns<F> sign{select(mask_and_not(away, less(b.radius, plane.near)), F(-1.0f), F(1.0f)),
                         select(less(dot(ray.direction, plane.far_out), F(0.0f)), F(-1.0f), F(1.0f))};
  const ChainTurn<F> chain = turn_of(c, b, ends, word, sign);
  const F p = ends.far_reach * length(cross(plane.far_out, ray.direction));
  const F s2 = F(1.0f) - p / chain.turn.most, parameter = sqrt(max(s2, F(1e-12f)));
  could = mask_and(mask_and(could, chain.possible),
                   mask_and(less_equal(F(least_parameter), parameter), less_equal(parameter, chain.turn.last)));
  const F cosine = lamp_cosine(columns, at.normal, ray.direction);
  const F spread = spread_of(chain, ends, plane.sine, parameter, turn_at(chain.turn, parameter).slope, cosine);
  const F probability = choice_probability(c.choice, trail.start, select(could, pair, I(0)));
  const F asked = spread * at.density * probability * word_probability(b, ends, word);
  const F inverse = asked / max(trail.density * share_of(b, ends, word, p), F(1e-37f));
  const auto asks = mask_and(mask_and(could, less(F(0.0f), cosine)), less(F(0.0f), asked));
  return select(asks, F(1.0f) / mul_add(inverse, inverse, F(1.0f)), F(1.0f));
}

}  // namespace tyndall
