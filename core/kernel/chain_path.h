#pragma once
#include "core/kernel/chain_mirror.h"
#include "core/kernel/shade.h"

/// A chain is a way of light from a point of a lamp, through or off a ball or off a flat mirror, to a point where light
/// scatters. The first half of this file describes chains by balls; chain_mirror.h has the others. The second half is
/// for paths that go such a way by chance: a path that scatters into a ball or mirror and then finds a lamp is weighed
/// against the chain that would have found the same light. For that, paths remember where they scattered last and what
/// they have met since (ChainTrail).
namespace tyndall {

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

// The part of a chain that is within its ball. It is tested only if the ball is crowded: if other surfaces, fog or a
// lamp are in it or reach into it.

/// The way of a chain within its ball. It lies in a plane through the ball's centre; its places are told by their angle
/// about the centre, measured from `out` towards `side`.
template <class F>
struct InsideWay {
  Vec3<F> out, side;  ///< unit
  F p;                ///< Bouguer's invariant
  F angle;            ///< from `out` to where the ball is met first
};

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
                                       F near_sign, F far_sign, F sense, F p) {
  const auto from_far = mask_and_not(less(plane.far, b.radius), e.both_out);
  const F reach = select(from_far, e.far_reach, e.near_reach), sign = select(from_far, far_sign, near_sign);
  const F within = select(e.deep, b.inner_index * b.inner_radius, b.index * b.radius);
  const F outside = turn_above(p, reach) - turn_above(p, b.radius);
  const F inside = mul_add(sign, turn_above(p, reach), turn_above(p, within));
  return {select(from_far, plane.far_out, plane.near_out),
          select(from_far, -sense * plane.far_side, sense * plane.near_side), p, select(e.both_out, outside, inside)};
}

/// The point at `angle` on the sphere of `radius` about the ball's centre.
template <class F>
TYNDALL_INLINE Vec3<F> point_at(const ChainBall<F>& b, const InsideWay<F>& way, F angle, F radius) {
  const F turns = angle * F(static_cast<float>(0.5 / pi));
  const SinCos<F> a = sin_cos_turn(min(max(turns - floor(turns), F(0.0f)), F(0.99999994f)));
  return along(along(b.center, radius * a.cos, way.out), radius * a.sin, way.side);
}

/// Share of light that passes along the way within the ball: below 1 in fog, 0 where a surface is in the way. digits:
/// those from which the word was drawn, so that the same events follow in the same order.
template <class F>
TYNDALL_INLINE F pass_inside(const auto& s, const ChainBall<F>& b, const ChainEnds<F>& e, InsideWay<F> way,
                             UintOf<F> digits, F time, MaskOf<F> lanes, std::uint32_t& shadow_rays) {
  using I = IntOf<F>;
  WordWalk<F> walk = start_walk(b, e, digits);
  walk.decide.digits = select(walk.main, UintOf<F>(0xffffffffu), walk.decide.digits);
  walk.open = mask_and(lanes, mask_and_not(mask_or(walk.open, walk.main), b.mirror));
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

/// What a path remembers, in scenes with chains, so that a lamp which it finds by chance can be weighed against them.
template <class F>
struct ChainTrail {
  Vec3<F> start;  ///< where the path last scattered at a Lambertian surface or in fog
  F density;      ///< of its direction from there, per steradian, over the probability that it asked for a chain there
  /// What it has met since then. 0: nothing yet. -1: something that no chain meets. Else its bits are numbers: 0-3 of
  /// events at the ball's outer sphere, 4-8 of events at the inner one, 9-12 of reflections there; bit 13 says whether
  /// the path first went away from the ball's centre; from bit 14 on, the ball's index + 1. A flat mirror is a ball
  /// here: see Chains.
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

/// Probability with which an event asks for a chain: the light that it may get by chains over the light that it may get
/// from lamps directly, both roughly estimated, and within [0.25, 1]. So little time is spent where chains bring
/// little. 1 where there are too many lamps, or pairs of a ball and a lamp, to estimate.
template <class F>
[[gnu::noinline]] static F chain_probability(const SceneView& s, Vec3<F> point) {
  const LightView &pairs = s.chains.choice, &lamps = s.lights;
  if (pairs.count > most_lights_by_contribution || lamps.count > most_lights_by_contribution) return F(1.0f);
  return min(max(total_worth(s.chains, point) / total_worth(lamps, point), F(0.25f)), F(1.0f));
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

/// The chain that would have found what a path found by chance.
template <class F>
struct ChainByChance {
  MaskOf<F> could;  ///< there is one
  F density;        ///< of its direction where it starts, per steradian, once its pair and its word are chosen
  F word;           ///< probability of its word
  F share;          ///< of light that the surfaces send this way
};

template <class F>
TYNDALL_INLINE ChainByChance<F> ball_by_chance(const ChainView& c, const ChainTrail<F>& trail, const Ray<F>& ray,
                                               IntOf<F> ball, const LightColumns<F>& lamp, Vec3<F> point) {
  using I = IntOf<F>;
  const ChainBall<F> b = load_ball<F>(c, ball, ray.time);
  const LampPoint<F> at = lamp_point(lamp, b, trail.start, ray.time, point);
  const ChainPlane<F> plane = plane_of(b, trail.start, point);
  const ChainEnds<F> ends = ends_of(b, plane.near, plane.far);
  const ChainWord<F> word = word_of<F>(trail.met);
  const auto away = mask_not(equal(trail.met & I(1 << 13), I(0)));
  const EndSigns<F> sign{select(mask_and_not(away, less(b.radius, plane.near)), F(-1.0f), F(1.0f)),
                         select(less(dot(ray.direction, plane.far_out), F(0.0f)), F(-1.0f), F(1.0f))};
  const ChainTurn<F> chain = turn_of(c, b, ends, word, sign);
  const F p = ends.far_reach * length(cross(plane.far_out, ray.direction));
  const F s2 = F(1.0f) - p / chain.turn.most, parameter = sqrt(max(s2, F(1e-12f)));
  const auto could = mask_and(
      chain.possible, mask_and(less_equal(F(least_parameter), parameter), less_equal(parameter, chain.turn.last)));
  const F cosine = lamp_cosine(lamp, at.normal, ray.direction);
  const F spread = spread_of(chain, ends, plane.sine, parameter, turn_at(chain.turn, parameter).slope, cosine);
  return {mask_and(could, less(F(0.0f), cosine)), spread * at.density, word_probability(b, ends, word),
          share_of(b, ends, word, p)};
}

template <class F>
TYNDALL_INLINE ChainByChance<F> mirror_by_chance(const ChainView& c, const ChainTrail<F>& trail, const Ray<F>& ray,
                                                 IntOf<F> mirror, const LightColumns<F>& lamp, Vec3<F> point) {
  const ChainMirror<F> m = load_mirror<F>(c, mirror);
  const LampPoint<F> at = lamp_point(lamp, seen_by_mirror(m, trail.start), trail.start, ray.time, point);
  const MirrorWay<F> way = mirror_way(m, trail.start, point);
  const F cosine = lamp_cosine(lamp, at.normal, ray.direction);
  return {mask_and(way.found, less(F(0.0f), cosine)), way.spread / max(cosine, F(1e-30f)) * at.density, F(1.0f),
          F(1.0f)};
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
  const LightColumns<F> columns = load_light<F>(s.lights, lamp);
  ChainByChance<F> chain{less(F(1.0f), F(0.0f)), F(0.0f), F(0.0f), F(0.0f)};
  if (c.has_balls()) chain = ball_by_chance(c, trail, ray, ball, columns, point);
  const I mirror = ball - I(c.first_mirror);
  const auto is_mirror = mask_and(could, less_equal(I(0), mirror));
  if (c.has_mirrors() && any(is_mirror)) {
    const auto other = mirror_by_chance(c, trail, ray, select(is_mirror, mirror, I(0)), columns, point);
    chain.could = mask_or(mask_and(is_mirror, other.could), mask_and_not(chain.could, is_mirror));
    chain.density = select(is_mirror, other.density, chain.density);
    chain.word = select(is_mirror, other.word, chain.word), chain.share = select(is_mirror, other.share, chain.share);
  }
  const F probability = choice_probability(c, trail.start, select(could, pair, I(0)));
  const F asked = chain.density * probability * chain.word;
  const F inverse = asked / max(trail.density * chain.share, F(1e-37f));
  const auto asks = mask_and(mask_and(could, chain.could), less(F(0.0f), asked));
  return select(asks, F(1.0f) / mul_add(inverse, inverse, F(1.0f)), F(1.0f));
}

}  // namespace tyndall
