#pragma once
#include "core/base/reservoir.h"
#include "core/specular/chain_trail.h"
#include "core/specular/request.h"

/// Light that a lamp sends to a point through or off one ball, one flat mirror or one pane, such as the bright spot
/// under a glass ball: solved for, where scattering would have to find it by chance. First a ball, mirror or pane and a
/// lamp are chosen, then points of the lamp and for each the surfaces that the light meets, and how (of a pane before
/// the points). Of all chains that do so one, drawn in proportion to what each would bring if nothing were in its way,
/// is tested for things in its way, and counts for all. As scattering finds the same paths, both are weighed by the
/// power heuristic.
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
  Vec3<F> asking;  ///< the point that asks for light, as seen from the lamp
  LampPoint<F> at;
  ChainPlane<F> plane;
  ChainEnds<F> ends;
};

/// Draws a way through a pane, and gives the ball within which the lamp sees the asking point over it.
template <class F>
TYNDALL_INLINE ChainBall<F> ask_pane(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes, ChainAsked<F>& a) {
  const ChainView& c = s.chains;
  a.pane = load_pane<F>(
      c, select(a.by_pane, lookup_int<F>(c.ball, c.pairs, a.pair.light) - IntOf<F>(c.first_pane), IntOf<F>(0)));
  const LampBall<F> around = ball_around(a.lamp, q.time);
  const Vec3<F> normal = select(q.in_medium, zero3<F>(), q.facing);
  const Pair<F> u{q.dice.one_alone(dimension::chain_word), q.dice.one_alone(dimension::chain_root)};
  a.way = draw_pane_word(a.pane, q.point, normal, around, u, mask_and(lanes, a.by_pane));
  return seen_by_pane(a.pane, sight_of(a.pane, q.point, around.center, a.way.word.across), a.way.word);
}

template <class F>
TYNDALL_INLINE ChainAsked<F> ask_chain(const auto& s, const SpecularRequest<F>& q, MaskOf<F> lanes) {
  const ChainView& c = s.chains;
  const Vec3<F> point = q.point;
  ChainAsked<F> a{};
  a.pair = choose_light(c, point, q.dice.one_alone(dimension::chain_pair));
  a.probability = chain_probability(s, point) * a.pair.probability;
  const IntOf<F> ball = lookup_int<F>(c.ball, c.pairs, a.pair.light), mirror = ball - IntOf<F>(c.first_mirror);
  a.ball = load_ball<F>(c, ball, q.time);
  a.light = lookup_int<F>(c.light, c.pairs, a.pair.light);
  a.lamp = load_light<F>(s.lights, a.light);
  a.by_pane = less_equal(IntOf<F>(c.first_pane), ball);
  a.by_mirror = mask_and_not(less_equal(IntOf<F>(0), mirror), a.by_pane);
  if (c.has_mirrors()) {
    a.mirror = load_mirror<F>(c, select(a.by_mirror, mirror, IntOf<F>(0)));
    a.ball.center = select(a.by_mirror, mirrored(a.mirror, point), a.ball.center);  // see seen_by_mirror()
  }
  a.asking = point;
  if (c.has_panes() && any(mask_and(lanes, a.by_pane))) {
    const ChainBall<F> seen = ask_pane(s, q, lanes, a);
    a.ball.center = select(a.by_pane, seen.center, a.ball.center);
    a.ball.radius = select(a.by_pane, seen.radius, a.ball.radius);
    a.asking = select(a.by_pane, seen.center, a.asking);
  }
  return a;
}

/// Draws the point of the lamp with which `a` goes on.
template <class F>
TYNDALL_INLINE void aim_at_lamp(const auto& s, Vec3<F> point, F time, Pair<F> u, ChainAsked<F>& a) {
  a.at = sample_lamp(a.lamp, a.ball, a.asking, time, u);
  if (!s.chains.has_balls()) return;
  a.plane = plane_of(a.ball, point, a.at.point);
  a.ends = ends_of(a.ball, a.plane.near, a.plane.far);
}

template <class F>
TYNDALL_INLINE ChainRays<F> rays_of(const ChainAsked<F>& a, const ChainWord<F>& word, const ChainFound<F>& c) {
  const Turn<F>& turn = c.chain.turn;
  const F at = c.root.s, p = turn.most * (F(1.0f) - at * at);
  const auto ray = [&](F reach, F side, Vec3<F> out, Vec3<F> across) __attribute__((always_inline)) {
    const F inverse = F(1.0f) / reach, cosine = depth_of(turn, reach, at) * inverse;
    return along((side * cosine) * out, c.root.sense * p * inverse, across);
  };
  ChainRays<F> r;
  r.found = c.root.found, r.count = F(1.0f), r.fog = F(0.0f);
  r.direction = ray(a.ends.near_reach, -c.sign.near, a.plane.near_out, a.plane.near_side);
  r.arrive = ray(a.ends.far_reach, c.sign.far, a.plane.far_out, a.plane.far_side);
  r.near_way = way_to_ball(a.ball, turn, a.ends.near, a.ends.near_reach, c.sign.near, at);
  r.far_way = way_to_ball(a.ball, turn, a.ends.far, a.ends.far_reach, c.sign.far, at);
  const IntOf<F> wall = select(a.ends.deep, a.ball.inner, a.ball.outer);
  const auto near_in = less(a.plane.near, a.ball.radius), far_in = less(a.plane.far, a.ball.radius);
  r.wall = select(near_in, wall, a.ball.outer);
  r.from = select(far_in, wall, a.ball.outer) * IntOf<F>(4) + select(far_in, IntOf<F>(1), IntOf<F>(0));
  r.share = share_of(a.ball, a.ends, word, p);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, r.arrive);
  const F spread = spread_of(c.chain, a.ends, a.plane.sine, at, c.root.slope, cosine);
  r.density = spread * a.at.density * (a.probability * times_asked(a.ball, a.ends, word));
  return r;
}

template <class F>
TYNDALL_INLINE ChainRays<F> rays_off_mirror(const ChainAsked<F>& a, Vec3<F> point) {
  const MirrorWay<F> way = mirror_way(a.mirror, point, a.at.point);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, way.arrive);
  ChainRays<F> r;
  r.found = way.found, r.direction = way.direction, r.arrive = way.arrive;
  r.near_way = way.near_way, r.far_way = way.far_way;
  r.wall = a.ball.outer, r.from = a.ball.outer * IntOf<F>(4) + select(way.behind, IntOf<F>(1), IntOf<F>(0));
  r.density = way.spread / max(cosine, F(1e-30f)) * a.at.density * a.probability;
  r.share = F(1.0f), r.count = F(1.0f), r.fog = F(0.0f);
  return r;
}

template <class F>
TYNDALL_INLINE ChainRays<F> rays_through_pane(const ChainAsked<F>& a, Vec3<F> point) {
  const PaneSight<F> s = sight_of(a.pane, point, a.at.point, a.way.word.across);
  const PaneWay<F> way = pane_way(a.pane, s, a.way.word);
  const IntOf<F> lower = a.pane.element + a.way.word.across + a.way.word.across, one = IntOf<F>(1);
  const IntOf<F> last = select(less(F(0.0f), s.far.height), lower + one, lower);
  const F cosine = lamp_cosine(a.lamp, a.at.normal, way.arrive);
  ChainRays<F> r;
  r.found = way.found, r.direction = way.direction, r.arrive = way.arrive;
  r.near_way = way.near_way, r.far_way = way.far_way;
  r.wall = select(less(F(0.0f), s.near.height), lower + one, lower), r.from = last * IntOf<F>(4);
  r.density = way.spread / max(cosine, F(1e-30f)) * a.at.density * a.probability;
  r.share = way.share, r.count = F(1.0f) / max(a.way.probability, F(1e-30f)), r.fog = a.pane.fog * way.within;
  return r;
}

/// The factor by which the lamp's radiance counts if nothing is in the way, the weight of the power heuristic included.
template <class F>
TYNDALL_INLINE F weight_of(const auto& s, const SpecularRequest<F>& q, const ChainAsked<F>& a,
                           const ChainRays<F>& rays) {
  const F cosine = lamp_cosine(a.lamp, a.at.normal, rays.arrive);
  const F scattered = scattered_density(s, q, rays.direction) * rays.share;
  const auto useful = mask_and(mask_and(rays.found, less(F(0.0f), cosine)), less(F(0.0f), scattered));
  const F ratio = scattered / max(rays.density, F(1e-37f));
  // 0 at a caustic's edge, where the density is 0.
  const F weight = rays.count / (ratio + F(1.0f) / max(ratio, F(1e-37f)));
  return select(mask_and(useful, less(weight, F(1e30f))), weight, F(0.0f));
}

/// The chain that each lane takes out of those which it finds: at random, in proportion to their weights. (J. Talbot,
/// D. Cline, P. Egbert, Importance Resampling for Global Illumination, Eurographics Symposium on Rendering 2005)
template <class F>
struct ChainTaken {
  Reservoir<F> reservoir;
  ChainRays<F> rays{};
  Vec3<F> lamp{};         ///< the point of the lamp where it starts
  ChainEnds<F> ends{};    ///< with those, and
  InsideWay<F> inside{};  ///< this way, if its ball is crowded
};

/// Offers what weight_of() tells of these rays. Returns which lanes take them.
template <class F>
TYNDALL_INLINE MaskOf<F> offer_rays(const auto& s, const SpecularRequest<F>& q, const ChainAsked<F>& a,
                                    const ChainRays<F>& rays, ChainTaken<F>& taken) {
  const auto takes = taken.reservoir.offer(weight_of(s, q, a, rays));
  if (!any(takes)) return takes;
  const auto put = [takes](const auto& from, auto& to) __attribute__((always_inline)) { to = select(takes, from, to); };
  ChainRays<F>& r = taken.rays;
  put(rays.direction, r.direction), put(rays.arrive, r.arrive), put(rays.near_way, r.near_way);
  put(rays.far_way, r.far_way), put(rays.wall, r.wall), put(rays.from, r.from), put(rays.fog, r.fog);
  put(a.at.point, taken.lamp);
  return takes;
}

/// Keeps the way of a chain within its crowded ball.
template <class F>
TYNDALL_INLINE void keep_inside(const ChainAsked<F>& a, const ChainFound<F>& c, const ChainWord<F>& word,
                                MaskOf<F> lanes, ChainTaken<F>& taken) {
  const F p = c.chain.turn.most * (F(1.0f) - c.root.s * c.root.s);
  put(lanes, inside_way(a.ball, a.plane, a.ends, c.sign.near, c.sign.far, c.root.sense, p, word), taken.inside);
  const auto copy = [lanes](const auto& from, auto& mask) __attribute__((always_inline)) {
    mask = mask_or(mask_and(lanes, from), mask_and_not(mask, lanes));
  };
  ChainEnds<F>& ends = taken.ends;
  copy(a.ends.both_out, ends.both_out), copy(a.ends.deep, ends.deep), copy(a.ends.valid, ends.valid);
}

/// Offers all chains of a word by a ball. For an end within the ball both signs are tried (see EndSigns).
template <class F>
TYNDALL_INLINE void offer_word(const auto& s, const SpecularRequest<F>& q, const ChainAsked<F>& a,
                               const ChainWord<F>& word, MaskOf<F> lanes, ChainTaken<F>& taken) {
  const auto near_in = less(a.plane.near, a.ball.radius);
  const EndSigns<F> signs[2] = {{F(1.0f), F(1.0f)},
                                {select(near_in, F(-1.0f), F(1.0f)), select(near_in, F(1.0f), F(-1.0f))}};
  for (int i = 0; i < 2; ++i) {
    const auto here = i == 0 ? lanes : mask_and_not(lanes, a.ends.both_out);
    if (!any(here)) continue;
    ChainFound<F> c{turn_of(s.chains, a.ball, a.ends, word, signs[i]), signs[i], {}};
    const TurnRoots<F> roots = list_roots(c.chain.turn, a.plane.angle, mask_and(here, c.chain.possible));
    for (F index = F(0.0f); any(less(index, roots.count)); index = index + F(1.0f)) {
      c.root = take_root(c.chain.turn, roots, a.plane.angle, index);
      const auto takes = offer_rays(s, q, a, rays_of(a, word, c), taken), crowded = mask_and(takes, a.ball.crowded);
      if (s.chains.crowds && any(crowded)) keep_inside(a, c, word, crowded, taken);
    }
  }
}

/// Offers the ways off a flat mirror and through a pane.
template <class F>
TYNDALL_INLINE void offer_flat(const auto& s, const SpecularRequest<F>& q, const ChainAsked<F>& a, MaskOf<F> lanes,
                               IntOf<F> events_left, ChainTaken<F>& taken) {
  const auto by_mirror = mask_and(mask_and(lanes, a.by_mirror), less(IntOf<F>(1), events_left));
  if (s.chains.has_mirrors() && any(by_mirror)) {
    ChainRays<F> rays = rays_off_mirror(a, q.point);
    rays.found = mask_and(rays.found, by_mirror);
    offer_rays(s, q, a, rays, taken);
  }
  if (!s.chains.has_panes()) return;
  const PaneWord<F>& word = a.way.word;
  const F events = word.crossings + F(1.0f) + abs(word.image[0]) + abs(word.image[1]);
  const auto by_pane = mask_and(mask_and(mask_and(lanes, a.by_pane), a.way.drawn), less(to_int(events), events_left));
  if (!any(by_pane)) return;
  ChainRays<F> rays = rays_through_pane(a, q.point);
  rays.found = mask_and(rays.found, by_pane);
  offer_rays(s, q, a, rays, taken);
}

template <class F>
TYNDALL_INLINE ChainTaken<F> take_chain(const auto& s, const SpecularRequest<F>& q, ChainAsked<F> a,
                                        const Decisions<F>& decisions, MaskOf<F> lanes) {
  ChainTaken<F> taken{{q.dice.one_alone(dimension::chain_root)}};
  const IntOf<F> events_left = IntOf<F>(s.max_depth) - q.depth;
  const auto by_ball = mask_and_not(mask_and_not(lanes, a.by_mirror), a.by_pane);
  const Pair<F> u = q.dice.pair(dimension::chain_point);
  const auto another = mask_and_not(by_ball, a.ball.mirror), twice = mask_and_not(another, a.ball.hollow);
  for (int i = 0; i < 3; ++i) {  // the main word, the main word again in solid glass, and another word
    const auto here = i == 0 ? by_ball : i == 1 ? twice : another;
    if (i > 0 && !any(here)) continue;
    const F shift = F(i == 0 ? 0.0f : 0.5f), x = u.x + shift, y = u.y + shift;
    aim_at_lamp(s, q.point, q.time, {x - floor(x), y - floor(y)}, a);
    if (i == 0) offer_flat(s, q, a, lanes, events_left, taken);
    if (!any(here)) break;
    const auto valid = mask_and(mask_and(here, a.ends.valid), less(F(1e-7f), a.plane.sine));
    const DrawnWord<F> w =
        i < 2 ? DrawnWord<F>{main_word(a.ball, a.ends), valid} : draw_word(a.ball, a.ends, decisions);
    const auto fits = less(to_int(w.word.outer + w.word.inner), events_left);
    offer_word(s, q, a, w.word, mask_and(mask_and(valid, w.drawn), fits), taken);
  }
  return taken;
}

/// Light that reaches the requests' points by chains, times their throughput. Each test for things in the way adds one
/// to shadow_rays.
template <class F>
[[gnu::noinline]] static Vec3<F> chain_light(const SceneView& s, const SpecularRequest<F>& q, MaskOf<F> lanes,
                                             std::uint32_t& shadow_rays) {
  const ChainAsked<F> a = ask_chain<F>(s, q, lanes);
  const Decisions<F> decisions{q.dice.alone(dimension::chain_word), q.dice.alone(dimension::chain_word_tail)};
  const ChainTaken<F> taken = take_chain(s, q, a, decisions, lanes);
  const ChainRays<F>& found = taken.rays;
  F weight = taken.reservoir.weight;
  auto arrives = less(F(0.0f), weight);
  if (!any(arrives)) return zero3<F>();
  const IntOf<F> lamp = lookup_int<F>(s.lights.element, s.lights.count, a.light);
  const Ray<F> near{q.point, found.direction, q.time, q.from};
  const Ray<F> far{along(taken.lamp, -found.far_way, found.arrive), found.arrive, q.time, found.from};
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
    const F passes = pass_inside(s, a.ball, taken.ends, taken.inside, decisions, q.time, crowded, shadow_rays);
    weight = select(crowded, weight * passes, weight);
  }
  Vec3<F> colour = light_radiance(s, lamp, taken.lamp, arrives);
  const auto metal = mask_and(arrives, a.ball.mirror);
  if (any(metal)) {
    const SurfacePoint<F> at = surface_at(s, near, found.near_way, found.wall);
    colour = select(metal, colour * surface_colour(s, at, metal), colour);
  }
  return select(arrives, weight * (q.throughput * colour), zero3<F>());
}

}  // namespace tyndall
