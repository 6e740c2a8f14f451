#pragma once
#include "core/base/lanes_simd_arithmetic.h"

/// The only door to the SIMD library: a group of lanes with all the operations of base/lanes.h. The code is compiled
/// for the instruction set whose flags the including file has, in a namespace named after the set, so that no two
/// objects share a symbol. Loads and stores are here; the arithmetic is in base/lanes_simd_arithmetic.h.
namespace tyndall {
namespace HWY_NAMESPACE {

TYNDALL_INLINE void store(float* to, Floats a) { hn::StoreU(a.v, TagF(), to); }
TYNDALL_INLINE void store(std::int32_t* to, Ints a) { hn::StoreU(a.v, TagI(), to); }
TYNDALL_INLINE void store(std::uint32_t* to, Uints a) { hn::StoreU(a.v, TagU(), to); }

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

TYNDALL_INLINE __m256i compress(__m256i values, Mask lanes) {
  const __m256i packed = _mm256_set1_epi32(static_cast<std::int32_t>(lane_lists.of[bits(lanes)]));
  const __m256i list = _mm256_srlv_epi32(packed, _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28));
  return _mm256_permutevar8x32_epi32(values, list);  // which reads three bits of each number
}
TYNDALL_INLINE hn::Vec<TagF> compress(Floats a, Mask lanes) {
  return {_mm256_castsi256_ps(compress(_mm256_castps_si256(a.v.raw), lanes))};
}
TYNDALL_INLINE hn::Vec<TagI> compress(Ints a, Mask lanes) { return {compress(a.v.raw, lanes)}; }
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

template <class Vector>
TYNDALL_INLINE hn::Vec<Vector> compress(v128_t values, Mask lanes) {
  return hn::Vec<Vector>{wasm_i8x16_swizzle(values, wasm_v128_load(byte_lists.of[bits(lanes)]))};
}
TYNDALL_INLINE hn::Vec<TagF> compress(Floats a, Mask lanes) { return compress<TagF>(a.v.raw, lanes); }
TYNDALL_INLINE hn::Vec<TagI> compress(Ints a, Mask lanes) { return compress<TagI>(a.v.raw, lanes); }
#else
TYNDALL_INLINE hn::Vec<TagF> compress(Floats a, Mask lanes) { return hn::Compress(a.v, lanes.v); }
TYNDALL_INLINE hn::Vec<TagI> compress(Ints a, Mask lanes) { return hn::Compress(a.v, hn::RebindMask(TagI(), lanes.v)); }
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
TYNDALL_INLINE int append(float* to, Floats a, Mask lanes) {
  hn::StoreU(compress(a, lanes), TagF(), to);
  return count_of(lanes);
}
TYNDALL_INLINE int append(std::int32_t* to, Ints a, Mask lanes) {
  hn::StoreU(compress(a, lanes), TagI(), to);
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
  return float_from_int(v);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE F gather(const float* table, IntOf<F> index) {
  return HWY_NAMESPACE::hn::GatherIndex(HWY_NAMESPACE::TagF(), table, index.v);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE IntOf<F> gather_int(const std::int32_t* table, IntOf<F> index) {
  return HWY_NAMESPACE::hn::GatherIndex(HWY_NAMESPACE::TagI(), table, index.v);
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
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE F lookup(const float* table, [[maybe_unused]] int count, IntOf<F> index) {
#if HWY_TARGET == HWY_AVX3
  if (count <= HWY_NAMESPACE::max_in_vectors)
    return HWY_NAMESPACE::hn::Vec<HWY_NAMESPACE::TagF>{
        _mm512_castsi512_ps(HWY_NAMESPACE::lookup_in_vectors(table, count, index.v.raw))};
#endif
  return gather<F>(table, index);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE IntOf<F> lookup_int(const std::int32_t* table, [[maybe_unused]] int count, IntOf<F> index) {
#if HWY_TARGET == HWY_AVX3
  if (count <= HWY_NAMESPACE::max_in_vectors)
    return HWY_NAMESPACE::hn::Vec<HWY_NAMESPACE::TagI>{HWY_NAMESPACE::lookup_in_vectors(table, count, index.v.raw)};
#endif
  return gather_int<F>(table, index);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE F load(const float* from) {
  return HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagF(), from);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE IntOf<F> load_int(const std::int32_t* from) {
  return HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagI(), from);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
TYNDALL_INLINE UintOf<F> load_uint(const std::uint32_t* from) {
  return HWY_NAMESPACE::hn::LoadU(HWY_NAMESPACE::TagU(), from);
}
// From AVX2 on: these sets can load a part of the lanes.
template <std::same_as<HWY_NAMESPACE::Floats> F>
requires(lanes_of<F> >= 8) TYNDALL_INLINE F load_some(const float* from, int count) {
  const HWY_NAMESPACE::TagF tag;
  return HWY_NAMESPACE::hn::MaskedLoad(HWY_NAMESPACE::hn::FirstN(tag, static_cast<std::size_t>(count)), tag, from);
}
template <std::same_as<HWY_NAMESPACE::Floats> F>
requires(lanes_of<F> >= 8) TYNDALL_INLINE IntOf<F> load_some_int(const std::int32_t* from, int count) {
  const HWY_NAMESPACE::TagI tag;
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
