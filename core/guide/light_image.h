#pragma once
#include "core/trace/guide.h"

/// The names of paths by what they meet, near-specular surfaces (glass, mirrors, metal of little fuzz) in order; and
/// where a point sees the middle of a light by way of flat mirrors and at most one reflection off the outside of a
/// sphere. Other sequences of events have no such image: only a lobe's first order tells where the light is seen.
namespace tyndall {

inline constexpr int max_guided_events = 10;
inline constexpr int max_guided_things = 31;  ///< near-specular elements that a scene's guide knows

/// A sequence of up to max_guided_events events. Each takes six bits, 2 · (element's index + 1) + (1: reflected), where
/// the index counts near-specular elements. The last event is in the lowest bits.
template <class F>
struct OrderedEvents {
  using I = IntOf<F>;
  I low, high;  ///< the last five events; those before them

  TYNDALL_INLINE static OrderedEvents none() { return {I(0), I(0)}; }
  /// Of paths that meet something else, or too much.
  TYNDALL_INLINE static OrderedEvents unknown() { return {I(-1), I(0)}; }
  TYNDALL_INLINE MaskOf<F> is_known() const { return less_equal(I(0), low); }
  TYNDALL_INLINE MaskOf<F> has_events() const { return less(I(0), low); }

  /// The element's index of the event in the lowest bits, and whether that reflects; -1: there is none.
  TYNDALL_INLINE I lowest_thing() const { return as_int(shift_right<1>(as_uint(low & I(63)))) - I(1); }
  TYNDALL_INLINE MaskOf<F> lowest_reflects() const { return equal(low & I(1), I(1)); }
  TYNDALL_INLINE OrderedEvents without_lowest() const {
    const I carry = as_int(shift_left<24>(as_uint(high & I(63))));
    return {as_int(shift_right<6>(as_uint(low))) + carry, as_int(shift_right<6>(as_uint(high)))};
  }
};

template <class F>
TYNDALL_INLINE MaskOf<F> same_events(const OrderedEvents<F>& a, const OrderedEvents<F>& b) {
  return mask_and(equal(a.low, b.low), equal(a.high, b.high));
}

template <class F>
TYNDALL_INLINE OrderedEvents<F> select(MaskOf<F> m, const OrderedEvents<F>& a, const OrderedEvents<F>& b) {
  return {select(m, a.low, b.low), select(m, a.high, b.high)};
}

/// `before` and one more event. thing: index of the element; -1: an element that is not near-specular.
template <class F>
TYNDALL_INLINE OrderedEvents<F> append_event(const OrderedEvents<F>& before, IntOf<F> thing, MaskOf<F> reflected) {
  using I = IntOf<F>;
  const I code = thing + thing + I(2) + select(reflected, I(1), I(0));
  const I low = as_int(shift_left<6>(as_uint(before.low & I(0x00ffffff)))) + code;
  const I carry = as_int(shift_right<24>(as_uint(before.low)));
  const I high = as_int(shift_left<6>(as_uint(before.high))) + carry;
  const auto full = less(I(0x00ffffff), before.high);
  const auto fits = mask_and_not(mask_and(before.is_known(), less_equal(I(0), thing)), full);
  return select(fits, OrderedEvents<F>{low, high}, OrderedEvents<F>::unknown());
}

/// The direction towards a light's middle.
template <class F>
struct SeenImage {
  Vec3<F> direction;  ///< unit, from the point
  MaskOf<F> exists;   ///< false where the sphere hides the light
};

/// Alhazen's problem, solved by Newton's method. In the plane of the point, the sphere's centre and the light, in units
/// of the radius, let the point be at the distance A from the centre and the light at B, at the angle phi from it. The
/// place of reflection is at the angle t from the point where both see it at the same angle from its normal:
///
///     A sin t (B cos(phi - t) - 1) = B sin(phi - t) (A cos t - 1)
///
/// After five steps t is exact to 1e-4 in 98 of 100 cases with A - 1 and B - 1 between 0.001 and 100; the rest are at
/// the border of the sphere's shadow.
template <class F>
TYNDALL_INLINE SeenImage<F> reflect_in_sphere(const LightImage<F>& image, Vec3<F> point) {
  const F one = F(1.0f), scale = one / image.radius;
  const Vec3<F> to_point = scale * (point - image.sphere), to_light = scale * (image.light - image.sphere);
  const F a = sqrt(max(dot(to_point, to_point), F(1e-30f))), b = sqrt(max(dot(to_light, to_light), F(1e-30f)));
  const Vec3<F> start = (one / a) * to_point, end = (one / b) * to_light;
  const F cos_phi = dot(start, end);
  const Vec3<F> across = end - cos_phi * start;
  const F sin_phi = sqrt(max(dot(across, across), F(1e-12f)));
  const Vec3<F> side = (one / sin_phi) * across;
  // The first guess is right where both are far away, and where one of them is at the sphere.
  const F high_a = max(one - one / a, F(0.0f)), high_b = max(one - one / b, F(0.0f));
  const F part = high_a / max(high_a + high_b, F(1e-6f));
  const Vec3<F> guess = (one - part) * start + part * end;
  const F inverse = one / sqrt(max(dot(guess, guess), F(1e-12f))), product = a * b;
  F c = inverse * dot(guess, start), s = inverse * dot(guess, side);  // cosine and sine of t
  for (int i = 0; i < 5; ++i) {
    const F cos_rest = cos_phi * c + sin_phi * s, sin_rest = sin_phi * c - cos_phi * s;
    const F value = product * (s * cos_rest - c * sin_rest) - a * s + b * sin_rest;
    const F slope = F(2.0f) * product * (c * cos_rest + s * sin_rest) - a * c - b * cos_rest;
    const F half = F(-0.5f) * min(max(value / max(slope, F(1e-3f) * product), F(-0.5f)), F(0.5f));
    const F by = one / (one + half * half), cos_step = by * (one - half * half), sin_step = F(2.0f) * by * half;
    const F next = c * cos_step - s * sin_step;
    s = s * cos_step + c * sin_step, c = next;
  }
  const auto seen = mask_and(less(one, a * c), less(one, b * (cos_phi * c + sin_phi * s)));
  return {normalize(c * start + s * side - to_point), seen};
}

/// How a point sees the image.
template <class F>
TYNDALL_INLINE SeenImage<F> see_image(const LightImage<F>& image, Vec3<F> point) {
  const auto round = less(F(0.0f), image.radius);
  const Vec3<F> straight = normalize(image.light - point);
  if (!any(round)) return {straight, mask_not(round)};
  LightImage<F> safe = image;
  safe.radius = select(round, image.radius, F(1.0f));
  const SeenImage<F> off = reflect_in_sphere(safe, point);
  return {select(round, off.direction, straight), mask_or(off.exists, mask_not(round))};
}

}  // namespace tyndall
