#pragma once
#include "core/base/lanes.h"

#include <hwy/highway.h>

/// The only door to the SIMD library: a group of lanes with all the operations of base/lanes.h. The code is compiled
/// for the instruction set whose flags the including file has, in a namespace named after the set, so that no two
/// objects share a symbol.
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

/// A group of lanes: as many numbers T as a register holds.
template <class T>
struct Lanes {
  using Scalar = T;
  using Tag = hn::ScalableTag<T>;
  hn::Vec<Tag> v;
  Lanes() = default;
  TYNDALL_INLINE Lanes(hn::Vec<Tag> lanes) : v(lanes) {}
  TYNDALL_INLINE Lanes(T value) : v(hn::Set(Tag(), value)) {}

  TYNDALL_INLINE friend Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator-(Lanes a) { return hn::Neg(a.v); }
  TYNDALL_INLINE friend Lanes operator^(Lanes a, Lanes b) { return hn::Xor(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator&(Lanes a, Lanes b) { return hn::And(a.v, b.v); }
  TYNDALL_INLINE friend Lanes operator|(Lanes a, Lanes b) { return hn::Or(a.v, b.v); }
  TYNDALL_INLINE friend Mask operator<(Lanes a, Lanes b) { return hn::RebindMask(TagF(), hn::Lt(a.v, b.v)); }
  TYNDALL_INLINE friend Mask operator<=(Lanes a, Lanes b) {
    if constexpr (std::is_same_v<T, float>)
      return hn::Le(a.v, b.v);
    else
      return hn::RebindMask(TagF(), hn::Not(hn::Lt(b.v, a.v)));
  }
  TYNDALL_INLINE friend Mask operator==(Lanes a, Lanes b) { return hn::RebindMask(TagF(), hn::Eq(a.v, b.v)); }
  TYNDALL_INLINE friend Lanes select(Mask m, Lanes a, Lanes b) {
    return hn::IfThenElse(hn::RebindMask(Tag(), m.v), a.v, b.v);
  }
  TYNDALL_INLINE friend void store(T* to, Lanes a) { hn::StoreU(a.v, Tag(), to); }
};
using Floats = Lanes<float>;
using Ints = Lanes<std::int32_t>;
using Uints = Lanes<std::uint32_t>;

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

#if HWY_TARGET == HWY_AVX2
/// For each set of lanes (as bits): the indices of its lanes in order, four bits each, the first in the lowest bits.
/// The SIMD library has such a table as a local variable, which GCC copies at each call.
struct LaneLists {
  std::uint32_t of[256];
};
constexpr LaneLists list_lanes() {
  LaneLists lists{};
  for (std::uint32_t lanes = 0; lanes < 256; ++lanes)
    for (std::uint32_t lane = 0, place = 0; lane < 8; ++lane)
      if (lanes >> lane & 1u) lists.of[lanes] |= lane << 4 * place++;
  return lists;
}
inline constexpr LaneLists lane_lists = list_lanes();

template <class T>
TYNDALL_INLINE hn::Vec<hn::ScalableTag<T>> compress(Lanes<T> a, Mask lanes) {
  const __m256i packed = _mm256_set1_epi32(static_cast<std::int32_t>(lane_lists.of[bits(lanes)]));
  const __m256i list = _mm256_srlv_epi32(packed, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
  const __m256i values = hn::BitCast(TagI(), a.v).raw;  // of each number in the list, three bits are read
  return hn::BitCast(hn::ScalableTag<T>(), hn::Vec<TagI>{_mm256_permutevar8x32_epi32(values, list)});
}
#elif HWY_TARGET == HWY_WASM
/// For each set of lanes (as bits): the bytes of its lanes in order.
struct ByteLists {
  alignas(16) std::uint8_t of[16][16];
};
constexpr ByteLists list_bytes() {
  ByteLists lists{};
  for (int lanes = 0; lanes < 16; ++lanes)
    for (int lane = 0, place = 0; lane < 4; ++lane)
      for (int byte = 0; (lanes >> lane & 1) != 0 && byte < 4; ++byte, ++place)
        lists.of[lanes][place] = static_cast<std::uint8_t>(4 * lane + byte);
  return lists;
}
inline constexpr ByteLists byte_lists = list_bytes();

template <class T>
TYNDALL_INLINE hn::Vec<hn::ScalableTag<T>> compress(Lanes<T> a, Mask lanes) {
  return hn::Vec<hn::ScalableTag<T>>{wasm_i8x16_swizzle(a.v.raw, wasm_v128_load(byte_lists.of[bits(lanes)]))};
}
#else
template <class T>
TYNDALL_INLINE hn::Vec<hn::ScalableTag<T>> compress(Lanes<T> a, Mask lanes) {
  return hn::Compress(a.v, hn::RebindMask(hn::ScalableTag<T>(), lanes.v));
}
#endif

TYNDALL_INLINE int count_of(Mask lanes) {
#if HWY_TARGET == HWY_WASM
  return __builtin_popcount(bits(lanes));
#else
  return static_cast<int>(hn::CountTrue(TagF(), lanes.v));
#endif
}

/// Stores the values of `lanes` next to each other and returns their number. May overwrite the memory of a whole group:
/// storing compressed lanes alone is slow on AMD's Zen 4, where the instruction is microcode.
template <class T>
TYNDALL_INLINE int append(T* to, Lanes<T> a, Mask lanes) {
  hn::StoreU(compress(a, lanes), hn::ScalableTag<T>(), to);
  return count_of(lanes);
}

/// The sums of lanes 0 and 1, 2 and 3, … of `a`, then those of `b`. (core/clean/cells.h has it for plain numbers.)
TYNDALL_INLINE Floats pair_sums(Floats a, Floats b) {
  const TagF tag;
  return hn::Add(hn::ConcatEven(tag, b.v, a.v), hn::ConcatOdd(tag, b.v, a.v));
}

}  // namespace HWY_NAMESPACE

template <>
struct LaneTypes<HWY_NAMESPACE::Floats> {
  using Int = HWY_NAMESPACE::Ints;
  using Uint = HWY_NAMESPACE::Uints;
  using Mask = HWY_NAMESPACE::Mask;
  static constexpr int lanes = HWY_NAMESPACE::native_lanes;
};

// Functions that are called with F written out: from_int<F>, gather<F>, load<F>, mask_from_bits<F>.
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE F from_int(IntOf<F> v) {
  return HWY_NAMESPACE::hn::ConvertTo(HWY_NAMESPACE::TagF(), v.v);
}
template <std::same_as<HWY_NAMESPACE::Floats> F, class S>
TYNDALL_INLINE LanesFrom<F, S> gather(const S* table, IntOf<F> index) {
  return HWY_NAMESPACE::hn::GatherIndex(typename LanesFrom<F, S>::Tag(), table, index.v);
}
#if HWY_TARGET == HWY_AVX3
namespace HWY_NAMESPACE {
/// Entries of a table that vectors hold. The SIMD library has no such lookup yet.
inline constexpr int max_in_vectors = 64;

/// table[index] for a table of `count` entries, at most 32, which two vectors hold. Of index only the low 5 bits count.
TYNDALL_INLINE __m512i lookup_in_two(const std::int32_t* table, int count, __m512i index) {
  const __mmask32 readable = _bzhi_u32(0xffffffffu, static_cast<std::uint32_t>(count));
  const __m512i low = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(readable), table);
  const __m512i high = _mm512_maskz_loadu_epi32(static_cast<__mmask16>(readable >> 16), table + 16);
  return _mm512_permutex2var_epi32(low, index, high);
}
/// The same for at most max_in_vectors entries.
TYNDALL_INLINE __m512i lookup_in_vectors(const void* entries, int count, __m512i index) {
  const auto* table = static_cast<const std::int32_t*>(entries);
  if (count <= 32) return lookup_in_two(table, count, index);
  const __mmask16 upper = _mm512_test_epi32_mask(index, _mm512_set1_epi32(32));
  return _mm512_mask_blend_epi32(upper, lookup_in_two(table, 32, index), lookup_in_two(table + 32, count - 32, index));
}
}  // namespace HWY_NAMESPACE
#endif
template <std::same_as<HWY_NAMESPACE::Floats> F, class S>
TYNDALL_INLINE LanesFrom<F, S> lookup(const S* table, [[maybe_unused]] int count, IntOf<F> index) {
#if HWY_TARGET == HWY_AVX3
  if (count <= HWY_NAMESPACE::max_in_vectors) {
    const IntOf<F> found(
        HWY_NAMESPACE::hn::Vec<HWY_NAMESPACE::TagI>{HWY_NAMESPACE::lookup_in_vectors(table, count, index.v.raw)});
    return HWY_NAMESPACE::hn::BitCast(typename LanesFrom<F, S>::Tag(), found.v);
  }
#endif
  return gather<F>(table, index);
}
template <std::same_as<HWY_NAMESPACE::Floats> F, class S>
TYNDALL_INLINE LanesFrom<F, S> load(const S* from) {
  return HWY_NAMESPACE::hn::LoadU(typename LanesFrom<F, S>::Tag(), from);
}
// From AVX2 on: these sets can load a part of the lanes.
template <std::same_as<HWY_NAMESPACE::Floats> F, class S>
requires(lanes_of<F> >= 8) TYNDALL_INLINE LanesFrom<F, S> load_some(const S* from, int count) {
  const typename LanesFrom<F, S>::Tag tag;
  return HWY_NAMESPACE::hn::MaskedLoad(HWY_NAMESPACE::hn::FirstN(tag, static_cast<std::size_t>(count)), tag, from);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE MaskOf<F> mask_from_bits(std::uint32_t b) {
#if HWY_TARGET == HWY_AVX3
  return HWY_NAMESPACE::hn::Mask<HWY_NAMESPACE::TagF>{static_cast<__mmask16>(b)};
#elif HWY_TARGET == HWY_WASM
  const auto each = wasm_i32x4_make(1, 2, 4, 8);
  const auto wanted = wasm_v128_and(wasm_i32x4_splat(static_cast<std::int32_t>(b)), each);
  return HWY_NAMESPACE::hn::Mask<HWY_NAMESPACE::TagF>{wasm_i32x4_eq(wanted, each)};
#else
  alignas(8) std::uint8_t bytes[8] = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(b >> 8)};
  return HWY_NAMESPACE::hn::LoadMaskBits(HWY_NAMESPACE::TagF(), bytes);
#endif
}

}  // namespace tyndall
