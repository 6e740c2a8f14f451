#pragma once
#include "core/kernel/chain_path.h"
#include "core/kernel/event.h"

/// Light that a lamp sends to a point through or off one ball, such as the bright spot under a glass ball: solved for,
/// where scattering would have to find it by chance. First a ball and a lamp are chosen, then a point of the lamp, then
/// which surfaces of the ball the light meets and how. All chains between the two points that do so are found; one of
/// them, drawn at random, is tested for things in its way, and counts for all. As scattering finds the same paths, both
/// are weighed by the power heuristic.
namespace tyndall {

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

/// What each lane asks for: light by one ball from one point of one lamp, and how these lie to each other.
template <class F>
struct ChainAsked {
  LightChoice<F> pair;
  ChainBall<F> ball;
  IntOf<F> light;
  LightColumns<F> lamp;
  LampPoint<F> at;
  ChainPlane<F> plane;
  ChainEnds<F> ends;
};

/// One chain, drawn from all that there are between two points by one word.
template <class F>
struct ChainFound {
  MaskOf<F> found;
  ChainTurn<F> chain;
  EndSigns<F> sign;
  F s, slope, sense;  ///< see TurnRoot
  F count;            ///< how many there are
};

/// The parts of a chain between its ends and the ball.
template <class F>
struct ChainRays {
  Vec3<F> direction, arrive;  ///< unit: in which a path leaves the near end, and in which it arrives at the lamp
  F near_way, far_way;        ///< distances from each end to the ball
};

template <class F>
TYNDALL_INLINE ChainAsked<F> ask_chain(const auto& s, Vec3<F> point, F time, const Dice<F>& dice) {
  const ChainView& c = s.chains;
  ChainAsked<F> a;
  a.pair = choose_light(c.choice, point, dice.one_alone(dimension::chain_pair));
  a.ball = load_ball<F>(c, lookup_int<F>(c.ball, c.pairs, a.pair.light), time);
  a.light = lookup_int<F>(c.light, c.pairs, a.pair.light);
  a.lamp = load_light<F>(s.lights, a.light);
  a.at = sample_lamp(a.lamp, a.ball, point, time, dice.pair(dimension::chain_point));
  a.plane = plane_of(a.ball, point, a.at.point);
  a.ends = ends_of(a.ball, a.plane.near, a.plane.far);
  return a;
}

/// Density, per steradian, with which an event that asks for chains (at a Lambertian surface or in fog) scatters into a
/// direction.
template <class F>
TYNDALL_INLINE F scattered_density(const auto& s, const Paths<F>& p, const Event<F>& e, Vec3<F> direction) {
  const F diffuse = density(Lambertian<F>{}, e.incident, direction);
  if (!s.has_media() || !any(e.medium)) return diffuse;
  return select(e.medium, phase_density(s, e.g, p.ray.direction, direction), diffuse);
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

/// Finds all chains of a word between the two points, and takes one of them. For an end within the ball both signs are
/// tried (see EndSigns). pick: a random number in [0, 1).
template <class F>
TYNDALL_INLINE ChainFound<F> find_chain(const auto& s, const ChainAsked<F>& a, const ChainWord<F>& word, F pick,
                                        MaskOf<F> lanes) {
  ChainFound<F> out;
  out.sign = {F(1.0f), F(1.0f)};
  out.chain = turn_of(s.chains, a.ball, a.ends, word, out.sign);
  const auto here = mask_and(lanes, out.chain.possible), one_in = mask_and_not(here, a.ends.both_out);
  TurnRoots<F> roots = list_roots(out.chain.turn, a.plane.angle, here);
  out.count = roots.count;
  if (!any(one_in)) {
    const TurnRoot<F> root = take_root(out.chain.turn, roots, a.plane.angle, floor(pick * out.count));
    out.found = root.found, out.s = root.s, out.slope = root.slope, out.sense = root.sense;
    return out;
  }
  const auto near_in = less(a.plane.near, a.ball.radius);
  const EndSigns<F> flipped{select(near_in, F(-1.0f), F(1.0f)), select(near_in, F(1.0f), F(-1.0f))};
  const ChainTurn<F> other = turn_of(s.chains, a.ball, a.ends, word, flipped);
  const TurnRoots<F> others = list_roots(other.turn, a.plane.angle, one_in);
  out.count = roots.count + others.count;
  F index = floor(pick * out.count);
  const auto second = less_equal(roots.count, index);
  index = select(second, index - roots.count, index);
  choose(second, others, roots);
  for (int i = 0; i < 2; ++i) out.chain.turn.times[i] = select(second, other.turn.times[i], out.chain.turn.times[i]);
  out.sign = {select(second, flipped.near, F(1.0f)), select(second, flipped.far, F(1.0f))};
  const TurnRoot<F> root = take_root(out.chain.turn, roots, a.plane.angle, index);
  out.found = root.found, out.s = root.s, out.slope = root.slope, out.sense = root.sense;
  return out;
}

template <class F>
TYNDALL_INLINE ChainRays<F> rays_of(const ChainAsked<F>& a, const ChainFound<F>& c) {
  const Turn<F>& turn = c.chain.turn;
  const F p = turn.most * (F(1.0f) - c.s * c.s);
  const auto ray = [&](F reach, F side, Vec3<F> out, Vec3<F> across) __attribute__((always_inline)) {
    const F inverse = F(1.0f) / reach, cosine = depth_of(turn, reach, c.s) * inverse;
    return along((side * cosine) * out, c.sense * p * inverse, across);
  };
  return {ray(a.ends.near_reach, -c.sign.near, a.plane.near_out, a.plane.near_side),
          ray(a.ends.far_reach, c.sign.far, a.plane.far_out, a.plane.far_side),
          way_to_ball(a.ball, turn, a.ends.near, a.ends.near_reach, c.sign.near, c.s),
          way_to_ball(a.ball, turn, a.ends.far, a.ends.far_reach, c.sign.far, c.s)};
}

/// The factor by which the lamp's radiance counts if nothing is in the way, the weight of the power heuristic included.
template <class F>
TYNDALL_INLINE F weight_of(const auto& s, const Paths<F>& p, const Event<F>& e, const ChainAsked<F>& a,
                           const ChainWord<F>& word, const ChainFound<F>& c, const ChainRays<F>& rays) {
  const Turn<F>& turn = c.chain.turn;
  const F cosine = lamp_cosine(a.lamp, a.at.normal, rays.arrive);
  const F share = share_of(a.ball, a.ends, word, turn.most * (F(1.0f) - c.s * c.s));
  const F scattered = scattered_density(s, p, e, rays.direction) * share;
  const auto useful = mask_and(mask_and(c.found, less(F(0.0f), cosine)), less(F(0.0f), scattered));
  if (!any(useful)) return F(0.0f);
  const F spread = spread_of(c.chain, a.ends, a.plane.sine, c.s, c.slope, cosine);
  const F probability = chain_probability(s, e.point) * a.pair.probability * word_probability(a.ball, a.ends, word);
  const F asked = spread * a.at.density * probability;
  const F ratio = scattered / max(asked, F(1e-37f));
  const F weight = c.count / (ratio + F(1.0f) / max(ratio, F(1e-37f)));  // 0 at a caustic's edge, where asked is 0
  return select(mask_and(useful, less(weight, F(1e30f))), weight, F(0.0f));
}

/// Light that reaches events at Lambertian surfaces and in fog by chains, times what the path carries. Each test for
/// things in the way adds one to shadow_rays.
template <class F>
[[gnu::noinline]] static Vec3<F> chain_light(const SceneView& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                             std::uint32_t& shadow_rays) {
  const ChainAsked<F> a = ask_chain<F>(s, e.point, p.ray.time, p.dice);
  const auto asked = mask_and(lanes, mask_and(a.ends.valid, less(F(1e-7f), a.plane.sine)));
  if (!any(asked)) return zero3<F>();
  const UintOf<F> digits = p.dice.alone(dimension::chain_word);
  const DrawnWord<F> drawn = draw_word(a.ball, a.ends, digits);
  const auto fits = less(to_int(drawn.word.outer + drawn.word.inner), IntOf<F>(s.max_depth) - p.depth);
  const ChainFound<F> chain = find_chain(s, a, drawn.word, p.dice.one_alone(dimension::chain_root),
                                         mask_and(mask_and(asked, drawn.drawn), fits));
  if (!any(chain.found)) return zero3<F>();
  const ChainRays<F> found = rays_of(a, chain);
  F weight = weight_of(s, p, e, a, drawn.word, chain, found);
  const auto useful = less(F(0.0f), weight);
  if (!any(useful)) return zero3<F>();
  const IntOf<F> four = IntOf<F>(4), in = IntOf<F>(1);
  const IntOf<F> wall = select(a.ends.deep, a.ball.inner, a.ball.outer);
  const auto near_in = less(a.plane.near, a.ball.radius), far_in = less(a.plane.far, a.ball.radius);
  const IntOf<F> near_wall = select(near_in, wall, a.ball.outer), far_wall = select(far_in, wall, a.ball.outer);
  const IntOf<F> lamp = lookup_int<F>(s.lights.element, s.lights.count, a.light);
  const Ray<F> near{e.point, found.direction, p.ray.time, e.from};
  const Ray<F> far{along(a.at.point, -found.far_way, found.arrive), found.arrive, p.ray.time,
                   far_wall * four + select(far_in, in, IntOf<F>(0))};
  auto arrives = useful;
  for (int leg = 0; leg < 2; ++leg) {
    const Ray<F>& ray = leg == 0 ? near : far;
    const F way = leg == 0 ? found.near_way : found.far_way;
    shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(arrives)));
    arrives = mask_and_not(arrives, call_blocked(s, ray, way, leg == 0 ? near_wall : lamp, arrives));
    if (!any(arrives)) return zero3<F>();
    if (s.has_media()) weight = weight * pass_media(s, ray, way, arrives);
  }
  const auto crowded = mask_and(arrives, a.ball.crowded);
  if (s.chains.crowds && any(crowded)) {
    const F p_there = chain.chain.turn.most * (F(1.0f) - chain.s * chain.s);
    const InsideWay<F> way = inside_way(a.ball, a.plane, a.ends, chain.sign.near, chain.sign.far, chain.sense, p_there);
    const F passes = pass_inside(s, a.ball, a.ends, way, digits, p.ray.time, crowded, shadow_rays);
    weight = select(crowded, weight * passes, weight);
  }
  Vec3<F> colour = light_radiance(s, lamp, a.at.point, arrives);
  const auto metal = mask_and(arrives, a.ball.mirror);
  if (any(metal)) {
    const SurfacePoint<F> at = surface_at(s, near, found.near_way, a.ball.outer);
    colour = select(metal, colour * surface_colour(s, at, metal), colour);
  }
  return select(arrives, weight * (p.throughput * e.colour * colour), zero3<F>());
}

}  // namespace tyndall
