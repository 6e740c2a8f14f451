#pragma once
#include "core/base/lanes.h"

#include <hwy/highway.h>

/// The one door to the SIMD library: a group of lanes that answers what base/lanes.h asks of a number type. It compiles
/// for the instruction set whose flags its file is given, in a namespace of that set's name, so that no two objects
/// share a symbol. A group is `vectors` native vectors: two hide the latency of one behind the other.
namespace tyndall {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using TagF = hn::ScalableTag<float>;
using TagI = hn::ScalableTag<std::int32_t>;
using TagU = hn::ScalableTag<std::uint32_t>;
inline constexpr int native_lanes = static_cast<int>(hn::MaxLanes(TagF()));

template <int vectors>
struct Mask {
  hn::Mask<TagF> v[vectors];
};

template <int vectors>
struct Floats {
  hn::Vec<TagF> v[vectors];
  Floats() = default;
  TYNDALL_INLINE Floats(float value) {
    for (auto& x : v) x = hn::Set(TagF(), value);
  }
};

template <int vectors>
struct Ints {
  hn::Vec<TagI> v[vectors];
  Ints() = default;
  TYNDALL_INLINE Ints(std::int32_t value) {
    for (auto& x : v) x = hn::Set(TagI(), value);
  }
};

template <int vectors>
struct Uints {
  hn::Vec<TagU> v[vectors];
  Uints() = default;
  TYNDALL_INLINE Uints(std::uint32_t value) {
    for (auto& x : v) x = hn::Set(TagU(), value);
  }
};

template <int n>
TYNDALL_INLINE Floats<n> operator+(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Add(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> operator-(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Sub(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> operator*(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Mul(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> operator/(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Div(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> operator-(Floats<n> a) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Neg(a.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> operator+(Ints<n> a, Ints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Add(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> operator-(Ints<n> a, Ints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Sub(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> operator*(Ints<n> a, Ints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Mul(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> operator&(Ints<n> a, Ints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::And(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> operator+(Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Add(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> operator*(Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Mul(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> operator^(Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Xor(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> operator&(Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::And(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> operator|(Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Or(a.v[i], b.v[i]);
  return a;
}

template <int n>
TYNDALL_INLINE Mask<n> operator<(Floats<n> a, Floats<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::Lt(a.v[i], b.v[i]);
  return m;
}
template <int n>
TYNDALL_INLINE Mask<n> operator<=(Floats<n> a, Floats<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::Le(a.v[i], b.v[i]);
  return m;
}
template <int n>
TYNDALL_INLINE Mask<n> operator==(Floats<n> a, Floats<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::Eq(a.v[i], b.v[i]);
  return m;
}
template <int n>
TYNDALL_INLINE Mask<n> operator==(Ints<n> a, Ints<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::RebindMask(TagF(), hn::Eq(a.v[i], b.v[i]));
  return m;
}
template <int n>
TYNDALL_INLINE Mask<n> operator<(Ints<n> a, Ints<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::RebindMask(TagF(), hn::Lt(a.v[i], b.v[i]));
  return m;
}
template <int n>
TYNDALL_INLINE Mask<n> operator<=(Ints<n> a, Ints<n> b) {
  Mask<n> m;
  for (int i = 0; i < n; ++i) m.v[i] = hn::RebindMask(TagF(), hn::Not(hn::Lt(b.v[i], a.v[i])));
  return m;
}

template <int n>
TYNDALL_INLINE Mask<n> mask_and(Mask<n> a, Mask<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::And(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Mask<n> mask_or(Mask<n> a, Mask<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Or(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Mask<n> mask_not(Mask<n> a) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Not(a.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Mask<n> mask_and_not(Mask<n> a, Mask<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::AndNot(b.v[i], a.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE bool any(Mask<n> a) {
  auto m = a.v[0];
  for (int i = 1; i < n; ++i) m = hn::Or(m, a.v[i]);
  return !hn::AllFalse(TagF(), m);
}
template <int n>
TYNDALL_INLINE bool all(Mask<n> a) {
  auto m = a.v[0];
  for (int i = 1; i < n; ++i) m = hn::And(m, a.v[i]);
  return hn::AllTrue(TagF(), m);
}
template <int n>
TYNDALL_INLINE std::uint32_t bits(Mask<n> a) {
  std::uint32_t all_bits = 0;
  for (int i = 0; i < n; ++i) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(TagF(), a.v[i], bytes);
    all_bits |= (static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8)
                << (i * native_lanes);
  }
  return all_bits;
}

template <int n>
TYNDALL_INLINE Floats<n> select(Mask<n> m, Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::IfThenElse(m.v[i], a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> select(Mask<n> m, Ints<n> a, Ints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::IfThenElse(hn::RebindMask(TagI(), m.v[i]), a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> select(Mask<n> m, Uints<n> a, Uints<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::IfThenElse(hn::RebindMask(TagU(), m.v[i]), a.v[i], b.v[i]);
  return a;
}

template <int n>
TYNDALL_INLINE Floats<n> min(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Min(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> max(Floats<n> a, Floats<n> b) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::Max(a.v[i], b.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> abs(Floats<n> a) {
  for (auto& x : a.v) x = hn::Abs(x);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> sqrt(Floats<n> a) {
  for (auto& x : a.v) x = hn::Sqrt(x);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> copy_sign(Floats<n> magnitude, Floats<n> sign) {
  for (int i = 0; i < n; ++i) magnitude.v[i] = hn::CopySign(magnitude.v[i], sign.v[i]);
  return magnitude;
}
template <int n>
TYNDALL_INLINE Floats<n> mul_add(Floats<n> a, Floats<n> b, Floats<n> c) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::MulAdd(a.v[i], b.v[i], c.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Floats<n> neg_mul_add(Floats<n> a, Floats<n> b, Floats<n> c) {
  for (int i = 0; i < n; ++i) a.v[i] = hn::NegMulAdd(a.v[i], b.v[i], c.v[i]);
  return a;
}
template <int n>
TYNDALL_INLINE Ints<n> to_int(Floats<n> a) {
  Ints<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::ConvertTo(TagI(), a.v[i]);
  return r;
}
template <int n>
TYNDALL_INLINE Floats<n> float_from_int(Ints<n> a) {
  Floats<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::ConvertTo(TagF(), a.v[i]);
  return r;
}
template <int n>
TYNDALL_INLINE Floats<n> floor(Floats<n> a) {
  for (auto& x : a.v) x = hn::Floor(x);
  return a;
}
template <int n>
TYNDALL_INLINE Uints<n> as_uint(Ints<n> a) {
  Uints<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::BitCast(TagU(), a.v[i]);
  return r;
}
template <int n>
TYNDALL_INLINE Ints<n> as_int(Uints<n> a) {
  Ints<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::BitCast(TagI(), a.v[i]);
  return r;
}
template <int n>
TYNDALL_INLINE Uints<n> float_bits(Floats<n> a) {
  Uints<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::BitCast(TagU(), a.v[i]);
  return r;
}
template <int n>
TYNDALL_INLINE Floats<n> float_from_bits(Uints<n> a) {
  Floats<n> r;
  for (int i = 0; i < n; ++i) r.v[i] = hn::BitCast(TagF(), a.v[i]);
  return r;
}
template <int by, int n>
TYNDALL_INLINE Uints<n> shift_left(Uints<n> a) {
  for (auto& x : a.v) x = hn::ShiftLeft<by>(x);
  return a;
}
template <int by, int n>
TYNDALL_INLINE Uints<n> shift_right(Uints<n> a) {
  for (auto& x : a.v) x = hn::ShiftRight<by>(x);
  return a;
}

template <int n>
TYNDALL_INLINE float least_lane(Floats<n> a) {
  auto m = a.v[0];
  for (int i = 1; i < n; ++i) m = hn::Min(m, a.v[i]);
  return hn::GetLane(hn::MinOfLanes(TagF(), m));
}

template <int n>
TYNDALL_INLINE void store(float* to, Floats<n> a) {
  for (int i = 0; i < n; ++i) hn::StoreU(a.v[i], TagF(), to + i * native_lanes);
}
template <int n>
TYNDALL_INLINE void store(std::int32_t* to, Ints<n> a) {
  for (int i = 0; i < n; ++i) hn::StoreU(a.v[i], TagI(), to + i * native_lanes);
}
template <int n>
TYNDALL_INLINE void store(std::uint32_t* to, Uints<n> a) {
  for (int i = 0; i < n; ++i) hn::StoreU(a.v[i], TagU(), to + i * native_lanes);
}

}  // namespace HWY_NAMESPACE

template <int n>
struct LaneTypes<HWY_NAMESPACE::Floats<n>> {
  using Int = HWY_NAMESPACE::Ints<n>;
  using Uint = HWY_NAMESPACE::Uints<n>;
  using Mask = HWY_NAMESPACE::Mask<n>;
  static constexpr int lanes = n * HWY_NAMESPACE::native_lanes;
  static constexpr int vectors = n;
};

namespace detail {
template <class F>
inline constexpr int vectors_of = LaneTypes<F>::vectors;
}

// What is asked with F given by name: from_int<F>, gather<F>, load<F>, mask_from_bits<F>.
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE F from_int(IntOf<F> v) { return float_from_int(v); }
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE F gather(const float* table, IntOf<F> index) {
  F r;
  for (int i = 0; i < detail::vectors_of<F>; ++i)
    r.v[i] = HWY_NAMESPACE::hn::GatherIndex(HWY_NAMESPACE::TagF(), table, index.v[i]);
  return r;
}
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE IntOf<F> gather_int(const std::int32_t* table, IntOf<F> index) {
  IntOf<F> r;
  for (int i = 0; i < detail::vectors_of<F>; ++i)
    r.v[i] = HWY_NAMESPACE::hn::GatherIndex(HWY_NAMESPACE::TagI(), table, index.v[i]);
  return r;
}
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE F load(const float* from) {
  F r;
  for (int i = 0; i < detail::vectors_of<F>; ++i)
    r.v[i] = HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagF(), from + i * HWY_NAMESPACE::native_lanes);
  return r;
}
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE IntOf<F> load_int(const std::int32_t* from) {
  IntOf<F> r;
  for (int i = 0; i < detail::vectors_of<F>; ++i)
    r.v[i] = HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagI(), from + i * HWY_NAMESPACE::native_lanes);
  return r;
}
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE UintOf<F> load_uint(const std::uint32_t* from) {
  UintOf<F> r;
  for (int i = 0; i < detail::vectors_of<F>; ++i)
    r.v[i] = HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagU(), from + i * HWY_NAMESPACE::native_lanes);
  return r;
}
template <class F>
requires(LaneTypes<F>::vectors > 0) TYNDALL_INLINE MaskOf<F> mask_from_bits(std::uint32_t b) {
  MaskOf<F> m;
  for (int i = 0; i < detail::vectors_of<F>; ++i) {
    const std::uint32_t part = b >> (i * HWY_NAMESPACE::native_lanes);
    alignas(8) std::uint8_t bytes[8] = {static_cast<std::uint8_t>(part), static_cast<std::uint8_t>(part >> 8)};
    m.v[i] = HWY_NAMESPACE::hn::LoadMaskBits(HWY_NAMESPACE::TagF(), bytes);
  }
  return m;
}

}  // namespace tyndall
