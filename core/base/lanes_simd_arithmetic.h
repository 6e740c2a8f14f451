#pragma once
#include "core/base/lanes.h"

#include <hwy/highway.h>

#include <concepts>

/// The arithmetic of base/lanes_simd.h.
namespace tyndall {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using TagF = hn::ScalableTag<float>;
using TagI = hn::ScalableTag<std::int32_t>;
using TagU = hn::ScalableTag<std::uint32_t>;
inline constexpr int native_lanes = static_cast<int>(hn::MaxLanes(TagF()));

struct Mask {
  using Scalar = Mask;
  static constexpr int lanes = native_lanes;
  hn::Mask<TagF> v;
};

struct Floats {
  using Scalar = float;
  hn::Vec<TagF> v;
  Floats() = default;
  TYNDALL_INLINE Floats(float value) { v = hn::Set(TagF(), value); }
};

struct Ints {
  using Scalar = std::int32_t;
  hn::Vec<TagI> v;
  Ints() = default;
  TYNDALL_INLINE Ints(std::int32_t value) { v = hn::Set(TagI(), value); }
};

struct Uints {
  using Scalar = std::uint32_t;
  hn::Vec<TagU> v;
  Uints() = default;
  TYNDALL_INLINE Uints(std::uint32_t value) { v = hn::Set(TagU(), value); }
};

TYNDALL_INLINE Floats operator+(Floats a, Floats b) {
  a.v = hn::Add(a.v, b.v);
  return a;
}
TYNDALL_INLINE Floats operator-(Floats a, Floats b) {
  a.v = hn::Sub(a.v, b.v);
  return a;
}
TYNDALL_INLINE Floats operator*(Floats a, Floats b) {
  a.v = hn::Mul(a.v, b.v);
  return a;
}
TYNDALL_INLINE Floats operator/(Floats a, Floats b) {
  a.v = hn::Div(a.v, b.v);
  return a;
}
TYNDALL_INLINE Floats operator-(Floats a) {
  a.v = hn::Neg(a.v);
  return a;
}
TYNDALL_INLINE Ints operator+(Ints a, Ints b) {
  a.v = hn::Add(a.v, b.v);
  return a;
}
TYNDALL_INLINE Ints operator-(Ints a, Ints b) {
  a.v = hn::Sub(a.v, b.v);
  return a;
}
TYNDALL_INLINE Ints operator*(Ints a, Ints b) {
  a.v = hn::Mul(a.v, b.v);
  return a;
}
TYNDALL_INLINE Ints operator&(Ints a, Ints b) {
  a.v = hn::And(a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints operator+(Uints a, Uints b) {
  a.v = hn::Add(a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints operator*(Uints a, Uints b) {
  a.v = hn::Mul(a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints operator^(Uints a, Uints b) {
  a.v = hn::Xor(a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints operator&(Uints a, Uints b) {
  a.v = hn::And(a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints operator|(Uints a, Uints b) {
  a.v = hn::Or(a.v, b.v);
  return a;
}

TYNDALL_INLINE Mask operator<(Floats a, Floats b) {
  Mask m;
  m.v = hn::Lt(a.v, b.v);
  return m;
}
TYNDALL_INLINE Mask operator<=(Floats a, Floats b) {
  Mask m;
  m.v = hn::Le(a.v, b.v);
  return m;
}
TYNDALL_INLINE Mask operator==(Floats a, Floats b) {
  Mask m;
  m.v = hn::Eq(a.v, b.v);
  return m;
}
TYNDALL_INLINE Mask operator==(Ints a, Ints b) {
  Mask m;
  m.v = hn::RebindMask(TagF(), hn::Eq(a.v, b.v));
  return m;
}
TYNDALL_INLINE Mask operator<(Ints a, Ints b) {
  Mask m;
  m.v = hn::RebindMask(TagF(), hn::Lt(a.v, b.v));
  return m;
}
TYNDALL_INLINE Mask operator<=(Ints a, Ints b) {
  Mask m;
  m.v = hn::RebindMask(TagF(), hn::Not(hn::Lt(b.v, a.v)));
  return m;
}

TYNDALL_INLINE Mask mask_and(Mask a, Mask b) {
  a.v = hn::And(a.v, b.v);
  return a;
}
TYNDALL_INLINE Mask mask_or(Mask a, Mask b) {
  a.v = hn::Or(a.v, b.v);
  return a;
}
TYNDALL_INLINE Mask mask_not(Mask a) {
  a.v = hn::Not(a.v);
  return a;
}
TYNDALL_INLINE Mask mask_and_not(Mask a, Mask b) {
  a.v = hn::AndNot(b.v, a.v);
  return a;
}
TYNDALL_INLINE bool any(Mask a) { return !hn::AllFalse(TagF(), a.v); }
TYNDALL_INLINE bool all(Mask a) { return hn::AllTrue(TagF(), a.v); }
TYNDALL_INLINE std::uint32_t bits(Mask a) {
#if HWY_TARGET == HWY_AVX3
  return a.v.raw;
#else
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(TagF(), a.v, bytes);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
#endif
}

TYNDALL_INLINE Floats select(Mask m, Floats a, Floats b) {
  a.v = hn::IfThenElse(m.v, a.v, b.v);
  return a;
}
TYNDALL_INLINE Ints select(Mask m, Ints a, Ints b) {
  a.v = hn::IfThenElse(hn::RebindMask(TagI(), m.v), a.v, b.v);
  return a;
}
TYNDALL_INLINE Uints select(Mask m, Uints a, Uints b) {
  a.v = hn::IfThenElse(hn::RebindMask(TagU(), m.v), a.v, b.v);
  return a;
}

// Where one of the two is not a number, or both are zeros of either sign, ARM's own instructions choose otherwise than
// base/lanes.h promises and x86 does.
TYNDALL_INLINE Floats min(Floats a, Floats b) {
#if HWY_ARCH_ARM
  return select(a < b, a, b);
#else
  a.v = hn::Min(a.v, b.v);
  return a;
#endif
}
TYNDALL_INLINE Floats max(Floats a, Floats b) {
#if HWY_ARCH_ARM
  return select(b < a, a, b);
#else
  a.v = hn::Max(a.v, b.v);
  return a;
#endif
}
TYNDALL_INLINE Floats abs(Floats a) {
  a.v = hn::Abs(a.v);
  return a;
}
TYNDALL_INLINE Floats sqrt(Floats a) {
  a.v = hn::Sqrt(a.v);
  return a;
}
TYNDALL_INLINE Floats copy_sign(Floats magnitude, Floats sign) {
  magnitude.v = hn::CopySign(magnitude.v, sign.v);
  return magnitude;
}
TYNDALL_INLINE Floats mul_add(Floats a, Floats b, Floats c) {
  a.v = hn::MulAdd(a.v, b.v, c.v);
  return a;
}
TYNDALL_INLINE Floats neg_mul_add(Floats a, Floats b, Floats c) {
  a.v = hn::NegMulAdd(a.v, b.v, c.v);
  return a;
}
TYNDALL_INLINE Ints to_int(Floats a) {
  Ints r;
  r.v = hn::ConvertTo(TagI(), a.v);
  return r;
}
TYNDALL_INLINE Floats float_from_int(Ints a) {
  Floats r;
  r.v = hn::ConvertTo(TagF(), a.v);
  return r;
}
TYNDALL_INLINE Floats floor(Floats a) {
  a.v = hn::Floor(a.v);
  return a;
}
TYNDALL_INLINE Uints as_uint(Ints a) {
  Uints r;
  r.v = hn::BitCast(TagU(), a.v);
  return r;
}
TYNDALL_INLINE Ints as_int(Uints a) {
  Ints r;
  r.v = hn::BitCast(TagI(), a.v);
  return r;
}
TYNDALL_INLINE Uints float_bits(Floats a) {
  Uints r;
  r.v = hn::BitCast(TagU(), a.v);
  return r;
}
TYNDALL_INLINE Floats float_from_bits(Uints a) {
  Floats r;
  r.v = hn::BitCast(TagF(), a.v);
  return r;
}
template <int by>
TYNDALL_INLINE Uints shift_left(Uints a) {
  a.v = hn::ShiftLeft<by>(a.v);
  return a;
}
template <int by>
TYNDALL_INLINE Uints shift_right(Uints a) {
  a.v = hn::ShiftRight<by>(a.v);
  return a;
}

TYNDALL_INLINE float min_lane(Floats a) { return hn::GetLane(hn::MinOfLanes(TagF(), a.v)); }

}  // namespace HWY_NAMESPACE
}  // namespace tyndall
