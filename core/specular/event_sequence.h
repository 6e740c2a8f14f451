#pragma once
#include "core/materials/dielectric.h"
#include "core/shapes/specular_deflection.h"
#include "core/trace/scene_view.h"

/// The event sequence of a specular path: which surfaces of a sphere it meets and what happens there. Event sequences
/// are drawn at random; this file tells how often, and which fraction of the light takes the path that an event
/// sequence describes. A sphere is a mirror, solid glass, or a shell: two spheres around one centre, with any
/// refractive index between them and within.
namespace tyndall {

/// A sphere's columns for each lane: see SpecularPairs.
template <class F>
struct SpecularSphere {
  Vec3<F> center;
  F radius, index;              ///< of the outer sphere, and the refractive index within it
  F inner_radius, inner_index;  ///< the same of the inner sphere; radius 0: there is none
  IntOf<F> outer, inner;        ///< elements of the spheres
  MaskOf<F> mirror, hollow;     ///< metal; a shell
  MaskOf<F> overlapped;         ///< other things are in it or reach into it
};

template <class F>
TYNDALL_INLINE SpecularSphere<F> load_sphere(const SpecularView& c, IntOf<F> sphere, F time) {
  const auto value = [&](const float* column) { return lookup<F>(column, c.spheres, sphere); };
  SpecularSphere<F> b;
  b.center = point_at(Vec3<F>{value(c.center[0]), value(c.center[1]), value(c.center[2])}, time,
                      Vec3<F>{value(c.move[0]), value(c.move[1]), value(c.move[2])});
  b.radius = value(c.radius), b.inner_radius = value(c.inner_radius);
  const F index = value(c.index);
  b.mirror = equal(index, F(0.0f));
  b.index = select(b.mirror, F(1.0f), index), b.inner_index = value(c.inner_index);
  b.hollow = less(F(0.0f), b.inner_radius);
  b.outer = lookup_int<F>(c.outer, c.spheres, sphere), b.inner = lookup_int<F>(c.inner, c.spheres, sphere);
  b.overlapped = equal(lookup_int<F>(c.overlapped, c.spheres, sphere), IntOf<F>(1));
  return b;
}

/// The events of a specular path, counted by kind. Their order is left out, because neither the deflection of the way
/// nor the fraction of light that takes it depends on it.
template <class F>
struct EventSequence {
  F outer;            ///< at the outer sphere
  F inner;            ///< at the inner sphere
  F inner_reflected;  ///< of these, reflections
};

/// Where a specular path's ends are with regard to the sphere. At least one must be outside of it.
template <class F>
struct PathEnds {
  F near, far;              ///< distance of each end from the centre
  F near_reach, far_reach;  ///< these distances times the refractive index there
  F far_index;              ///< refractive index at the far end
  MaskOf<F> both_out;       ///< both ends are outside of the sphere
  MaskOf<F> deep;           ///< one end is inside the inner sphere
  MaskOf<F> valid;          ///< one end is outside, the other not on a surface, in metal or in the glass of a shell
};

template <class F>
TYNDALL_INLINE PathEnds<F> ends_of(const SpecularSphere<F>& b, F near, F far) {
  const F skin = F(1.0f + 1e-6f) * b.radius, core = F(1.0f - 1e-6f) * b.inner_radius;
  const F shell = select(b.hollow, core, b.radius * F(1.0f - 1e-6f));
  const auto near_out = less(skin, near), far_out = less(skin, far);
  const auto near_in = less(near, shell), far_in = less(far, shell);
  const F within = select(b.hollow, b.inner_index, b.index);
  PathEnds<F> e;
  e.near = near, e.far = far;
  e.near_reach = select(near_in, near * within, near);
  e.far_index = select(far_in, within, F(1.0f));
  e.far_reach = far * e.far_index;
  e.both_out = mask_and(near_out, far_out);
  const auto one_in = mask_or(mask_and(near_in, far_out), mask_and(far_in, near_out));
  e.deep = mask_and(one_in, b.hollow);
  e.valid = mask_or(e.both_out, mask_and_not(one_in, b.mirror));
  return e;
}

/// Signs with which the ends' terms enter the deflection. An end outside of the sphere always has 1. An end within it
/// has 1 if the way from it to the sphere's surface first comes closer to the centre, and -1 if it leads outward at
/// once.
template <class F>
struct EndSigns {
  F near, far;
};

/// The deflection of an event sequence, and whether a way of that event sequence can exist at all.
template <class F>
struct SpecularDeflection {
  Deflection<F> deflection;
  MaskOf<F> possible;
};

/// The deflection of a specular path, as the sum of: acos(p/a) - acos(p/R) for each end outside, at distance a;
/// acos(p/(nR)) - acos(p/(n Ri)) for each way through the glass of a shell; 2 acos(p/(m Ri)) for each chord within its
/// inner sphere; 2 acos(p/(nR)) for each chord through solid glass. R, Ri: radii of the spheres; n, m: refractive index
/// within each.
template <class F>
TYNDALL_INLINE SpecularDeflection<F> deflection_of(const SpecularView& c, const SpecularSphere<F>& b,
                                                   const PathEnds<F>& e, const EventSequence<F>& w,
                                                   const EndSigns<F>& sign) {
  const F outside = select(e.both_out, F(2.0f), F(1.0f)), glass = F(2.0f) * w.outer - outside;
  const auto visits = less(F(0.0f), w.inner);
  const F chords = F(2.0f) * (w.inner - w.outer) + select(e.both_out, F(2.0f), F(1.0f));
  const F reach[] = {e.near_reach,
                     e.far_reach,
                     b.radius,
                     b.index * b.radius,
                     b.index * b.inner_radius,
                     b.inner_index * b.inner_radius};
  const F times[] = {
      sign.near, sign.far, -outside, glass, select(visits, -glass, F(0.0f)), select(visits, chords, F(0.0f))};
  SpecularDeflection<F> out;
  Deflection<F>& deflection = out.deflection;
  deflection.terms = c.shells ? 6 : 4;
  deflection.maximum = min(reach[0], min(reach[1], reach[2]));
  for (int i = 3; i < deflection.terms; ++i)
    deflection.maximum = select(equal(times[i], F(0.0f)), deflection.maximum, min(deflection.maximum, reach[i]));
  for (int i = 0; i < deflection.terms; ++i) {
    const F safe = select(equal(times[i], F(0.0f)), deflection.maximum + deflection.maximum, reach[i]);
    deflection.times[i] = times[i], deflection.inverse[i] = F(1.0f) / safe;
    deflection.gap[i] = (safe - deflection.maximum) * deflection.inverse[i];
  }
  // An event sequence that goes through the glass of a shell past its inner sphere: p must stay above n Ri.
  const auto misses = mask_and(mask_and(b.hollow, e.both_out), mask_and_not(less(F(1.0f), w.outer), visits));
  const F minimum = select(misses, b.index * b.inner_radius, F(0.0f));
  deflection.last = select(misses, sqrt(max(F(1.0f) - minimum / deflection.maximum, F(0.0f))), F(1.0f));
  out.possible = mask_and(e.valid, less(F(2.0f * min_parameter), deflection.last));
  return out;
}

/// x to a whole power >= 0, x in [0, 1].
template <class F>
TYNDALL_INLINE F whole_power(F x, F exponent) {
  if (!any(less(F(0.5f), exponent))) return F(1.0f);
  return select(less(F(0.5f), exponent), exp(exponent * log(max(x, F(1e-30f)))), F(1.0f));
}

/// Fraction of the light that takes a specular path: the product of what each surface reflects or lets through. All
/// events at one sphere have the same angle (Bouguer's formula), so that one share per sphere is enough.
template <class F>
TYNDALL_INLINE F throughput_of(const SpecularSphere<F>& b, const PathEnds<F>& e, const EventSequence<F>& w, F p) {
  const auto cosine = [&](F reach) {
    const F sine = p / max(reach, F(1e-30f));
    return sqrt(max((F(1.0f) - sine) * (F(1.0f) + sine), F(0.0f)));
  };
  const F outside = select(e.both_out, F(2.0f), F(1.0f));
  const F reflected = fresnel(cosine(b.radius), b.index);
  const auto off = less(w.outer, outside);  // reflected at the outside
  F throughput = (F(1.0f) - reflected) * select(e.both_out, F(1.0f) - reflected, F(1.0f)) *
                 whole_power(reflected, w.outer - outside);
  throughput = select(off, select(b.mirror, F(1.0f), reflected), throughput);
  const auto visits = less(F(0.0f), w.inner);
  if (!any(visits)) return throughput;
  const F inner = fresnel(cosine(b.index * b.inner_radius), b.inner_index / b.index);
  const F visit = whole_power(inner, w.inner_reflected) * whole_power(F(1.0f) - inner, w.inner - w.inner_reflected);
  return select(visits, throughput * visit, throughput);
}

/// The event sequence of the specular path that carries most light: through the sphere by the fewest events, or off a
/// mirror.
template <class F>
TYNDALL_INLINE EventSequence<F> main_sequence(const SpecularSphere<F>& b, const PathEnds<F>& e) {
  const F one = F(1.0f), two = F(2.0f), none = F(0.0f);
  return {select(mask_and_not(e.both_out, b.mirror), two, one),
          select(b.hollow, select(e.both_out, two, select(e.deep, one, none)), none), none};
}

// Light by a sphere is asked for by the main event sequence, and by another one, which is drawn by decisions. Each of
// them takes one octal digit of 64 random bits. First: does the light reflect off the outside of the glass? Does it go
// past the inner sphere of a thick shell? Then, at each event: is it reflected? At the first one in solid glass it
// always is, because the event sequence would be the main one else.
inline constexpr int max_decisions = 16;  ///< about events at most; longer event sequences are left to scattering
inline constexpr float take_octal = 3.0f / 8.0f;  ///< probability of "yes"

/// Whether light can pass through a shell's glass without meeting the inner sphere.
template <class F>
TYNDALL_INLINE MaskOf<F> is_thick(const SpecularSphere<F>& b) {
  return mask_and(b.hollow, less(b.index * b.inner_radius, F(0.999f) * min(b.radius, b.index * b.radius)));
}

template <class F>
struct DrawnSequence {
  EventSequence<F> sequence;
  MaskOf<F> drawn;  ///< false where the event sequence would have more events than there are decisions
};

template <class F>
TYNDALL_INLINE MaskOf<F> same_sequence(const EventSequence<F>& a, const EventSequence<F>& b) {
  return mask_and(mask_and(equal(a.outer, b.outer), equal(a.inner, b.inner)),
                  equal(a.inner_reflected, b.inner_reflected));
}

/// The decisions that 64 random bits make, three bits each, from the highest down.
template <class F>
struct Decisions {
  UintOf<F> high, low;
  /// Whether the next digit, 0 ... 7, is below `limit`. Moves on to the digit after it.
  TYNDALL_INLINE MaskOf<F> below(std::int32_t limit) {
    const auto yes = less(as_int(shift_right<29>(high)), IntOf<F>(limit));
    high = shift_left<3>(high) | shift_right<29>(low);
    low = shift_left<3>(low);
    return yes;
  }
};

/// The state of an event sequence that is drawn event by event.
template <class F>
struct SequenceWalk {
  Decisions<F> decide;
  MaskOf<F> layered;  ///< the way meets the inner sphere
  MaskOf<F> open;     ///< more events follow; not if it only reflects off the outside
  IntOf<F> next;      ///< next event: 0 at the outer sphere, 1 at the inner one from the glass, 2 there from within
};

/// main: lanes that walk the main event sequence, which takes no decisions.
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
  walk.decide.high = select(main, U(0xffffffffu), select(b.hollow, walk.decide.high, yes_first));
  walk.layered = mask_and_not(b.hollow, past);
  walk.open = mask_and_not(e.valid, mask_or(off, b.mirror));
  walk.next = select(walk.layered, select(e.deep, I(2), I(1)), I(0));
  return walk;
}

/// One event of a walk. Neither at_outer nor at_inner is set in lanes whose walk has ended.
template <class F>
struct SequenceEvent {
  MaskOf<F> at_outer, at_inner, reflects;
};

/// Draws the walk's next event, and what follows it.
template <class F>
TYNDALL_INLINE SequenceEvent<F> step_walk(SequenceWalk<F>& walk) {
  using I = IntOf<F>;
  const auto reflects = walk.decide.below(3), at_outer = mask_and(walk.open, equal(walk.next, I(0)));
  const SequenceEvent<F> event{at_outer, mask_and_not(walk.open, at_outer), reflects};
  const auto from_glass = equal(walk.next, I(1));
  const I after_inner = select(reflects, select(from_glass, I(0), I(2)), select(from_glass, I(2), I(0)));
  walk.next = select(at_outer, select(walk.layered, I(1), I(0)), select(event.at_inner, after_inner, walk.next));
  walk.open = mask_and_not(walk.open, mask_and_not(at_outer, reflects));
  return event;
}

/// Draws another event sequence than the main one by random decisions. In a shell it may be the main one all the same.
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
  }
  return {w, mask_and_not(mask_and_not(e.valid, b.mirror), walk.open)};
}

/// How often light is asked for by the main event sequence. Solid glass focuses: a few points of the light may bring
/// almost all of the light, so that a second one is worth its time.
template <class F>
TYNDALL_INLINE F main_queries(const SpecularSphere<F>& b) {
  return select(mask_or(b.mirror, b.hollow), F(1.0f), F(2.0f));
}

/// How often, on average, light is asked for by these events in one given order: if they are the main event sequence as
/// often as main_queries() says, plus the probability that draw_sequence() draws them.
template <class F>
TYNDALL_INLINE F expected_queries(const SpecularSphere<F>& b, const PathEnds<F>& e, const EventSequence<F>& w) {
  const F yes = F(take_octal), no = F(1.0f) - yes;
  const F outside = select(e.both_out, F(2.0f), F(1.0f));
  const F reflections = (w.outer - outside) + w.inner_reflected, crossings = (w.inner - w.inner_reflected) + F(1.0f);
  const auto short_enough = less(reflections + crossings, F(max_decisions + 0.5f));
  const F chosen = reflections - select(b.hollow, F(0.0f), F(1.0f));  // the first one in solid glass is not
  const F walk = whole_power(yes, max(chosen, F(0.0f))) * whole_power(no, crossings);
  const auto past = mask_and_not(b.hollow, less(F(0.0f), w.inner));
  const F layers = select(is_thick(b), select(past, yes, no), select(past, F(0.0f), F(1.0f)));
  const F start = layers * no;
  const auto off = mask_and(e.both_out, equal(w.outer, F(1.0f)));
  const auto walks = mask_and(short_enough, less(F(-0.5f), chosen));
  const F walked = select(walks, walk * select(e.both_out, start, F(1.0f)), F(0.0f));
  const F other = select(b.mirror, F(0.0f), select(off, yes, walked));
  return select(e.valid, other + select(same_sequence(w, main_sequence(b, e)), main_queries(b), F(0.0f)), F(0.0f));
}

}  // namespace tyndall
