#pragma once
#include "core/specular/chain_pane.h"

/// Paths that go the way of a chain by chance: a path that scatters into a ball, mirror or pane and then finds a lamp
/// is weighed against the chain that would have found the same light. For that, paths remember where they scattered
/// last and what they have met since (ChainTrail).
namespace tyndall {

/// What a path remembers, in scenes with chains, so that a lamp which it finds by chance can be weighed against them.
template <class F>
struct ChainTrail {
  Vec3<F> start;  ///< where the path last scattered at a diffuse surface or in fog
  F density;      ///< of its direction from there, per steradian, over the probability that it asked for a chain there
  SpecularHistory<F> met;  ///< what it has met since then
};

/// The trail's history after the surface of `element`. reflected: lanes that leave it on the side from which they came.
template <class F>
TYNDALL_INLINE SpecularHistory<F> meet_object(const SceneView& s, const ChainTrail<F>& trail, const Ray<F>& ray,
                                              IntOf<F> element, MaskOf<F> reflected) {
  using I = IntOf<F>;
  const I code =
      lookup_int<F>(s.chains.ball_of, s.element_count, element);  // 2 · object + 1 for an inner sphere, or -1
  const auto none = mask_or(less(code, I(0)), less(trail.met.packed, I(0)));
  const I safe = select(none, I(0), code);
  const I object = as_int(shift_right<1>(as_uint(safe)));
  const Vec3<F> center = load_ball<F>(s.chains, object, ray.time).center;
  const auto away = mask_and(trail.met.is_empty(), less(F(0.0f), dot(ray.direction, trail.start - center)));
  const SpecularHistory<F> before{select(none, I(0), trail.met.packed)};
  HistoryEvent<F> event = event_at_sphere<F>(before.packed, equal(safe & I(1), I(1)), reflected, away);
  if (s.chains.has_panes()) {
    const auto by_pane = less_equal(I(s.chains.first_pane), object);
    const I first = lookup_int<F>(s.chains.outer, s.chains.balls, object);
    const auto at = event_at_pane<F>(before.packed, as_int(shift_right<1>(as_uint(element - first))));
    event.start = select(by_pane, at.start, event.start), event.count = select(by_pane, at.count, event.count);
    event.is_full = mask_or(mask_and(by_pane, at.is_full), mask_and_not(event.is_full, by_pane));
  }
  return {select(none, I(-1), append_event(before, object, event).packed)};
}

/// Probability with which an event asks for a chain: the light that it may get by chains over the light that it may get
/// from lamps directly, both roughly estimated, and within [0.03, 1]. So little time is spent where chains bring
/// little. 1 where there are too many lamps, or pairs of a ball and a lamp, to estimate.
template <class F>
[[gnu::noinline]] static F chain_probability(const SceneView& s, Vec3<F> point) {
  const LightView &pairs = s.chains.choice, &lamps = s.lights;
  if (pairs.count > most_lights_by_contribution || lamps.count > most_lights_by_contribution) return F(1.0f);
  return min(max(total_worth(s.chains, point) / total_worth(lamps, point), F(0.03f)), F(1.0f));
}

/// Lets the trail grow by the surface of `element`, in the lanes `at_surface`. ray: by which they came there.
/// reflected: lanes that leave it on the side from which they came.
template <class F>
TYNDALL_INLINE void extend_trail(const SceneView& s, ChainTrail<F>& trail, const Ray<F>& ray, MaskOf<F> at_surface,
                                 IntOf<F> element, MaskOf<F> reflected) {
  const auto goes_on = mask_and(at_surface, trail.met.goes_on());
  if (!any(goes_on)) return;
  trail.met.packed = select(goes_on, meet_object(s, trail, ray, element, reflected).packed, trail.met.packed);
}

/// Lets the trail start anew, in lanes that have scattered at `point` at a diffuse surface or in fog. density: of the
/// direction in which they go on, per steradian. asked: the probability with which they asked for a chain.
template <class F>
TYNDALL_INLINE void restart_trail(ChainTrail<F>& trail, MaskOf<F> lanes, Vec3<F> point, F density, F asked) {
  trail.met.packed = select(lanes, IntOf<F>(0), trail.met.packed);
  trail.start = select(lanes, point, trail.start);
  trail.density = select(lanes, density / asked, trail.density);
}

/// The events at a ball or mirror, by kind.
template <class F>
TYNDALL_INLINE ChainWord<F> word_of(SpecularHistory<F> met) {
  return {from_int<F>(met.outer()), from_int<F>(met.inner()), from_int<F>(met.inner_reflected())};
}

/// The chain that would have found what a path found by chance.
template <class F>
struct ChainByChance {
  MaskOf<F> could;  ///< there is one
  F density;        ///< of its direction where it starts, per steradian, once its pair and its word are chosen
  F word;           ///< see times_asked()
  F share;          ///< of light that the surfaces send this way
};

template <class F>
TYNDALL_INLINE ChainByChance<F> ball_by_chance(const ChainView& c, const ChainTrail<F>& trail, const Ray<F>& ray,
                                               IntOf<F> ball, const LightColumns<F>& lamp, Vec3<F> point) {
  const ChainBall<F> b = load_ball<F>(c, ball, ray.time);
  const LampPoint<F> at = lamp_point(lamp, b, trail.start, ray.time, point);
  const ChainPlane<F> plane = plane_of(b, trail.start, point);
  const ChainEnds<F> ends = ends_of(b, plane.near, plane.far);
  const ChainWord<F> word = word_of<F>(trail.met);
  const auto away = trail.met.began_away();
  const EndSigns<F> sign{select(mask_and_not(away, less(b.radius, plane.near)), F(-1.0f), F(1.0f)),
                         select(less(dot(ray.direction, plane.far_out), F(0.0f)), F(-1.0f), F(1.0f))};
  const ChainTurn<F> chain = turn_of(c, b, ends, word, sign);
  const F p = ends.far_reach * length(cross(plane.far_out, ray.direction));
  const F s2 = F(1.0f) - p / chain.turn.most, parameter = sqrt(max(s2, F(1e-12f)));
  const auto could = mask_and(
      chain.possible, mask_and(less_equal(F(least_parameter), parameter), less_equal(parameter, chain.turn.last)));
  const F cosine = lamp_cosine(lamp, at.normal, ray.direction);
  const F spread = spread_of(chain, ends, plane.sine, parameter, turn_at(chain.turn, parameter).slope, cosine);
  return {mask_and(could, less(F(0.0f), cosine)), spread * at.density, times_asked(b, ends, word),
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

template <class F>
TYNDALL_INLINE ChainByChance<F> pane_by_chance(const ChainView& c, const ChainTrail<F>& trail, const Ray<F>& ray,
                                               IntOf<F> pane, const LightColumns<F>& lamp, Vec3<F> point) {
  const ChainPane<F> p = load_pane<F>(c, pane);
  const PaneWord<F> word = pane_word_of(p, trail.met, ray.direction);
  const LampBall<F> around = ball_around(lamp, ray.time);
  const PaneSight<F> to_lamp = sight_of(p, trail.start, around.center, word.across);
  const auto could = is_looked_for(p, to_lamp, around, word);
  const ChainBall<F> seen = seen_by_pane(p, to_lamp, word);
  const LampPoint<F> at = lamp_point(lamp, seen, seen.center, ray.time, point);
  const PaneSight<F> s = sight_of(p, trail.start, point, word.across);
  const F rises[3] = {dot(p.row[0], ray.direction), dot(p.row[1], ray.direction), dot(p.row[2], ray.direction)};
  const PanePlace<F> rise = framed<F>(rises, word.across);
  const F slope =
      sqrt(mul_add(rise.side[0], rise.side[0], rise.side[1] * rise.side[1])) / max(abs(rise.height), F(1e-6f));
  PaneWay<F> way;
  follow_slope(s, word, reach_of(p.index, s.near_gap + s.far_gap, F(2.0f) * word.crossings * s.half.height, slope),
               way);
  const F cosine = lamp_cosine(lamp, at.normal, ray.direction);
  return {mask_and(could, less(F(0.0f), cosine)), way.spread / max(cosine, F(1e-30f)) * at.density, F(1.0f), way.share};
}

/// Puts what is true of the lanes `here` among the others.
template <class F>
TYNDALL_INLINE void put(MaskOf<F> here, const ChainByChance<F>& from, ChainByChance<F>& to) {
  to.could = mask_or(mask_and(here, from.could), mask_and_not(to.could, here));
  to.density = select(here, from.density, to.density), to.word = select(here, from.word, to.word);
  to.share = select(here, from.share, to.share);
}

/// Weight of the light of a lamp that the lanes `lit` found by chance at `point`, after the events of their trail; 1
/// where no chain could have found it. By the power heuristic it is r² / (1 + r²). r is the density with which the path
/// scattered into its direction times the probability that the ball's surfaces sent it this way, over the density with
/// which a chain would have been found there.
template <class F>
[[gnu::noinline]] static F found_by_chance_weight(const SceneView& s, ChainTrail<F> trail, Ray<F> ray, IntOf<F> light,
                                                  Vec3<F> point, MaskOf<F> lit) {
  using I = IntOf<F>;
  auto could = mask_and(mask_and(lit, less_equal(I(0), light)), trail.met.has_object());
  if (!any(could)) return F(1.0f);
  const ChainView& c = s.chains;
  const I ball = select(could, trail.met.object(), I(0));
  const I lamp = select(could, light, I(0));
  const I pair = gather_int<F>(c.pair_of, ball * I(s.lights.count) + lamp);
  could = mask_and(could, less_equal(I(0), pair));
  if (!any(could)) return F(1.0f);
  const LightColumns<F> columns = load_light<F>(s.lights, lamp);
  ChainByChance<F> chain{less(F(1.0f), F(0.0f)), F(0.0f), F(0.0f), F(0.0f)};
  if (c.has_balls()) chain = ball_by_chance(c, trail, ray, ball, columns, point);
  const I mirror = ball - I(c.first_mirror), pane = ball - I(c.first_pane);
  const auto is_pane = mask_and(could, less_equal(I(0), pane));
  const auto is_mirror = mask_and_not(mask_and(could, less_equal(I(0), mirror)), is_pane);
  if (c.has_mirrors() && any(is_mirror))
    put(is_mirror, mirror_by_chance(c, trail, ray, select(is_mirror, mirror, I(0)), columns, point), chain);
  if (c.has_panes() && any(is_pane))
    put(is_pane, pane_by_chance(c, trail, ray, select(is_pane, pane, I(0)), columns, point), chain);
  const F probability = choice_probability(c, trail.start, select(could, pair, I(0)));
  const F asked = chain.density * probability * chain.word;
  const F inverse = asked / max(trail.density * chain.share, F(1e-37f));
  const auto asks = mask_and(mask_and(could, chain.could), less(F(0.0f), asked));
  return select(asks, F(1.0f) / mul_add(inverse, inverse, F(1.0f)), F(1.0f));
}

}  // namespace tyndall
