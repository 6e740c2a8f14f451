#pragma once
#include "core/materials/dielectric.h"
#include "core/shapes/specular_deflection.h"
#include "core/trace/scene_view.h"

/// The event sequence of a specular path at a sphere: which of its surfaces the path meets, and whether it is reflected
/// or refracted there. Event sequences are drawn at random; this file gives the probability of each and the fraction of
/// the light that follows it. A sphere is a mirror, solid glass, or a shell: two concentric spheres with any refractive
/// index between them and inside the inner one.
namespace tyndall {

/// One sphere per lane, read from the columns of SpecularPairs.
template <class F>
struct SpecularSphere {
  Vec3<F> center;
  F radius, index;              ///< of the outer sphere; index: refractive index directly inside it, 1 for a mirror
  F inner_radius, inner_index;  ///< the same for the inner sphere; radius 0 where there is none
  IntOf<F> outer, inner;        ///< indices of the two spheres among the scene's elements
  MaskOf<F> mirror, hollow;     ///< mirror: made of metal; hollow: a shell
  MaskOf<F> overlapped;         ///< other objects lie in it or reach into it
};

template <class F>
TYNDALL_INLINE SpecularSphere<F> load_sphere(const SpecularPairs& c, IntOf<F> sphere, F time) {
  const auto value = [&](const auto& column) { return lookup<F>(column, c.spheres(), sphere); };
  SpecularSphere<F> b;
  b.center = point_at(value(c.center), time, value(c.move));
  b.radius = value(c.radius), b.inner_radius = value(c.inner_radius);
  const F index = value(c.index);
  b.mirror = equal(index, F(0.0f));
  b.index = select(b.mirror, F(1.0f), index), b.inner_index = value(c.inner_index);
  b.hollow = less(F(0.0f), b.inner_radius);
  b.outer = lookup<F>(c.outer, c.spheres(), sphere), b.inner = lookup<F>(c.inner, c.spheres(), sphere);
  b.overlapped = equal(lookup<F>(c.overlapped, c.spheres(), sphere), IntOf<F>(1));
  return b;
}

/// The events of a specular path, counted by kind. Their order is left out, because the deflection and the throughput
/// of the path depend on the counts alone.
template <class F>
struct EventSequence {
  F outer;            ///< events at the outer sphere
  F inner;            ///< events at the inner sphere
  F inner_reflected;  ///< reflections among the events at the inner sphere
  /// Only of a near end in a shell's glass: 1 if the path first goes inward, to the inner sphere; -1 if outward.
  F near_sign = F(1.0f);
};

/// Where the two ends of a specular path lie relative to the sphere.
template <class F>
struct PathEnds {
  F near_reach, far_reach;  ///< distance of each end from the centre times the refractive index there
  F far_index;              ///< refractive index at the far end
  F outside;                ///< number of ends outside of the sphere: 0, 1 or 2
  MaskOf<F> both_out;       ///< both ends are outside of the sphere
  MaskOf<F> both_in;        ///< both ends are inside
  MaskOf<F> near_in_glass;  ///< the near end is in the glass of a shell
  MaskOf<F> deep;           ///< an end is inside the inner sphere; where both are inside, the far one is
  /// Each end is outside, in solid glass or in a shell's hollow. The near one may be in a shell's glass if the far one
  /// is in the hollow.
  MaskOf<F> valid;
};

template <class F>
TYNDALL_INLINE PathEnds<F> ends_of(const SpecularSphere<F>& b, F near, F far) {
  const F above = F(1.0f + 1e-6f), below = F(1.0f - 1e-6f);
  const F skin = above * b.radius, core = below * b.inner_radius;
  const F shell = select(b.hollow, core, b.radius * below);
  const auto near_out = less(skin, near), far_out = less(skin, far);
  const auto near_in = less(near, shell), far_in = less(far, shell);
  const F within = select(b.hollow, b.inner_index, b.index);
  PathEnds<F> e;
  const auto in_layer = mask_and(less(above * b.inner_radius, near), less(near, b.radius * below));
  e.near_in_glass = mask_and(mask_and(in_layer, far_in), b.hollow);
  e.near_reach = near * select(near_in, within, select(e.near_in_glass, b.index, F(1.0f)));
  e.far_index = select(far_in, within, F(1.0f));
  e.far_reach = far * e.far_index;
  e.both_out = mask_and(near_out, far_out);
  e.both_in = mask_or(mask_and(near_in, far_in), e.near_in_glass);
  const auto one_in = mask_or(mask_and(near_in, far_out), mask_and(far_in, near_out));
  e.outside = select(e.both_out, F(2.0f), select(e.both_in, F(0.0f), F(1.0f)));
  const auto some_in = mask_or(one_in, e.both_in);
  e.deep = mask_and(some_in, b.hollow);
  e.valid = mask_or(e.both_out, mask_and_not(some_in, b.mirror));
  return e;
}

/// Signs of the two ends' terms in the deflection. An end outside of the sphere always has 1. An end inside has 1 if
/// the path from it to the sphere's surface first approaches the centre, and -1 if the path moves outward at once. In a
/// shell's glass, the sign tells which sphere the path meets first: 1 the inner one, -1 the outer one.
template <class F>
struct EndSigns {
  F near, far;
};

/// The deflection of a specular path, in radians, is the sum of acos(p/a) - acos(p/R) for each end outside, at distance
/// a from the centre; acos(p/(nR)) - acos(p/(n Ri)) for each crossing of a shell's glass; 2 acos(p/(m Ri)) for each
/// chord of its inner sphere; and 2 acos(p/(nR)) for each chord of solid glass. An end inside adds its sign times
/// acos(p/r), r: its reach. So each event at a sphere of reach r adds acos(p/r) for each side from which or to which
/// the path goes there inside of that sphere, and takes it away for each side outside of it. R, Ri: outer and inner
/// radius; n, m: index inside each.
template <class F>
TYNDALL_INLINE Deflection<F> deflection_of(const SpecularPairs& c, const SpecularSphere<F>& b, const PathEnds<F>& e,
                                           const EventSequence<F>& w, const EndSigns<F>& sign) {
  const F outside = e.outside, glass = F(2.0f) * w.outer - outside;
  const auto visits = less(F(0.0f), w.inner);
  const F from_glass = select(e.near_in_glass, sign.near, F(0.0f)), to_inner = glass + from_glass;
  const F chords = F(2.0f) * (w.inner - w.outer) + outside - from_glass;
  const F reach[] = {e.near_reach,
                     e.far_reach,
                     b.radius,
                     b.index * b.radius,
                     b.index * b.inner_radius,
                     b.inner_index * b.inner_radius};
  const F times[] = {
      sign.near, sign.far, -outside, glass, select(visits, -to_inner, F(0.0f)), select(visits, chords, F(0.0f))};
  Deflection<F> deflection;
  deflection.terms = c.shells ? 6 : 4;
  deflection.maximum = min(reach[0], reach[1]);
  for (int i = 2; i < deflection.terms; ++i)
    deflection.maximum = select(equal(times[i], F(0.0f)), deflection.maximum, min(deflection.maximum, reach[i]));
  for (int i = 0; i < deflection.terms; ++i) {
    const F safe = select(equal(times[i], F(0.0f)), deflection.maximum + deflection.maximum, reach[i]);
    deflection.times[i] = times[i], deflection.inverse[i] = F(1.0f) / safe;
    deflection.gap[i] = (safe - deflection.maximum) * deflection.inverse[i];
  }
  // Paths that cross the glass of a shell without meeting its inner sphere exist only for p above n Ri.
  const auto misses = mask_and(mask_and(b.hollow, e.both_out), mask_and_not(less(F(1.0f), w.outer), visits));
  const F minimum = select(misses, b.index * b.inner_radius, F(0.0f));
  deflection.last = select(misses, sqrt(max(F(1.0f) - minimum / deflection.maximum, F(0.0f))), F(1.0f));
  deflection.possible = mask_and(e.valid, less(F(2.0f * min_parameter), deflection.last));
  return deflection;
}

/// x to the power of a whole number >= 0, for x in [0, 1].
template <class F>
TYNDALL_INLINE F whole_power(F x, F exponent) {
  if (!any(less(F(0.5f), exponent))) return F(1.0f);
  return select(less(F(0.5f), exponent), exp(exponent * log(max(x, F(1e-30f)))), F(1.0f));
}

/// Fraction of the light that follows a specular path, in [0, 1]: the product of reflectance or transmittance over its
/// events. A mirror counts as 1 (its colour is applied later). All events at one sphere have the same angle of
/// incidence (Bouguer's formula), so that one Fresnel term per sphere is enough.
template <class F>
TYNDALL_INLINE F throughput_of(const SpecularSphere<F>& b, const PathEnds<F>& e, const EventSequence<F>& w, F p) {
  const auto cosine = [&](F reach) {
    const F sine = p / max(reach, F(1e-30f));
    return sqrt(max((F(1.0f) - sine) * (F(1.0f) + sine), F(0.0f)));
  };
  const F outside = e.outside;
  const F reflected = fresnel(cosine(b.radius), b.index);  // 1 beyond the critical angle: p > R
  const auto off = less(w.outer, outside);                 // reflected at the outside
  F throughput = select(e.both_in, F(1.0f), F(1.0f) - reflected) * select(e.both_out, F(1.0f) - reflected, F(1.0f)) *
                 whole_power(reflected, w.outer - outside);
  throughput = select(off, select(b.mirror, F(1.0f), reflected), throughput);
  const auto visits = less(F(0.0f), w.inner);
  if (!any(visits)) return throughput;
  const F inner = fresnel(cosine(b.index * b.inner_radius), b.inner_index / b.index);
  const F visit = whole_power(inner, w.inner_reflected) * whole_power(F(1.0f) - inner, w.inner - w.inner_reflected);
  return select(visits, throughput * visit, throughput);
}

/// The event sequence of the path that carries most light: through the sphere by the fewest events, or off a mirror.
/// With both ends inside, by one event: a reflection, or a crossing if one of them is in a shell's glass.
template <class F>
TYNDALL_INLINE EventSequence<F> main_sequence(const SpecularSphere<F>& b, const PathEnds<F>& e) {
  const F one = F(1.0f), two = F(2.0f), none = F(0.0f);
  const auto in_hollow = mask_and(e.both_in, b.hollow);
  return {select(in_hollow, none, select(mask_and_not(e.both_out, b.mirror), two, one)),
          select(b.hollow, select(e.both_out, two, select(e.deep, one, none)), none),
          select(mask_and_not(in_hollow, e.near_in_glass), one, none)};
}

// Each query tries the main event sequence and another one, which is drawn by decisions. Each decision takes one octal
// digit of 64 random bits. The first decisions: is the path reflected off the outside of the glass? Does it bypass the
// inner sphere of a thick shell? After these, one at each event: is it reflected? At its first event inside solid glass
// a drawn path is always reflected, because otherwise it would repeat the main event sequence. A path with both ends
// inside is always reflected at the outer sphere; after each event from which it goes on where its near end lies, a
// second decision tells whether it ends there, with probability 1/2.
inline constexpr int max_decisions = 16;          ///< longer event sequences are left to BSDF sampling
inline constexpr int max_inside_events = 8;       ///< the same with both ends inside, for two decisions at each event
inline constexpr float take_octal = 3.0f / 8.0f;  ///< probability of "yes"

/// Whether a path can cross a shell's glass without meeting the inner sphere.
template <class F>
TYNDALL_INLINE MaskOf<F> is_thick(const SpecularSphere<F>& b) {
  return mask_and(b.hollow, less(b.index * b.inner_radius, F(0.999f) * min(b.radius, b.index * b.radius)));
}

template <class F>
struct DrawnSequence {
  EventSequence<F> sequence;
  MaskOf<F> drawn;  ///< false for mirrors, invalid ends, and event sequences of more than max_decisions events
};

/// Whether both have the same events, in whatever order.
template <class F>
TYNDALL_INLINE MaskOf<F> same_sequence(const EventSequence<F>& a, const EventSequence<F>& b) {
  return mask_and(mask_and(equal(a.outer, b.outer), equal(a.inner, b.inner)),
                  equal(a.inner_reflected, b.inner_reflected));
}

/// The decisions that 64 random bits make: three bits each, from the highest down.
template <class F>
struct Decisions {
  UintOf<F> high, low;
  /// Returns whether the next octal digit is below `limit` (probability limit / 8), and advances to the digit after it.
  TYNDALL_INLINE MaskOf<F> below(std::int32_t limit) {
    const auto yes = less(as_int(shift_right<29>(high)), IntOf<F>(limit));
    high = shift_left<3>(high) | shift_right<29>(low);
    low = shift_left<3>(low);
    return yes;
  }
};

/// The state of an event sequence while it is drawn event by event.
template <class F>
struct SequenceWalk {
  Decisions<F> decide;
  MaskOf<F> layered;   ///< the path meets the inner sphere
  MaskOf<F> open;      ///< more events follow; never for a path that only reflects off the outside or off a mirror
  MaskOf<F> inside;    ///< both ends are inside
  MaskOf<F> to_glass;  ///< of these, those whose near end is in glass; of the others it is in the hollow
  IntOf<F> next;  ///< 0: at the outer sphere; 1: at the inner one, from the glass; 2: at the inner one, from inside
};

/// Starts the walk along an event sequence. main: lanes of the main event sequence, which takes no decisions.
template <class F>
TYNDALL_INLINE SequenceWalk<F> start_walk(const SpecularSphere<F>& b, const PathEnds<F>& e,
                                          const Decisions<F>& decisions, MaskOf<F> main) {
  using I = IntOf<F>;
  using U = UintOf<F>;
  SequenceWalk<F> walk;
  walk.decide = decisions;
  const auto drawn_out = mask_and_not(e.both_out, main);
  const auto off = mask_and(drawn_out, walk.decide.below(3));
  const auto past = mask_and(mask_and(drawn_out, is_thick(b)), walk.decide.below(3));
  const U yes_first = walk.decide.high & U(0x1fffffffu);
  // The main event sequence crosses each surface. With both ends inside it crosses into glass or is reflected, and
  // ends.
  const U main_high = select(e.both_in, select(e.near_in_glass, U(0xe0000000u), U(0u)), U(0xffffffffu));
  walk.decide.high = select(main, main_high, select(b.hollow, walk.decide.high, yes_first));
  walk.layered = mask_and_not(b.hollow, past);
  walk.open = mask_and_not(e.valid, mask_or(off, b.mirror));
  walk.inside = e.both_in, walk.to_glass = mask_or(e.near_in_glass, mask_and_not(e.both_in, b.hollow));
  walk.next = select(walk.layered, select(e.deep, I(2), I(1)), I(0));
  return walk;
}

/// One event of a walk. Lanes whose walk has ended have neither at_outer nor at_inner set.
template <class F>
struct SequenceEvent {
  MaskOf<F> at_outer, at_inner, reflects;
};

/// Returns the walk's next event and advances the walk past it.
template <class F>
TYNDALL_INLINE SequenceEvent<F> step_walk(SequenceWalk<F>& walk) {
  using I = IntOf<F>;
  const auto at_outer = mask_and(walk.open, equal(walk.next, I(0)));
  const auto reflects = mask_or(walk.decide.below(3), mask_and(at_outer, walk.inside));
  const SequenceEvent<F> event{at_outer, mask_and_not(walk.open, at_outer), reflects};
  // A reflection stays on its side of the inner sphere, a crossing goes to the other one. At the outer sphere it stays
  // in the glass, or leaves, and the walk ends.
  const auto from_glass = equal(walk.next, I(1));
  const I after_inner = select(reflects, select(from_glass, I(0), I(2)), select(from_glass, I(2), I(0)));
  walk.next = select(at_outer, select(walk.layered, I(1), I(0)), select(event.at_inner, after_inner, walk.next));
  walk.open = mask_and_not(walk.open, mask_and_not(at_outer, reflects));
  if (!any(walk.inside)) return event;
  // With both ends inside, the walk may end wherever the near end lies.
  const auto in_hollow = equal(walk.next, I(2));
  const auto may_end = mask_or(mask_and_not(walk.to_glass, in_hollow), mask_and_not(in_hollow, walk.to_glass));
  const auto decides = mask_and(mask_and(walk.inside, walk.open), may_end);
  Decisions<F> after = walk.decide;
  walk.open = mask_and_not(walk.open, mask_and(decides, after.below(4)));
  walk.decide = {select(decides, after.high, walk.decide.high), select(decides, after.low, walk.decide.low)};
  return event;
}

/// Draws an event sequence other than the main one. In a shell the main one may be drawn all the same.
template <class F>
TYNDALL_INLINE DrawnSequence<F> draw_sequence(const SpecularSphere<F>& b, const PathEnds<F>& e,
                                              const Decisions<F>& decisions) {
  const F one = F(1.0f), none = F(0.0f);
  SequenceWalk<F> walk = start_walk(b, e, decisions, less(one, none));
  EventSequence<F> w{select(e.both_out, one, none), none, none};
  for (int i = 0; i < max_decisions && any(walk.open); ++i) {
    const SequenceEvent<F> event = step_walk(walk);
    w.outer = select(event.at_outer, w.outer + one, w.outer);
    w.inner = select(event.at_inner, w.inner + one, w.inner);
    const auto inner_reflected = mask_and(event.at_inner, event.reflects);
    w.inner_reflected = select(inner_reflected, w.inner_reflected + one, w.inner_reflected);
    // The walk starts at the far end: what it meets last, the path meets first.
    w.near_sign = select(event.at_inner, one, select(event.at_outer, -one, w.near_sign));
  }
  const auto too_long = mask_and(e.both_in, less(F(max_inside_events + 0.5f), w.outer + w.inner));
  walk.open = mask_or(walk.open, too_long);
  return {w, mask_and_not(mask_and_not(e.valid, b.mirror), walk.open)};
}

/// How many points of the light are tried with the main event sequence: 2 for solid glass, else 1. Solid glass focuses:
/// a few points of the light may bring almost all of the light, so that a second point is worth its time.
template <class F>
TYNDALL_INLINE F main_queries(const SpecularSphere<F>& b) {
  return select(mask_or(b.mirror, b.hollow), F(1.0f), F(2.0f));
}

/// Probability that draw_sequence() draws these events in one given order, for paths with both ends inside.
template <class F>
TYNDALL_INLINE F inside_walks(const SpecularSphere<F>& b, const PathEnds<F>& e, const EventSequence<F>& w) {
  const F yes = F(take_octal), no = F(1.0f) - yes;
  const F in_glass = F(2.0f) * w.outer + select(less(F(0.0f), w.near_sign), F(1.0f), F(0.0f));
  // The number of events from which the path goes on where its near end lies, at which the walk may end.
  const F may_end = select(e.near_in_glass, in_glass, select(b.hollow, w.inner - w.outer, w.outer));
  const F walk = whole_power(yes, w.inner_reflected) * whole_power(no, w.inner - w.inner_reflected);
  const auto fits = less(w.outer + w.inner, F(max_inside_events + 0.5f));
  return select(fits, walk * whole_power(F(0.5f), may_end), F(0.0f));
}

/// Expected number of times that a query tries these events in one given order: the probability that draw_sequence()
/// draws them, plus main_queries() if they are the main event sequence.
template <class F>
TYNDALL_INLINE F expected_queries(const SpecularSphere<F>& b, const PathEnds<F>& e, const EventSequence<F>& w) {
  const F yes = F(take_octal), no = F(1.0f) - yes;
  const F outside = e.outside;
  const F reflections = (w.outer - outside) + w.inner_reflected, crossings = (w.inner - w.inner_reflected) + F(1.0f);
  const auto short_enough = less(reflections + crossings, F(max_decisions + 0.5f));
  const F chosen = reflections - select(b.hollow, F(0.0f), F(1.0f));  // the first one in solid glass is not drawn
  const F events = whole_power(yes, max(chosen, F(0.0f))) * whole_power(no, crossings);
  // The first decisions, from outside: not off the outside of the glass, and past the inner sphere or not.
  const auto past = mask_and_not(b.hollow, less(F(0.0f), w.inner));
  const F passes = select(is_thick(b), select(past, yes, no), select(past, F(0.0f), F(1.0f)));
  const F start = passes * no;
  const auto off = mask_and(e.both_out, equal(w.outer, F(1.0f)));
  const auto can_be_drawn = mask_and(short_enough, less(F(-0.5f), chosen));
  const F walked = select(can_be_drawn, events * select(e.both_out, start, F(1.0f)), F(0.0f));
  F other = select(b.mirror, F(0.0f), select(off, yes, walked));
  if (any(e.both_in)) other = select(e.both_in, inside_walks(b, e, w), other);
  return select(e.valid, other + select(same_sequence(w, main_sequence(b, e)), main_queries(b), F(0.0f)), F(0.0f));
}

}  // namespace tyndall
