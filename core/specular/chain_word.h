#pragma once
#include "core/materials/dielectric.h"
#include "core/shapes/chain_turn.h"
#include "core/trace/scene_view.h"

/// The word of a chain: which surfaces of a ball it meets and what happens there. Words are drawn at random; this file
/// tells how often, and which share of the light takes the way that a word describes. A ball is a mirror,
/// solid glass, or a shell: two spheres around one centre, with any refractive index between them and within.
namespace tyndall {

/// A ball's columns for each lane: see Chains.
template <class F>
struct ChainBall {
  Vec3<F> center;
  F radius, index;              ///< of the outer sphere, and the refractive index within it
  F inner_radius, inner_index;  ///< the same of the inner sphere; radius 0: there is none
  IntOf<F> outer, inner;        ///< elements of the spheres
  MaskOf<F> mirror, hollow;     ///< metal; a shell
  MaskOf<F> crowded;            ///< other things are in it or reach into it
};

template <class F>
TYNDALL_INLINE ChainBall<F> load_ball(const ChainView& c, IntOf<F> ball, F time) {
  const auto value = [&](const float* column) { return lookup<F>(column, c.balls, ball); };
  ChainBall<F> b;
  b.center = along(Vec3<F>{value(c.center[0]), value(c.center[1]), value(c.center[2])}, time,
                   Vec3<F>{value(c.move[0]), value(c.move[1]), value(c.move[2])});
  b.radius = value(c.radius), b.inner_radius = value(c.inner_radius);
  const F index = value(c.index);
  b.mirror = equal(index, F(0.0f));
  b.index = select(b.mirror, F(1.0f), index), b.inner_index = value(c.inner_index);
  b.hollow = less(F(0.0f), b.inner_radius);
  b.outer = lookup_int<F>(c.outer, c.balls, ball), b.inner = lookup_int<F>(c.inner, c.balls, ball);
  b.crowded = equal(lookup_int<F>(c.crowded, c.balls, ball), IntOf<F>(1));
  return b;
}

/// The events of a chain, counted by kind. Their order is left out, because neither the turn of the way nor the share
/// of light that takes it depends on it.
template <class F>
struct ChainWord {
  F outer;            ///< at the outer sphere
  F inner;            ///< at the inner sphere
  F inner_reflected;  ///< of these, reflections
};

/// Where a chain's ends are with regard to the ball. At least one must be outside of it.
template <class F>
struct ChainEnds {
  F near, far;              ///< distance of each end from the centre
  F near_reach, far_reach;  ///< these distances times the refractive index there
  F far_index;              ///< refractive index at the far end
  MaskOf<F> both_out;       ///< both ends are outside of the ball
  MaskOf<F> deep;           ///< one end is inside the inner sphere
  MaskOf<F> valid;          ///< one end is outside, the other not on a surface, in metal or in the glass of a shell
};

template <class F>
TYNDALL_INLINE ChainEnds<F> ends_of(const ChainBall<F>& b, F near, F far) {
  const F skin = F(1.0f + 1e-6f) * b.radius, core = F(1.0f - 1e-6f) * b.inner_radius;
  const F shell = select(b.hollow, core, b.radius * F(1.0f - 1e-6f));
  const auto near_out = less(skin, near), far_out = less(skin, far);
  const auto near_in = less(near, shell), far_in = less(far, shell);
  const F within = select(b.hollow, b.inner_index, b.index);
  ChainEnds<F> e;
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

/// Signs with which the ends' terms enter the turn. An end outside of the ball always has 1. An end within it has 1 if
/// the way from it to the ball's surface first comes closer to the centre, and -1 if it leads outward at once.
template <class F>
struct EndSigns {
  F near, far;
};

/// The turn of a word, and whether a way of that word can exist at all.
template <class F>
struct ChainTurn {
  Turn<F> turn;
  MaskOf<F> possible;
};

/// The turn of a chain, as the sum of: acos(p/a) - acos(p/R) for each end outside, at distance a; acos(p/(nR)) -
/// acos(p/(n Ri)) for each way through the glass of a shell; 2 acos(p/(m Ri)) for each chord within its inner sphere;
/// 2 acos(p/(nR)) for each chord through solid glass. R, Ri: radii of the spheres; n, m: refractive index within each.
template <class F>
TYNDALL_INLINE ChainTurn<F> turn_of(const ChainView& c, const ChainBall<F>& b, const ChainEnds<F>& e,
                                    const ChainWord<F>& w, const EndSigns<F>& sign) {
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
  ChainTurn<F> out;
  Turn<F>& turn = out.turn;
  turn.terms = c.shells ? 6 : 4;
  turn.most = min(reach[0], min(reach[1], reach[2]));
  for (int i = 3; i < turn.terms; ++i)
    turn.most = select(equal(times[i], F(0.0f)), turn.most, min(turn.most, reach[i]));
  for (int i = 0; i < turn.terms; ++i) {
    const F safe = select(equal(times[i], F(0.0f)), turn.most + turn.most, reach[i]);
    turn.times[i] = times[i], turn.inverse[i] = F(1.0f) / safe;
    turn.gap[i] = (safe - turn.most) * turn.inverse[i];
  }
  // A word that goes through the glass of a shell past its inner sphere: p must stay above n Ri.
  const auto misses = mask_and(mask_and(b.hollow, e.both_out), mask_and_not(less(F(1.0f), w.outer), visits));
  const F least = select(misses, b.index * b.inner_radius, F(0.0f));
  turn.last = select(misses, sqrt(max(F(1.0f) - least / turn.most, F(0.0f))), F(1.0f));
  out.possible = mask_and(e.valid, less(F(2.0f * least_parameter), turn.last));
  return out;
}

/// x to a whole power >= 0, x in [0, 1].
template <class F>
TYNDALL_INLINE F whole_power(F x, F exponent) {
  if (!any(less(F(0.5f), exponent))) return F(1.0f);
  return select(less(F(0.5f), exponent), exp(exponent * log(max(x, F(1e-30f)))), F(1.0f));
}

/// Share of the light that takes a chain: the product of what each surface reflects or lets through. All events at one
/// sphere have the same angle (Bouguer's formula), so that one share per sphere is enough.
template <class F>
TYNDALL_INLINE F share_of(const ChainBall<F>& b, const ChainEnds<F>& e, const ChainWord<F>& w, F p) {
  const auto cosine = [&](F reach) {
    const F sine = p / max(reach, F(1e-30f));
    return sqrt(max((F(1.0f) - sine) * (F(1.0f) + sine), F(0.0f)));
  };
  const F outside = select(e.both_out, F(2.0f), F(1.0f));
  const F reflected = fresnel(cosine(b.radius), b.index);
  const auto off = less(w.outer, outside);  // reflected at the outside
  F share = (F(1.0f) - reflected) * select(e.both_out, F(1.0f) - reflected, F(1.0f)) *
            whole_power(reflected, w.outer - outside);
  share = select(off, select(b.mirror, F(1.0f), reflected), share);
  const auto visits = less(F(0.0f), w.inner);
  if (!any(visits)) return share;
  const F inner = fresnel(cosine(b.index * b.inner_radius), b.inner_index / b.index);
  const F visit = whole_power(inner, w.inner_reflected) * whole_power(F(1.0f) - inner, w.inner - w.inner_reflected);
  return select(visits, share * visit, share);
}

/// The word of the chain that carries most light: through the ball by the fewest events, or off a mirror.
template <class F>
TYNDALL_INLINE ChainWord<F> main_word(const ChainBall<F>& b, const ChainEnds<F>& e) {
  const F one = F(1.0f), two = F(2.0f), none = F(0.0f);
  return {select(mask_and_not(e.both_out, b.mirror), two, one),
          select(b.hollow, select(e.both_out, two, select(e.deep, one, none)), none), none};
}

// Light by a ball is asked for by the main word, and by another one, which is drawn by decisions. Each of them
// takes one octal digit of 64 random bits. First: does the light reflect off the outside of the glass? Does it go past
// the inner sphere of a thick shell? Then, at each event: is it reflected? At the first one in solid glass it always
// is, because the word would be the main one else.
inline constexpr int most_decisions = 16;         ///< about events at most; longer words are left to scattering
inline constexpr float take_octal = 3.0f / 8.0f;  ///< probability of "yes"

/// Whether light can pass through a shell's glass without meeting the inner sphere.
template <class F>
TYNDALL_INLINE MaskOf<F> is_thick(const ChainBall<F>& b) {
  return mask_and(b.hollow, less(b.index * b.inner_radius, F(0.999f) * min(b.radius, b.index * b.radius)));
}

template <class F>
struct DrawnWord {
  ChainWord<F> word;
  MaskOf<F> drawn;  ///< false where the word would have more events than there are decisions
};

template <class F>
TYNDALL_INLINE MaskOf<F> same_word(const ChainWord<F>& a, const ChainWord<F>& b) {
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

/// The state of a word that is drawn event by event.
template <class F>
struct WordWalk {
  Decisions<F> decide;
  MaskOf<F> layered;  ///< the way meets the inner sphere
  MaskOf<F> open;     ///< more events follow; not if it only reflects off the outside
  IntOf<F> next;      ///< next event: 0 at the outer sphere, 1 at the inner one from the glass, 2 there from within
};

/// main: lanes that walk the main word, which takes no decisions.
template <class F>
TYNDALL_INLINE WordWalk<F> start_walk(const ChainBall<F>& b, const ChainEnds<F>& e, const Decisions<F>& decisions,
                                      MaskOf<F> main) {
  using I = IntOf<F>;
  using U = UintOf<F>;
  WordWalk<F> walk;
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
struct WordEvent {
  MaskOf<F> at_outer, at_inner, reflects;
};

/// Draws the walk's next event, and what follows it.
template <class F>
TYNDALL_INLINE WordEvent<F> step_walk(WordWalk<F>& walk) {
  using I = IntOf<F>;
  const auto reflects = walk.decide.below(3), at_outer = mask_and(walk.open, equal(walk.next, I(0)));
  const WordEvent<F> event{at_outer, mask_and_not(walk.open, at_outer), reflects};
  const auto from_glass = equal(walk.next, I(1));
  const I after_inner = select(reflects, select(from_glass, I(0), I(2)), select(from_glass, I(2), I(0)));
  walk.next = select(at_outer, select(walk.layered, I(1), I(0)), select(event.at_inner, after_inner, walk.next));
  walk.open = mask_and_not(walk.open, mask_and_not(at_outer, reflects));
  return event;
}

/// Draws another word than the main one by random decisions. In a shell it may be the main one all the same.
template <class F>
TYNDALL_INLINE DrawnWord<F> draw_word(const ChainBall<F>& b, const ChainEnds<F>& e, const Decisions<F>& decisions) {
  const F one = F(1.0f), none = F(0.0f);
  WordWalk<F> walk = start_walk(b, e, decisions, less(one, none));
  ChainWord<F> w{select(e.both_out, one, none), none, none};
  for (int i = 0; i < most_decisions && any(walk.open); ++i) {
    const WordEvent<F> event = step_walk(walk);
    w.outer = select(event.at_outer, w.outer + one, w.outer);
    w.inner = select(event.at_inner, w.inner + one, w.inner);
    const auto inner_reflected = mask_and(event.at_inner, event.reflects);
    w.inner_reflected = select(inner_reflected, w.inner_reflected + one, w.inner_reflected);
  }
  return {w, mask_and_not(mask_and_not(e.valid, b.mirror), walk.open)};
}

/// How often light is asked for by the main word. Solid glass focuses: a few points of the lamp may bring almost all of
/// the light, so that a second one is worth its time.
template <class F>
TYNDALL_INLINE F main_asked(const ChainBall<F>& b) {
  return select(mask_or(b.mirror, b.hollow), F(1.0f), F(2.0f));
}

/// How often, on average, light is asked for by these events in one given order: if they are the main word as often as
/// main_asked() says, plus the probability that draw_word() draws them.
template <class F>
TYNDALL_INLINE F times_asked(const ChainBall<F>& b, const ChainEnds<F>& e, const ChainWord<F>& w) {
  const F yes = F(take_octal), no = F(1.0f) - yes;
  const F outside = select(e.both_out, F(2.0f), F(1.0f));
  const F reflections = (w.outer - outside) + w.inner_reflected, crossings = (w.inner - w.inner_reflected) + F(1.0f);
  const auto short_enough = less(reflections + crossings, F(most_decisions + 0.5f));
  const F chosen = reflections - select(b.hollow, F(0.0f), F(1.0f));  // the first one in solid glass is not
  const F walk = whole_power(yes, max(chosen, F(0.0f))) * whole_power(no, crossings);
  const auto past = mask_and_not(b.hollow, less(F(0.0f), w.inner));
  const F layers = select(is_thick(b), select(past, yes, no), select(past, F(0.0f), F(1.0f)));
  const F start = layers * no;
  const auto off = mask_and(e.both_out, equal(w.outer, F(1.0f)));
  const auto walks = mask_and(short_enough, less(F(-0.5f), chosen));
  const F walked = select(walks, walk * select(e.both_out, start, F(1.0f)), F(0.0f));
  const F other = select(b.mirror, F(0.0f), select(off, yes, walked));
  return select(e.valid, other + select(same_word(w, main_word(b, e)), main_asked(b), F(0.0f)), F(0.0f));
}

}  // namespace tyndall
