#pragma once
#include "core/kernel/chain_trail.h"
#include "core/kernel/event.h"

/// Light that a lamp sends to a point through or off one ball, off one flat mirror or through one pane, such as the
/// bright spot under a glass ball: solved for, where scattering would have to find it by chance. First a ball, mirror
/// or pane and a lamp are chosen, then a point of the lamp, then which surfaces of the ball the light meets and how (of
/// a pane before the point). All chains between the two points that do so are found; one of them, drawn at random, is
/// tested for things in its way, and counts for all.
/// As scattering finds the same paths, both are weighed by the power heuristic.
namespace tyndall {

/// What each lane asks for: light by one ball, mirror or pane from one point of one lamp, and how these lie to each
/// other.
template <class F>
struct ChainAsked {
  LightChoice<F> pair;
  F probability;  ///< that a chain is asked for, by this pair
  ChainBall<F> ball;
  ChainMirror<F> mirror;
  ChainPane<F> pane;
  PaneDrawn<F> way;  ///< through the pane
  MaskOf<F> by_mirror, by_pane;
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
  F count;                    ///< how many like this there are: the inverse of the probability to take this one
  F fog;                      ///< within a pane: its density times the length of the way there
};

/// Draws a way through a pane, and gives the ball within which the lamp sees the asking point over it.
template <class F>
TYNDALL_INLINE ChainBall<F> ask_pane(const auto& s, const Event<F>& e, F time, const Dice<F>& dice, MaskOf<F> lanes,
                                     ChainAsked<F>& a) {
  const ChainView& c = s.chains;
  a.pane = load_pane<F>(
      c, select(a.by_pane, lookup_int<F>(c.ball, c.pairs, a.pair.light) - IntOf<F>(c.first_pane), IntOf<F>(0)));
  const LampBall<F> around = ball_around(a.lamp, time);
  const Vec3<F> normal = select(e.medium, zero3<F>(), e.incident.facing);
  const Pair<F> u{dice.one_alone(dimension::chain_word), dice.one_alone(dimension::chain_root)};
  a.way = draw_pane_word(a.pane, e.point, normal, around, u, mask_and(lanes, a.by_pane));
  return seen_by_pane(a.pane, sight_of(a.pane, e.point, around.center, a.way.word.across), a.way.word);
}

template <class F>
TYNDALL_INLINE ChainAsked<F> ask_chain(const auto& s, const Event<F>& e, F time, const Dice<F>& dice, MaskOf<F> lanes) {
  const ChainView& c = s.chains;
  const Vec3<F> point = e.point;
  ChainAsked<F> a{};
  a.pair = choose_light(c, point, dice.one_alone(dimension::chain_pair));
  a.probability = chain_probability(s, point) * a.pair.probability;
  const IntOf<F> ball = lookup_int<F>(c.ball, c.pairs, a.pair.light), mirror = ball - IntOf<F>(c.first_mirror);
  a.ball = load_ball<F>(c, ball, time);
  a.light = lookup_int<F>(c.light, c.pairs, a.pair.light);
  a.lamp = load_light<F>(s.lights, a.light);
  a.by_pane = less_equal(IntOf<F>(c.first_pane), ball);
  a.by_mirror = mask_and_not(less_equal(IntOf<F>(0), mirror), a.by_pane);
  if (c.has_mirrors()) {
    a.mirror = load_mirror<F>(c, select(a.by_mirror, mirror, IntOf<F>(0)));
    a.ball.center = select(a.by_mirror, mirrored(a.mirror, point), a.ball.center);  // see seen_by_mirror()
  }
  Vec3<F> asking = point;
  if (c.has_panes() && any(mask_and(lanes, a.by_pane))) {
    const ChainBall<F> seen = ask_pane(s, e, time, dice, lanes, a);
    a.ball.center = select(a.by_pane, seen.center, a.ball.center);
    a.ball.radius = select(a.by_pane, seen.radius, a.ball.radius);
    asking = select(a.by_pane, seen.center, asking);
  }
  a.at = sample_lamp(a.lamp, a.ball, asking, time, dice.pair(dimension::chain_point));
  if (!c.has_balls()) return a;
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
TYNDALL_INLINE ChainRays<F> rays_of(const ChainAsked<F>& a, const ChainWord<F>& word, const ChainFound<F>& c) {
  const Turn<F>& turn = c.chain.turn;
  const F p = turn.most * (F(1.0f) - c.s * c.s);
  const auto ray = [&](F reach, F side, Vec3<F> out, Vec3<F> across) __attribute__((always_inline)) {
    const F inverse = F(1.0f) / reach, cosine = depth_of(turn, reach, c.s) * inverse;
    return along((side * cosine) * out, c.sense * p * inverse, across);
  };
  ChainRays<F> r;
  r.found = c.found, r.count = c.count, r.fog = F(0.0f);
  r.direction = ray(a.ends.near_reach, -c.sign.near, a.plane.near_out, a.plane.near_side);
  r.arrive = ray(a.ends.far_reach, c.sign.far, a.plane.far_out, a.plane.far_side);
  r.near_way = way_to_ball(a.ball, turn, a.ends.near, a.ends.near_reach, c.sign.near, c.s);
  r.far_way = way_to_ball(a.ball, turn, a.ends.far, a.ends.far_reach, c.sign.far, c.s);
  const IntOf<F> wall = select(a.ends.deep, a.ball.inner, a.ball.outer);
  const auto near_in = less(a.plane.near, a.ball.radius), far_in = less(a.plane.far, a.ball.radius);
  r.wall = select(near_in, wall, a.ball.outer);
  r.from = select(far_in, wall, a.ball.outer) * IntOf<F>(4) + select(far_in, IntOf<F>(1), IntOf<F>(0));
  r.share = share_of(a.ball, a.ends, word, p);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, r.arrive);
  const F spread = spread_of(c.chain, a.ends, a.plane.sine, c.s, c.slope, cosine);
  r.density = spread * a.at.density * (a.probability * word_probability(a.ball, a.ends, word));
  return r;
}

/// Puts the chains of `lanes`, which ask for a mirror, among the others.
template <class F>
TYNDALL_INLINE void add_mirrored(const ChainAsked<F>& a, Vec3<F> point, MaskOf<F> lanes, ChainRays<F>& r) {
  const MirrorWay<F> way = mirror_way(a.mirror, point, a.at.point);
  r.found = mask_or(mask_and(lanes, way.found), mask_and_not(r.found, lanes));
  r.direction = select(lanes, way.direction, r.direction), r.arrive = select(lanes, way.arrive, r.arrive);
  r.near_way = select(lanes, way.near_way, r.near_way), r.far_way = select(lanes, way.far_way, r.far_way);
  const IntOf<F> side = select(way.behind, IntOf<F>(1), IntOf<F>(0));
  r.wall = select(lanes, a.ball.outer, r.wall), r.from = select(lanes, a.ball.outer * IntOf<F>(4) + side, r.from);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, way.arrive);
  const F density = way.spread / max(cosine, F(1e-30f)) * a.at.density * a.probability;
  r.density = select(lanes, density, r.density);
  r.share = select(lanes, F(1.0f), r.share), r.count = select(lanes, F(1.0f), r.count);
}

/// Puts the chains of `lanes`, which ask for a pane, among the others.
template <class F>
TYNDALL_INLINE void add_through_pane(const ChainAsked<F>& a, Vec3<F> point, MaskOf<F> lanes, ChainRays<F>& r) {
  const PaneSight<F> s = sight_of(a.pane, point, a.at.point, a.way.word.across);
  const PaneWay<F> way = pane_way(a.pane, s, a.way.word);
  r.found = mask_or(mask_and(lanes, way.found), mask_and_not(r.found, lanes));
  r.direction = select(lanes, way.direction, r.direction), r.arrive = select(lanes, way.arrive, r.arrive);
  r.near_way = select(lanes, way.near_way, r.near_way), r.far_way = select(lanes, way.far_way, r.far_way);
  const IntOf<F> lower = a.pane.element + a.way.word.across + a.way.word.across, one = IntOf<F>(1);
  const IntOf<F> first = select(less(F(0.0f), s.near.height), lower + one, lower);
  const IntOf<F> last = select(less(F(0.0f), s.far.height), lower + one, lower);
  r.wall = select(lanes, first, r.wall), r.from = select(lanes, last * IntOf<F>(4), r.from);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, way.arrive);
  const F density = way.spread / max(cosine, F(1e-30f)) * a.at.density * a.probability;
  r.density = select(lanes, density, r.density), r.share = select(lanes, way.share, r.share);
  r.count = select(lanes, F(1.0f) / max(a.way.probability, F(1e-30f)), r.count);
  r.fog = select(lanes, a.pane.fog * way.within, r.fog);
}

/// A chain for each lane.
template <class F>
struct ChainLooked {
  ChainRays<F> rays;
  Decisions<F> decisions;  ///< of the word
  ChainFound<F> chain;     ///< by a ball
};

template <class F>
TYNDALL_INLINE ChainLooked<F> look_for_chain(const auto& s, const Paths<F>& p, const Event<F>& e,
                                             const ChainAsked<F>& a, MaskOf<F> lanes) {
  ChainLooked<F> out{};
  out.rays.found = less(F(1.0f), F(0.0f));
  out.decisions = {p.dice.alone(dimension::chain_word), p.dice.alone(dimension::chain_word_tail)};
  const IntOf<F> events_left = IntOf<F>(s.max_depth) - p.depth;
  const auto by_mirror = mask_and(mask_and(lanes, a.by_mirror), less(IntOf<F>(1), events_left));
  if (s.chains.has_balls()) {
    const auto valid = mask_and(a.ends.valid, less(F(1e-7f), a.plane.sine));
    const DrawnWord<F> drawn = draw_word(a.ball, a.ends, out.decisions);
    const auto fits = less(to_int(drawn.word.outer + drawn.word.inner), events_left);
    const auto by_ball = mask_and_not(mask_and_not(lanes, a.by_mirror), a.by_pane);
    const auto here = mask_and(mask_and(by_ball, valid), mask_and(drawn.drawn, fits));
    if (any(here)) {
      out.chain = find_chain(s, a, drawn.word, p.dice.one_alone(dimension::chain_root), here);
      out.rays = rays_of(a, drawn.word, out.chain);
    }
  }
  if (s.chains.has_mirrors() && any(by_mirror)) add_mirrored(a, e.point, by_mirror, out.rays);
  if (!s.chains.has_panes()) return out;
  const PaneWord<F>& word = a.way.word;
  const F events = word.crossings + F(1.0f) + abs(word.image[0]) + abs(word.image[1]);
  const auto by_pane = mask_and(mask_and(mask_and(lanes, a.by_pane), a.way.drawn), less(to_int(events), events_left));
  if (any(by_pane)) add_through_pane(a, e.point, by_pane, out.rays);
  return out;
}

/// The factor by which the lamp's radiance counts if nothing is in the way, the weight of the power heuristic included.
template <class F>
TYNDALL_INLINE F weight_of(const auto& s, const Paths<F>& p, const Event<F>& e, const ChainAsked<F>& a,
                           const ChainRays<F>& rays) {
  const F cosine = lamp_cosine(a.lamp, a.at.normal, rays.arrive);
  const F scattered = scattered_density(s, p, e, rays.direction) * rays.share;
  const auto useful = mask_and(mask_and(rays.found, less(F(0.0f), cosine)), less(F(0.0f), scattered));
  const F ratio = scattered / max(rays.density, F(1e-37f));
  // 0 at a caustic's edge, where the density is 0.
  const F weight = rays.count / (ratio + F(1.0f) / max(ratio, F(1e-37f)));
  return select(mask_and(useful, less(weight, F(1e30f))), weight, F(0.0f));
}

/// Light that reaches events at Lambertian surfaces and in fog by chains, times what the path carries. Each test for
/// things in the way adds one to shadow_rays.
template <class F>
[[gnu::noinline]] static Vec3<F> chain_light(const SceneView& s, const Paths<F>& p, const Event<F>& e, MaskOf<F> lanes,
                                             std::uint32_t& shadow_rays) {
  const ChainAsked<F> a = ask_chain<F>(s, e, p.ray.time, p.dice, lanes);
  const ChainLooked<F> looked = look_for_chain(s, p, e, a, lanes);
  const ChainRays<F>& found = looked.rays;
  if (!any(found.found)) return zero3<F>();
  F weight = weight_of(s, p, e, a, found);
  auto arrives = less(F(0.0f), weight);
  if (!any(arrives)) return zero3<F>();
  const IntOf<F> lamp = lookup_int<F>(s.lights.element, s.lights.count, a.light);
  const Ray<F> near{e.point, found.direction, p.ray.time, e.from};
  const Ray<F> far{along(a.at.point, -found.far_way, found.arrive), found.arrive, p.ray.time, found.from};
  for (int leg = 0; leg < 2; ++leg) {
    const Ray<F>& ray = leg == 0 ? near : far;
    const F way = leg == 0 ? found.near_way : found.far_way;
    shadow_rays += static_cast<std::uint32_t>(__builtin_popcount(bits(arrives)));
    arrives = mask_and_not(arrives, call_blocked(s, ray, way, leg == 0 ? found.wall : lamp, arrives));
    if (!any(arrives)) return zero3<F>();
    if (s.has_media()) weight = weight * pass_media(s, ray, way, arrives);
  }
  if (s.has_media() && s.chains.has_panes()) weight = weight * transmittance(found.fog);
  const auto crowded = mask_and(arrives, a.ball.crowded);
  if (s.chains.crowds && any(crowded)) {
    const ChainFound<F>& c = looked.chain;
    const InsideWay<F> way = inside_way(a.ball, a.plane, a.ends, c.sign.near, c.sign.far, c.sense,
                                        c.chain.turn.most * (F(1.0f) - c.s * c.s));
    const F passes = pass_inside(s, a.ball, a.ends, way, looked.decisions, p.ray.time, crowded, shadow_rays);
    weight = select(crowded, weight * passes, weight);
  }
  Vec3<F> colour = light_radiance(s, lamp, a.at.point, arrives);
  const auto metal = mask_and(arrives, a.ball.mirror);
  if (any(metal)) {
    const SurfacePoint<F> at = surface_at(s, near, found.near_way, found.wall);
    colour = select(metal, colour * surface_colour(s, at, metal), colour);
  }
  return select(arrives, weight * (p.throughput * e.colour * colour), zero3<F>());
}

}  // namespace tyndall
