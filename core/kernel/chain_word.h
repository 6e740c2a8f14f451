#pragma once
#include "core/kernel/chain_turn.h"
#include "core/kernel/scene_view.h"
#include "core/materials/dielectric.h"

/// Which surfaces of a ball a chain meets, in which way, and what that is worth. A ball is a mirror, solid glass or a
/// shell: two concentric spheres, with any index between them and within.
namespace tyndall {

template <class F>
struct ChainBall {
  Vec3<F> center;
  F radius, index;              ///< of the outer sphere, and within it
  F inner_radius, inner_index;  ///< of the inner sphere, and within it; radius 0: there is none
  IntOf<F> outer, inner;        ///< elements
  MaskOf<F> mirror, hollow, crowded;
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

/// The events of a chain, counted.
template <class F>
struct ChainWord {
  F outer;            ///< at the outer sphere
  F inner;            ///< at the inner sphere
  F inner_reflected;  ///< of these, reflections
};

/// Where a chain's ends are: at least one is outside of the ball.
template <class F>
struct ChainEnds {
  F near, far;              ///< distance of each end from the centre
  F near_reach, far_reach;  ///< times the index there
  F far_index;
  MaskOf<F> both_out;
  MaskOf<F> deep;   ///< one end is inside the inner sphere
  MaskOf<F> valid;  ///< not both inside, none within the glass of a shell
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

/// Signs of the ends' terms: 1 where the way there is between the end and the place next to the centre, -1 where it
/// leads straight away from that place.
template <class F>
struct EndSigns {
  F near, far;
};

template <class F>
struct ChainTurn {
  Turn<F> turn;
  MaskOf<F> possible;
};

/// The turn of a chain. Outside: acos(p/a) - acos(p/R), for each end; each way through the glass of a shell:
/// acos(p/(nR)) - acos(p/(n Ri)); each chord within it 2 acos(p/(m Ri)); through solid glass 2 acos(p/(nR)).
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
  // Through the glass of a shell past its inner sphere.
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

/// Share of light that takes a chain of all that comes along it: the product of what each surface reflects or lets
/// through. By Bouguer's formula the angles are the same at all events of a sphere.
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

/// The chain that carries most: through the ball by the fewest events, or off a mirror.
template <class F>
TYNDALL_INLINE ChainWord<F> main_word(const ChainBall<F>& b, const ChainEnds<F>& e) {
  const F one = F(1.0f), two = F(2.0f), none = F(0.0f);
  return {select(mask_and_not(e.both_out, b.mirror), two, one),
          select(b.hollow, select(e.both_out, two, select(e.deep, one, none)), none), none};
}

// Words are drawn, an octal digit a decision: first whether it is the main one, else whether off the outside of glass,
// whether past the inner sphere of a thick shell, and then whether to be reflected at each event.
inline constexpr int most_decisions = 7;
inline constexpr std::int32_t main_digits = 6;  ///< of eight
inline constexpr float take_main = 0.125f * main_digits;
inline constexpr float take_octal = 3.0f / 8.0f;  ///< probability of "yes" in each of the others

/// Whether rays can pass through a shell's glass and miss what is within.
template <class F>
TYNDALL_INLINE MaskOf<F> is_thick(const ChainBall<F>& b) {
  return mask_and(b.hollow, less(b.index * b.inner_radius, F(0.999f) * min(b.radius, b.index * b.radius)));
}

template <class F>
struct DrawnWord {
  ChainWord<F> word;
  MaskOf<F> drawn;  ///< none where it grew too long
};

template <class F>
TYNDALL_INLINE MaskOf<F> same_word(const ChainWord<F>& a, const ChainWord<F>& b) {
  return mask_and(mask_and(equal(a.outer, b.outer), equal(a.inner, b.inner)),
                  equal(a.inner_reflected, b.inner_reflected));
}

/// Decisions, the highest octal digit first.
template <class F>
struct Decisions {
  UintOf<F> digits;
  TYNDALL_INLINE MaskOf<F> below(std::int32_t limit) {
    const auto yes = less(as_int(shift_right<29>(digits)), IntOf<F>(limit));
    digits = shift_left<3>(digits);
    return yes;
  }
};

/// A word while it is drawn, event by event.
template <class F>
struct WordWalk {
  Decisions<F> decide;
  MaskOf<F> main, off;  ///< the main word; reflected at the outside of glass
  MaskOf<F> layered;    ///< the way meets the inner sphere
  MaskOf<F> open;       ///< more events follow
  IntOf<F> next;        ///< event: 0 at the outer sphere, 1 at the inner one from the glass, 2 from within
};

template <class F>
TYNDALL_INLINE WordWalk<F> start_walk(const ChainBall<F>& b, const ChainEnds<F>& e, UintOf<F> digits) {
  using I = IntOf<F>;
  WordWalk<F> walk;
  walk.decide = {digits};
  walk.main = mask_or(b.mirror, walk.decide.below(main_digits));
  walk.off = mask_and_not(mask_and(e.both_out, walk.decide.below(3)), walk.main);
  const auto past = mask_and(mask_and(e.both_out, is_thick(b)), walk.decide.below(3));
  walk.layered = mask_and(b.hollow, mask_or(walk.main, mask_not(past)));
  walk.open = mask_and_not(e.valid, mask_or(walk.off, walk.main));
  walk.next = select(walk.layered, select(e.deep, I(2), I(1)), I(0));
  return walk;
}

template <class F>
struct WordEvent {
  MaskOf<F> at_outer, at_inner, reflects;
};

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

template <class F>
TYNDALL_INLINE DrawnWord<F> draw_word(const ChainBall<F>& b, const ChainEnds<F>& e, UintOf<F> digits) {
  const F one = F(1.0f), none = F(0.0f);
  WordWalk<F> walk = start_walk(b, e, digits);
  ChainWord<F> w{select(e.both_out, one, none), none, none};
  for (int i = 0; i < most_decisions && any(walk.open); ++i) {
    const WordEvent<F> event = step_walk(walk);
    w.outer = select(event.at_outer, w.outer + one, w.outer);
    w.inner = select(event.at_inner, w.inner + one, w.inner);
    const auto inner_reflected = mask_and(event.at_inner, event.reflects);
    w.inner_reflected = select(inner_reflected, w.inner_reflected + one, w.inner_reflected);
  }
  const ChainWord<F> first = main_word(b, e);
  return {{select(walk.main, first.outer, w.outer), select(walk.main, first.inner, w.inner),
           select(walk.main, first.inner_reflected, w.inner_reflected)},
          mask_and_not(e.valid, walk.open)};
}

/// Probability with which a word is looked for.
template <class F>
TYNDALL_INLINE F word_probability(const ChainBall<F>& b, const ChainEnds<F>& e, const ChainWord<F>& w) {
  const F yes = F(take_octal), no = F(1.0f) - yes;
  const F outside = select(e.both_out, F(2.0f), F(1.0f));
  const F reflections = (w.outer - outside) + w.inner_reflected, crossings = (w.inner - w.inner_reflected) + F(1.0f);
  const auto short_enough = less(reflections + crossings, F(most_decisions + 0.5f));
  const F walk = whole_power(yes, max(reflections, F(0.0f))) * whole_power(no, crossings);
  const auto past = mask_and_not(b.hollow, less(F(0.0f), w.inner));
  const F layers = select(is_thick(b), select(past, yes, no), select(past, F(0.0f), F(1.0f)));
  const F start = layers * no;
  const auto off = mask_and(e.both_out, equal(w.outer, F(1.0f)));
  const F walked = select(short_enough, walk * select(e.both_out, start, F(1.0f)), F(0.0f));
  const F other = F(1.0f - take_main) * select(off, yes, walked);
  const F probability = other + select(same_word(w, main_word(b, e)), F(take_main), F(0.0f));
  return select(e.valid, select(b.mirror, F(1.0f), probability), F(0.0f));
}

}  // namespace tyndall
