#pragma once
#include "core/base/vec.h"

/// Elementary functions for lanes: own polynomials, so that every instruction set computes the same to rounding and
/// nothing inside a kernel calls the C library. In double they call the standard library: that is the reference.
/// The coefficients were fitted for this project (minimax by Lawson's reweighting of least squares, relative error);
/// tests/base/math_test.cpp states each function's error.
namespace tyndall {

inline constexpr double pi = 3.14159265358979323846;

template <class F>
struct SinCos {
  F sin, cos;
};

/// Sine and cosine of 2π·u, u in [0, 1). Absolute error below 2.5e-7.
template <class F>
TYNDALL_INLINE SinCos<F> sin_cos_2pi(F u) {
  const auto odd = [](F t) {  // sin(2πt), |t| <= 1/4
    const F z = t * t;
    F p = mul_add(z, F(-14.381392f), F(42.007797f));
    p = mul_add(p, z, F(-76.70417f));
    p = mul_add(p, z, F(81.605225f));
    p = mul_add(p, z, F(-41.3417f));
    return mul_add(p, z, F(6.2831855f)) * t;
  };
  const F x = u - F(0.5f);  // the angle is 2πx + π: both functions change sign
  const F a = abs(x);
  const F folded = F(0.25f) - abs(a - F(0.25f));
  return {copy_sign(odd(folded), -x), -odd(F(0.25f) - a)};
}
template <>
TYNDALL_INLINE SinCos<double> sin_cos_2pi(double u) {
  return {std::sin(2 * pi * u), std::cos(2 * pi * u)};
}

/// Natural logarithm of a positive normal number. Relative error below 2e-7 (absolute near 1).
template <class F>
TYNDALL_INLINE F log(F x) {
  using U = UintOf<F>;
  const U b = float_bits(x);
  const F raw = from_int<F>(as_int(shift_right<23>(b))) - F(127.0f);
  const F m = float_from_bits((b & U(0x007fffffu)) | U(0x3f800000u));  // in [1, 2)
  const auto upper = less(F(1.41421356f), m);
  const F f = select(upper, m * F(0.5f), m) - F(1.0f);
  const F exponent = select(upper, raw + F(1.0f), raw);
  F p = mul_add(f, F(0.06746601f), F(-0.11675641f));
  p = mul_add(p, f, F(0.11888175f));
  p = mul_add(p, f, F(-0.12405591f));
  p = mul_add(p, f, F(0.14219551f));
  p = mul_add(p, f, F(-0.16667996f));
  p = mul_add(p, f, F(0.20002119f));
  p = mul_add(p, f, F(-0.2500001f));
  p = mul_add(p, f, F(0.33333313f));
  const F z = f * f;
  return mul_add(exponent, F(0.69314718f), mul_add(p * f, z, mul_add(z, F(-0.5f), f)));
}
template <>
TYNDALL_INLINE double log(double x) {
  return std::log(x);
}

/// e^x for x up to 80; below -80 it is e^-80. Relative error below 4e-7 for |x| below 10.
template <class F>
TYNDALL_INLINE F exp(F x) {
  using U = UintOf<F>;
  const F magic = F(12582912.0f);  // 1.5·2^23: adding it rounds to a whole number, held in the low bits
  const F y = max(x, F(-80.0f));
  const F shifted = mul_add(y, F(1.44269504f), magic);
  const F n = shifted - magic;
  // ln 2 in two parts: the first has few enough bits for n times it to be exact.
  const F r = mul_add(n, F(-1.42860677e-6f), mul_add(n, F(-0.693145752f), y));
  F p = mul_add(r, F(1.38146e-3f), F(8.36871e-3f));
  p = mul_add(p, r, F(0.04166839f));
  p = mul_add(p, r, F(0.16666521f));
  p = mul_add(p, r, F(0.49999994f));
  p = mul_add(p, r, F(1.0f));
  p = mul_add(p, r, F(1.0f));
  return float_from_bits(float_bits(p) + shift_left<23>(float_bits(shifted) & U(0x1ffu)));
}
template <>
TYNDALL_INLINE double exp(double x) {
  return std::exp(x < -80.0 ? -80.0 : x);
}

/// Cube root of x in [0, 1]; 0 gives a number below 1e-12.
template <class F>
TYNDALL_INLINE F cube_root(F x) {
  return exp(log(max(x, F(1e-37f))) * F(1.0f / 3.0f));
}

/// Angle of (x, y) in (-π, π]; (0, 0) gives 0. Absolute error below 3e-7.
template <class F>
TYNDALL_INLINE F atan2(F y, F x) {
  const F ax = abs(x), ay = abs(y);
  const F big = max(max(ax, ay), F(1e-37f));
  const F t = min(ax, ay) / big;
  const F z = t * t;
  F p = mul_add(z, F(0.00284985f), F(-0.01606848f));
  p = mul_add(p, z, F(0.04269128f));
  p = mul_add(p, z, F(-0.07504274f));
  p = mul_add(p, z, F(0.10640924f));
  p = mul_add(p, z, F(-0.14203642f));
  p = mul_add(p, z, F(0.1999262f));
  p = mul_add(p, z, F(-0.33333072f));
  F a = mul_add(p, z, F(1.0f)) * t;
  a = select(less(ax, ay), F(1.57079633f) - a, a);
  a = select(less(x, F(0.0f)), F(3.14159265f) - a, a);
  return copy_sign(a, y);
}
template <>
TYNDALL_INLINE double atan2(double y, double x) {
  return std::atan2(y, x);
}

/// Arc cosine of x in [-1, 1], in [0, π].
template <class F>
TYNDALL_INLINE F acos(F x) {
  return atan2(sqrt(max((F(1.0f) - x) * (F(1.0f) + x), F(0.0f))), x);
}

/// Two unit vectors that stand on the unit vector n and on each other (right-handed with n).
/// Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
template <class F>
struct Basis {
  Vec3<F> s, t;
};
template <class F>
TYNDALL_INLINE Basis<F> basis_around(Vec3<F> n) {
  const F sign = copy_sign(F(1.0f), n.z);
  const F a = F(-1.0f) / (sign + n.z);
  const F b = n.x * n.y * a;
  return {{mul_add(sign * n.x * n.x, a, F(1.0f)), sign * b, -sign * n.x}, {b, mul_add(n.y * n.y, a, sign), -n.y}};
}

}  // namespace tyndall
