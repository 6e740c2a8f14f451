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
  Mask() = default;
  TYNDALL_INLINE Mask(hn::Mask<TagF> mask) : v(mask) {}
};

struct Floats {
  using Scalar = float;
  hn::Vec<TagF> v;
  Floats() = default;
  TYNDALL_INLINE Floats(hn::Vec<TagF> lanes) : v(lanes) {}
  TYNDALL_INLINE Floats(float value) : v(hn::Set(TagF(), value)) {}
};

struct Ints {
  using Scalar = std::int32_t;
  hn::Vec<TagI> v;
  Ints() = default;
  TYNDALL_INLINE Ints(hn::Vec<TagI> lanes) : v(lanes) {}
  TYNDALL_INLINE Ints(std::int32_t value) : v(hn::Set(TagI(), value)) {}
};

struct Uints {
  using Scalar = std::uint32_t;
  hn::Vec<TagU> v;
  Uints() = default;
  TYNDALL_INLINE Uints(hn::Vec<TagU> lanes) : v(lanes) {}
  TYNDALL_INLINE Uints(std::uint32_t value) : v(hn::Set(TagU(), value)) {}
};

TYNDALL_INLINE Floats operator+(Floats a, Floats b) { return hn::Add(a.v, b.v); }
TYNDALL_INLINE Floats operator-(Floats a, Floats b) { return hn::Sub(a.v, b.v); }
TYNDALL_INLINE Floats operator*(Floats a, Floats b) { return hn::Mul(a.v, b.v); }
TYNDALL_INLINE Floats operator/(Floats a, Floats b) { return hn::Div(a.v, b.v); }
TYNDALL_INLINE Floats operator-(Floats a) { return hn::Neg(a.v); }
TYNDALL_INLINE Ints operator+(Ints a, Ints b) { return hn::Add(a.v, b.v); }
TYNDALL_INLINE Ints operator-(Ints a, Ints b) { return hn::Sub(a.v, b.v); }
TYNDALL_INLINE Ints operator*(Ints a, Ints b) { return hn::Mul(a.v, b.v); }
TYNDALL_INLINE Ints operator&(Ints a, Ints b) { return hn::And(a.v, b.v); }
TYNDALL_INLINE Uints operator+(Uints a, Uints b) { return hn::Add(a.v, b.v); }
TYNDALL_INLINE Uints operator*(Uints a, Uints b) { return hn::Mul(a.v, b.v); }
TYNDALL_INLINE Uints operator^(Uints a, Uints b) { return hn::Xor(a.v, b.v); }
TYNDALL_INLINE Uints operator&(Uints a, Uints b) { return hn::And(a.v, b.v); }
TYNDALL_INLINE Uints operator|(Uints a, Uints b) { return hn::Or(a.v, b.v); }

TYNDALL_INLINE Mask operator<(Floats a, Floats b) { return hn::Lt(a.v, b.v); }
TYNDALL_INLINE Mask operator<=(Floats a, Floats b) { return hn::Le(a.v, b.v); }
TYNDALL_INLINE Mask operator==(Floats a, Floats b) { return hn::Eq(a.v, b.v); }
TYNDALL_INLINE Mask operator==(Ints a, Ints b) { return hn::RebindMask(TagF(), hn::Eq(a.v, b.v)); }
TYNDALL_INLINE Mask operator<(Ints a, Ints b) { return hn::RebindMask(TagF(), hn::Lt(a.v, b.v)); }
TYNDALL_INLINE Mask operator<=(Ints a, Ints b) { return hn::RebindMask(TagF(), hn::Not(hn::Lt(b.v, a.v))); }

TYNDALL_INLINE Mask mask_and(Mask a, Mask b) { return hn::And(a.v, b.v); }
TYNDALL_INLINE Mask mask_or(Mask a, Mask b) { return hn::Or(a.v, b.v); }
TYNDALL_INLINE Mask mask_not(Mask a) { return hn::Not(a.v); }
TYNDALL_INLINE Mask mask_and_not(Mask a, Mask b) { return hn::AndNot(b.v, a.v); }
TYNDALL_INLINE bool any(Mask a) {
#if HWY_TARGET == HWY_WASM  // here and in bits() the library goes by way of memory, as its compilers lacked these
  return wasm_v128_any_true(a.v.raw);
#else
  return !hn::AllFalse(TagF(), a.v);
#endif
}
TYNDALL_INLINE bool all(Mask a) { return hn::AllTrue(TagF(), a.v); }
TYNDALL_INLINE std::uint32_t bits(Mask a) {
#if HWY_TARGET == HWY_AVX3
  return a.v.raw;
#elif HWY_TARGET == HWY_WASM
  return static_cast<std::uint32_t>(wasm_i32x4_bitmask(a.v.raw));
#else
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(TagF(), a.v, bytes);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
#endif
}

TYNDALL_INLINE Floats select(Mask m, Floats a, Floats b) { return hn::IfThenElse(m.v, a.v, b.v); }
TYNDALL_INLINE Ints select(Mask m, Ints a, Ints b) { return hn::IfThenElse(hn::RebindMask(TagI(), m.v), a.v, b.v); }
TYNDALL_INLINE Uints select(Mask m, Uints a, Uints b) { return hn::IfThenElse(hn::RebindMask(TagU(), m.v), a.v, b.v); }

// Where one of the two is not a number, or both are zeros of either sign, ARM's own instructions choose otherwise than
// base/lanes.h promises and x86 does.
TYNDALL_INLINE Floats min(Floats a, Floats b) {
#if HWY_ARCH_ARM
  return select(a < b, a, b);
#else
  return hn::Min(a.v, b.v);
#endif
}
TYNDALL_INLINE Floats max(Floats a, Floats b) {
#if HWY_ARCH_ARM
  return select(b < a, a, b);
#else
  return hn::Max(a.v, b.v);
#endif
}
TYNDALL_INLINE Floats abs(Floats a) { return hn::Abs(a.v); }
TYNDALL_INLINE Floats sqrt(Floats a) { return hn::Sqrt(a.v); }
TYNDALL_INLINE Floats copy_sign(Floats magnitude, Floats sign) { return hn::CopySign(magnitude.v, sign.v); }
TYNDALL_INLINE Floats mul_add(Floats a, Floats b, Floats c) { return hn::MulAdd(a.v, b.v, c.v); }
TYNDALL_INLINE Floats neg_mul_add(Floats a, Floats b, Floats c) { return hn::NegMulAdd(a.v, b.v, c.v); }
TYNDALL_INLINE Ints to_int(Floats a) { return hn::ConvertTo(TagI(), a.v); }
TYNDALL_INLINE Floats float_from_int(Ints a) { return hn::ConvertTo(TagF(), a.v); }
TYNDALL_INLINE Floats floor(Floats a) { return hn::Floor(a.v); }
TYNDALL_INLINE Uints as_uint(Ints a) { return hn::BitCast(TagU(), a.v); }
TYNDALL_INLINE Ints as_int(Uints a) { return hn::BitCast(TagI(), a.v); }
TYNDALL_INLINE Uints float_bits(Floats a) { return hn::BitCast(TagU(), a.v); }
TYNDALL_INLINE Floats float_from_bits(Uints a) { return hn::BitCast(TagF(), a.v); }
template <int by>
TYNDALL_INLINE Uints shift_left(Uints a) {
  return hn::ShiftLeft<by>(a.v);
}
template <int by>
TYNDALL_INLINE Uints shift_right(Uints a) {
  return hn::ShiftRight<by>(a.v);
}

TYNDALL_INLINE float min_lane(Floats a) { return hn::GetLane(hn::MinOfLanes(TagF(), a.v)); }

}  // namespace HWY_NAMESPACE
}  // namespace tyndall
