#pragma once
#include "core/base/math.h"

/// Solves for paths of light between two points, through or off concentric spheres. By Bouguer's formula (Born & Wolf,
/// Principles of Optics, section 3.2.1) p = n r sin(angle to the radius) is constant along such a path, in every layer.
/// So a path between two points by given surfaces lies in one plane and has one unknown, p. The condition on p is the
/// deflection: the angle about the centre from one point to the other. From radius r to its closest point to the centre
/// a path covers the angle acos(p / (n r)), so that the whole deflection is a sum of such terms.
namespace tyndall {

/// acos(1 - h) divided by its sine, sqrt(h (2 - h)), for h in [0, 1]. Minimax polynomial by Remez' algorithm; relative
/// error below 2e-7.
template <class F>
TYNDALL_INLINE F angle_over_sine(F h) {
  F p = mul_add(h, F(0.0174790093f), F(-0.0425665624f));
  p = mul_add(p, h, F(0.0606407747f));
  p = mul_add(p, h, F(-0.0251881708f));
  p = mul_add(p, h, F(0.039184569f));
  p = mul_add(p, h, F(0.0543024304f));
  p = mul_add(p, h, F(0.133621922f));
  p = mul_add(p, h, F(0.333322173f));
  return mul_add(p, h, F(1.00000007f));
}
template <>
TYNDALL_INLINE double angle_over_sine(double h) {
  return std::atan2(std::sqrt(h * (2 - h)), 1 - h) / std::sqrt(h * (2 - h));
}

/// The deflection of paths through given surfaces, in radians, as a function of s, where p = maximum (1 - s²). At s = 0
/// the path grazes the surface that limits p; at s = 1 it goes through the centre. All terms are smooth functions of s;
/// of p they are not, because acos has an infinite slope where the path grazes.
template <class F>
struct Deflection {
  static constexpr int max_terms = 6;
  F gap[max_terms];      ///< 1 - maximum / (n r) of each term, at least 0
  F inverse[max_terms];  ///< 1 / (n r)
  F times[max_terms];    ///< factor of each term; negative: it is subtracted
  F maximum;             ///< largest possible p
  F last;                ///< s of the smallest possible p
  MaskOf<F> possible;    ///< false: no path exists
  int terms;
};

/// Paths with a smaller s are left out: they graze, with p within a hundred-millionth of its largest value.
inline constexpr float min_parameter = 1e-4f;

template <class F>
struct DeflectionAt {
  F angle, slope;  ///< in radians; slope: derivative by s
};

template <class F>
TYNDALL_INLINE DeflectionAt<F> deflection_at(const Deflection<F>& deflection, F s) {
  const F drop = deflection.maximum * s * s;
  F angle = F(0.0f), above = F(0.0f), below = F(1.0f);  // the slope's terms over a common denominator
  for (int i = 0; i < deflection.terms; ++i) {
    const F h = mul_add(drop, deflection.inverse[i], deflection.gap[i]);  // 1 - p / (n r), without cancellation
    const F sine = sqrt(h * (F(2.0f) - h));
    angle = mul_add(deflection.times[i], sine * angle_over_sine(h), angle);
    above = mul_add(above, sine, deflection.times[i] * deflection.inverse[i] * below);
    below = below * sine;
  }
  return {angle, F(2.0f) * deflection.maximum * s * above / below};
}

/// An interval of s.
template <class F>
struct Piece {
  F low, high, at_low, at_high;  ///< its ends, and the deflection or its slope there
};

/// One of the paths between two points.
template <class F>
struct DeflectionRoot {
  MaskOf<F> found;
  F s, slope;  ///< slope: of the deflection, before Newton's last step
  F p;
  F sense;  ///< 1: the path covers the angle between the points; -1: the other way round
};

/// Finds the s of a piece at which the deflection is `target`, a value between those at the piece's ends: by Newton's
/// method, and by halving where Newton's step would leave the piece. The deflection must be monotonic on the piece.
/// folded: it has its extremum at the low end (1), at the high end (-1) or at neither (0).
template <class F>
TYNDALL_INLINE void find_root(const Deflection<F>& deflection, const Piece<F>& piece, F target, F folded,
                              DeflectionRoot<F>& root) {
  constexpr int steps = std::is_same_v<F, double> ? 40 : 5;
  const auto rises = less(piece.at_low, piece.at_high);
  const F span = select(equal(piece.at_low, piece.at_high), F(1.0f), piece.at_high - piece.at_low);
  const F fraction = min(max((target - piece.at_low) / span, F(0.0f)), F(1.0f));
  const F from_fold = sqrt(select(less(folded, F(0.0f)), F(1.0f) - fraction, fraction));  // a parabola at the extremum
  const F part =
      select(equal(folded, F(0.0f)), fraction, select(less(folded, F(0.0f)), F(1.0f) - from_fold, from_fold));
  F low = piece.low, high = piece.high;
  F s = mul_add(high - low, part, low), slope = F(0.0f);
  for (int i = 0; i < steps; ++i) {
    const DeflectionAt<F> at = deflection_at(deflection, s);
    const F off = at.angle - target;
    const auto above = less(F(0.0f), select(rises, off, -off));
    high = select(above, s, high), low = select(above, low, s);
    const F next = s - off / at.slope;  // not a number where the slope is 0: then it does not count as inside
    const auto inside = mask_and(less_equal(low, next), less_equal(next, high));
    s = select(inside, next, F(0.5f) * (low + high));
    slope = at.slope;
  }
  root.s = s, root.slope = slope, root.p = deflection.maximum * (F(1.0f) - s * s);
}

/// The deflection at the largest s. There the path goes through the centre, and every term is a right angle, except in
/// lanes whose largest s is below 1. Each lane chooses its formula by its own numbers: the two differ in their last
/// bits, and the result of a lane must not depend on the lanes beside it.
template <class F>
TYNDALL_INLINE DeflectionAt<F> last_deflection(const Deflection<F>& deflection) {
  F times = F(0.0f), slope = F(0.0f);
  for (int i = 0; i < deflection.terms; ++i) {
    times = times + deflection.times[i];
    slope = mul_add(deflection.times[i], deflection.inverse[i], slope);
  }
  const DeflectionAt<F> center{F(static_cast<float>(0.5 * pi)) * times, F(2.0f) * deflection.maximum * slope};
  const auto beside = less(deflection.last, F(1.0f));
  if (!any(beside)) return center;
  const DeflectionAt<F> at = deflection_at(deflection, deflection.last);
  return {select(beside, at.angle, center.angle), select(beside, at.slope, center.slope)};
}

/// Narrows an interval at whose ends the slopes of the deflection differ in sign, by one round of the method of C.
/// Ridders, A New Algorithm for Computing a Single Root of a Real Continuous Function, IEEE Transactions on Circuits
/// and Systems 26(11), 1979.
template <class F>
TYNDALL_INLINE void narrow(const Deflection<F>& deflection, Piece<F>& b) {
  const F middle = F(0.5f) * (b.low + b.high), at_middle = deflection_at(deflection, middle).slope;
  const F root = sqrt(max(at_middle * at_middle - b.at_low * b.at_high, F(1e-30f)));
  const F step = (middle - b.low) * copy_sign(F(1.0f), b.at_low - b.at_high) * at_middle / root;
  const F place = min(max(middle + step, b.low), b.high), at_place = deflection_at(deflection, place).slope;
  const auto replace = [&](F s, F slope) __attribute__((always_inline)) {
    const auto like_low = less(F(0.0f), slope * b.at_low), inside = mask_and(less(b.low, s), less(s, b.high));
    const auto low = mask_and(inside, like_low), high = mask_and_not(inside, like_low);
    b.low = select(low, s, b.low), b.at_low = select(low, slope, b.at_low);
    b.high = select(high, s, b.high), b.at_high = select(high, slope, b.at_high);
  };
  replace(middle, at_middle);
  replace(place, at_place);
}

/// Paths in a piece whose deflection is a given angle plus any number of whole revolutions.
template <class F>
struct Revolutions {
  F first, count;  ///< revolutions of the first path; number of paths, each one revolution more
};

template <class F>
TYNDALL_INLINE Revolutions<F> count_revolutions(const Piece<F>& piece, F angle) {
  const F whole = F(static_cast<float>(0.5 / pi));
  const F first = floor((min(piece.at_low, piece.at_high) - angle) * whole) + F(1.0f);
  return {first, floor((max(piece.at_low, piece.at_high) - angle) * whole) + F(1.0f) - first};
}

/// All paths between two points. The deflection over all s is cut into two pieces, on which it is monotonic. It is
/// assumed to have at most one extremum, and none where the slopes at both ends have the same sign. (It had two in one
/// of a thousand tested geometries of a shell that is not filled with air.)
template <class F>
struct DeflectionRoots {
  Piece<F> outer, inner;  ///< outer starts with grazing paths; inner is empty (low == high) where nothing was cut
  MaskOf<F> folded;       ///< the deflection was cut at an extremum
  Revolutions<F> outer_forth, outer_back, inner_forth, inner_back;  ///< back: the deflection is the negative angle
  F count;
};

/// angle: between the two points, seen from the centre, in [0, pi].
template <class F>
TYNDALL_INLINE DeflectionRoots<F> list_roots(const Deflection<F>& deflection, F angle, MaskOf<F> lanes) {
  // Two rounds and the secant below mostly give the deflection there to 1e-6, the rounding error of float.
  constexpr int rounds = std::is_same_v<F, double> ? 8 : 2;
  const F first = F(min_parameter);
  const DeflectionAt<F> start = deflection_at(deflection, first), end = last_deflection(deflection);
  DeflectionRoots<F> roots;
  roots.folded = mask_not(less_equal(F(0.0f), start.slope * end.slope));
  F middle = deflection.last, at_middle = end.angle;
  if (any(roots.folded)) {
    Piece<F> b{first, deflection.last, start.slope, end.slope};
    for (int i = 0; i < rounds; ++i) narrow(deflection, b);
    const F secant = b.low + (b.high - b.low) * b.at_low / (b.at_low - b.at_high);
    const F place = select(mask_and(less_equal(b.low, secant), less_equal(secant, b.high)), secant, b.low);
    middle = select(roots.folded, place, middle);
    at_middle = select(roots.folded, deflection_at(deflection, middle).angle, at_middle);
  }
  roots.outer = {first, middle, start.angle, at_middle}, roots.inner = {middle, deflection.last, at_middle, end.angle};
  roots.outer_forth = count_revolutions(roots.outer, angle), roots.outer_back = count_revolutions(roots.outer, -angle);
  roots.inner_forth = count_revolutions(roots.inner, angle), roots.inner_back = count_revolutions(roots.inner, -angle);
  const F all = (roots.outer_forth.count + roots.outer_back.count) + (roots.inner_forth.count + roots.inner_back.count);
  roots.count = select(lanes, all, F(0.0f));
  return roots;
}

/// Solves for path number `index` of the list, counted from 0.
template <class F>
TYNDALL_INLINE DeflectionRoot<F> take_root(const Deflection<F>& deflection, const DeflectionRoots<F>& roots, F angle,
                                           F index) {
  const F in_outer = roots.outer_forth.count + roots.outer_back.count;
  const auto deeper = less_equal(in_outer, index);
  const auto pick = [&](auto a, auto b) __attribute__((always_inline)) { return select(deeper, a, b); };
  const F rest = pick(index - in_outer, index);
  const F forth = pick(roots.inner_forth.count, roots.outer_forth.count);
  const auto back = less_equal(forth, rest);
  const F revolutions = select(back, pick(roots.inner_back.first, roots.outer_back.first) + (rest - forth),
                               pick(roots.inner_forth.first, roots.outer_forth.first) + rest);
  DeflectionRoot<F> root;
  root.found = less(index, roots.count), root.sense = select(back, F(-1.0f), F(1.0f));
  const F target = mul_add(revolutions, F(static_cast<float>(2 * pi)), root.sense * angle);
  const Piece<F>&o = roots.outer, &i = roots.inner;
  const Piece<F> piece{pick(i.low, o.low), pick(i.high, o.high), pick(i.at_low, o.at_low), pick(i.at_high, o.at_high)};
  find_root(deflection, piece, target, select(roots.folded, pick(F(1.0f), F(-1.0f)), F(0.0f)), root);
  return root;
}

}  // namespace tyndall
