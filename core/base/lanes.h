#pragma once
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

/// Marks a function that kernels call: it is always inlined, for two reasons. A call would cost more than the
/// function's work. And of an ordinary inline function the linker keeps one copy for all callers: a copy with wide
/// instructions would crash older CPUs. Sanitized builds do not inline, because each file would take minutes to
/// compile; they run on the machine that built them.
#if defined(TYNDALL_KEEP_CALLS)
#define TYNDALL_INLINE inline
#else
#define TYNDALL_INLINE [[gnu::always_inline]] inline
#endif

/// The operations on the kernels' number type F, here for plain numbers: float (one path at a time, the readable
/// reference) and double (the accurate reference). base/lanes_simd.h has the same operations for groups of lanes
/// (SIMD).
namespace tyndall {

template <class F>
struct LaneTypes;

template <>
struct LaneTypes<float> {
  using Int = std::int32_t;    ///< indices, counts, states
  using Uint = std::uint32_t;  ///< hashes: wraps at 2^32
  using Mask = bool;           ///< one truth value for each lane
  static constexpr int lanes = 1;
};

template <>
struct LaneTypes<double> : LaneTypes<float> {};

/// A plain number: one lane.
template <class F>
concept Plain = std::floating_point<F>;

template <class F>
using IntOf = typename LaneTypes<F>::Int;
template <class F>
using UintOf = typename LaneTypes<F>::Uint;
template <class F>
using MaskOf = typename LaneTypes<F>::Mask;
template <class F>
inline constexpr int lanes_of = LaneTypes<F>::lanes;

/// A number type made of two groups of lanes (see lanes_target.h), and the type of one group.
template <class F>
concept Doubled = requires {
  typename LaneTypes<F>::Half;
};
template <Doubled F>
using HalfOf = typename LaneTypes<F>::Half;

// The same value in every lane of F.
template <class F>
TYNDALL_INLINE F splat(float value) {
  return F(value);
}
template <class F>
TYNDALL_INLINE IntOf<F> splat(std::int32_t value) {
  return IntOf<F>(value);
}

TYNDALL_INLINE bool any(bool m) { return m; }
TYNDALL_INLINE bool all(bool m) { return m; }
/// The truth values as bits: bit i is that of lane i.
TYNDALL_INLINE std::uint32_t bits(bool m) { return m ? 1u : 0u; }
template <Plain F>
TYNDALL_INLINE bool mask_from_bits(std::uint32_t b) {
  return (b & 1u) != 0;
}

TYNDALL_INLINE bool mask_and(bool a, bool b) { return a && b; }
TYNDALL_INLINE bool mask_or(bool a, bool b) { return a || b; }
TYNDALL_INLINE bool mask_not(bool a) { return !a; }
/// a and not b.
TYNDALL_INLINE bool mask_and_not(bool a, bool b) { return a && !b; }

TYNDALL_INLINE float select(bool m, float a, float b) { return m ? a : b; }
TYNDALL_INLINE double select(bool m, double a, double b) { return m ? a : b; }
TYNDALL_INLINE std::int32_t select(bool m, std::int32_t a, std::int32_t b) { return m ? a : b; }
TYNDALL_INLINE std::uint32_t select(bool m, std::uint32_t a, std::uint32_t b) { return m ? a : b; }

// Comparisons are named functions, because on groups of lanes they return a mask.
template <class T>
TYNDALL_INLINE auto less(T a, T b) {
  return a < b;
}
template <class T>
TYNDALL_INLINE auto less_equal(T a, T b) {
  return a <= b;
}
template <class T>
TYNDALL_INLINE auto equal(T a, T b) {
  return a == b;
}

/// The smaller number; b where one of them is not a number, like the CPU's own instruction.
template <class F>
TYNDALL_INLINE F min(F a, F b) {
  return select(less(a, b), a, b);
}
/// The larger number; b where one of them is not a number.
template <class F>
TYNDALL_INLINE F max(F a, F b) {
  return select(less(b, a), a, b);
}

TYNDALL_INLINE float abs(float v) { return __builtin_fabsf(v); }
TYNDALL_INLINE double abs(double v) { return __builtin_fabs(v); }
TYNDALL_INLINE float sqrt(float v) { return __builtin_sqrtf(v); }
TYNDALL_INLINE double sqrt(double v) { return __builtin_sqrt(v); }
TYNDALL_INLINE float copy_sign(float magnitude, float sign) { return __builtin_copysignf(magnitude, sign); }
TYNDALL_INLINE double copy_sign(double magnitude, double sign) { return __builtin_copysign(magnitude, sign); }

/// Returns a·b + c: fused if the target has the instruction, else a product and a sum; never a library call.
TYNDALL_INLINE float mul_add(float a, float b, float c) { return a * b + c; }
TYNDALL_INLINE double mul_add(double a, double b, double c) { return a * b + c; }
/// c - a·b, likewise.
TYNDALL_INLINE float neg_mul_add(float a, float b, float c) { return c - a * b; }
TYNDALL_INLINE double neg_mul_add(double a, double b, double c) { return c - a * b; }

/// The largest whole number not above v.
TYNDALL_INLINE float floor(float v) {
  if (!(abs(v) < 0x1p23f)) return v;  // whole already, or not a number
  const float t = static_cast<float>(static_cast<std::int32_t>(v));
  return t > v ? t - 1.0f : t;
}
TYNDALL_INLINE double floor(double v) { return std::floor(v); }

/// Truncation towards zero; |v| below 2^31.
TYNDALL_INLINE std::int32_t to_int(float v) { return static_cast<std::int32_t>(v); }
TYNDALL_INLINE std::int32_t to_int(double v) { return static_cast<std::int32_t>(v); }
template <Plain F>
TYNDALL_INLINE F from_int(IntOf<F> v) {
  return static_cast<F>(v);
}
TYNDALL_INLINE std::uint32_t as_uint(std::int32_t v) { return static_cast<std::uint32_t>(v); }
TYNDALL_INLINE std::int32_t as_int(std::uint32_t v) { return static_cast<std::int32_t>(v); }
/// The bits of a float and back.
TYNDALL_INLINE std::uint32_t float_bits(float v) { return __builtin_bit_cast(std::uint32_t, v); }
TYNDALL_INLINE float float_from_bits(std::uint32_t v) { return __builtin_bit_cast(float, v); }

template <int n>
TYNDALL_INLINE std::uint32_t shift_left(std::uint32_t v) {
  return v << n;
}
template <int n>
TYNDALL_INLINE std::uint32_t shift_right(std::uint32_t v) {
  return v >> n;
}

/// The smallest of the lanes.
TYNDALL_INLINE float min_lane(float v) { return v; }
TYNDALL_INLINE float min_lane(double v) { return static_cast<float>(v); }

/// The lanes that numbers S in memory become: F for float, and the whole numbers beside F for the others.
template <class F, class S>
using LanesFrom = std::conditional_t<std::is_same_v<S, float>, F,
                                     std::conditional_t<std::is_same_v<S, std::int32_t>, IntOf<F>, UintOf<F>>>;

/// Returns table[index] for each lane. The indices of unused lanes must be valid, too.
template <Plain F, class S>
TYNDALL_INLINE LanesFrom<F, S> gather(const S* table, IntOf<F> index) {
  return static_cast<LanesFrom<F, S>>(table[index]);
}

/// Like gather(), for a table of `count` entries: faster if the whole table fits into registers.
template <Plain F, class S>
TYNDALL_INLINE LanesFrom<F, S> lookup(const S* table, [[maybe_unused]] int count, IntOf<F> index) {
  return gather<F>(table, index);
}

/// lanes_of<F> consecutive values.
template <Plain F, class S>
TYNDALL_INLINE LanesFrom<F, S> load(const S* from) {
  return static_cast<LanesFrom<F, S>>(*from);
}
/// Loads `count` >= 0 consecutive values, at most one for each lane, and sets the other lanes to 0. Does not read the
/// memory behind the values.
template <Plain F, class S>
TYNDALL_INLINE LanesFrom<F, S> load_some(const S* from, int count) {
  return count > 0 ? load<F>(from) : LanesFrom<F, S>(0);
}
template <class S, class T>
requires(std::is_arithmetic_v<T>) TYNDALL_INLINE void store(S* to, T v) { *to = static_cast<S>(v); }

}  // namespace tyndall
