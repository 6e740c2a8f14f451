#pragma once
#include "core/base/lanes_simd.h"
#include "core/base/target.h"

/// The lanes of the instruction set that the including file is compiled for. CMake compiles some files once for each
/// wide set, with its flags and with TYNDALL_TARGET, its name among the Targets: `avx2`, for example. Older CPUs cannot
/// run them, so that they must contain nothing but what is called for that set alone.
namespace tyndall {

/// Two groups of lanes that work as one: while one waits for the result of an instruction, the other computes. It has
/// all the operations of base/lanes.h; lane i of the second group is lane lanes_of<T> + i of the whole.
template <class T>
struct Twice {
  T a, b;
  Twice() = default;
  TYNDALL_INLINE Twice(T first, T second) : a(first), b(second) {}
  TYNDALL_INLINE Twice(typename T::Scalar value) : a(value), b(value) {}

  // "tyndall::Twice" is a pair of whatever its arguments are; "Twice" is this very type.
  TYNDALL_INLINE friend Twice operator+(Twice x, Twice y) { return {x.a + y.a, x.b + y.b}; }
  TYNDALL_INLINE friend Twice operator-(Twice x, Twice y) { return {x.a - y.a, x.b - y.b}; }
  TYNDALL_INLINE friend Twice operator*(Twice x, Twice y) { return {x.a * y.a, x.b * y.b}; }
  TYNDALL_INLINE friend Twice operator/(Twice x, Twice y) { return {x.a / y.a, x.b / y.b}; }
  TYNDALL_INLINE friend Twice operator&(Twice x, Twice y) { return {x.a & y.a, x.b & y.b}; }
  TYNDALL_INLINE friend Twice operator^(Twice x, Twice y) { return {x.a ^ y.a, x.b ^ y.b}; }
  TYNDALL_INLINE friend Twice operator|(Twice x, Twice y) { return {x.a | y.a, x.b | y.b}; }
  TYNDALL_INLINE friend auto operator<(Twice x, Twice y) { return tyndall::Twice(x.a < y.a, x.b < y.b); }
  TYNDALL_INLINE friend auto operator<=(Twice x, Twice y) { return tyndall::Twice(x.a <= y.a, x.b <= y.b); }
  TYNDALL_INLINE friend auto operator==(Twice x, Twice y) { return tyndall::Twice(x.a == y.a, x.b == y.b); }
  TYNDALL_INLINE friend Twice operator-(Twice x) { return {-x.a, -x.b}; }
  TYNDALL_INLINE friend Twice mask_and(Twice x, Twice y) { return {mask_and(x.a, y.a), mask_and(x.b, y.b)}; }
  TYNDALL_INLINE friend Twice mask_or(Twice x, Twice y) { return {mask_or(x.a, y.a), mask_or(x.b, y.b)}; }
  TYNDALL_INLINE friend Twice mask_and_not(Twice x, Twice y) {
    return {mask_and_not(x.a, y.a), mask_and_not(x.b, y.b)};
  }
  TYNDALL_INLINE friend Twice mask_not(Twice x) { return {mask_not(x.a), mask_not(x.b)}; }
  TYNDALL_INLINE friend bool any(Twice x) { return any(mask_or(x.a, x.b)); }
  TYNDALL_INLINE friend bool all(Twice x) { return all(mask_and(x.a, x.b)); }
  TYNDALL_INLINE friend std::uint32_t bits(Twice x) { return bits(x.a) | bits(x.b) << T::lanes; }
  TYNDALL_INLINE friend Twice min(Twice x, Twice y) { return {min(x.a, y.a), min(x.b, y.b)}; }
  TYNDALL_INLINE friend Twice max(Twice x, Twice y) { return {max(x.a, y.a), max(x.b, y.b)}; }
  TYNDALL_INLINE friend Twice copy_sign(Twice x, Twice y) { return {copy_sign(x.a, y.a), copy_sign(x.b, y.b)}; }
  TYNDALL_INLINE friend Twice abs(Twice x) { return {abs(x.a), abs(x.b)}; }
  TYNDALL_INLINE friend Twice sqrt(Twice x) { return {sqrt(x.a), sqrt(x.b)}; }
  TYNDALL_INLINE friend Twice floor(Twice x) { return {floor(x.a), floor(x.b)}; }
  TYNDALL_INLINE friend Twice mul_add(Twice x, Twice y, Twice z) {
    return {mul_add(x.a, y.a, z.a), mul_add(x.b, y.b, z.b)};
  }
  TYNDALL_INLINE friend Twice neg_mul_add(Twice x, Twice y, Twice z) {
    return {neg_mul_add(x.a, y.a, z.a), neg_mul_add(x.b, y.b, z.b)};
  }
  TYNDALL_INLINE friend auto to_int(Twice x) { return tyndall::Twice(to_int(x.a), to_int(x.b)); }
  TYNDALL_INLINE friend auto as_uint(Twice x) { return tyndall::Twice(as_uint(x.a), as_uint(x.b)); }
  TYNDALL_INLINE friend auto as_int(Twice x) { return tyndall::Twice(as_int(x.a), as_int(x.b)); }
  TYNDALL_INLINE friend auto float_bits(Twice x) { return tyndall::Twice(float_bits(x.a), float_bits(x.b)); }
  TYNDALL_INLINE friend auto float_from_bits(Twice x) {
    return tyndall::Twice(float_from_bits(x.a), float_from_bits(x.b));
  }
  TYNDALL_INLINE friend float min_lane(Twice x) { return min_lane(min(x.a, x.b)); }
};

template <class T>
requires(LaneTypes<T>::lanes > 1) struct LaneTypes<Twice<T>> {
  using Int = Twice<IntOf<T>>;
  using Uint = Twice<UintOf<T>>;
  using Mask = Twice<MaskOf<T>>;
  using Half = T;
  static constexpr int lanes = 2 * lanes_of<T>;
};

template <class M, class T>
TYNDALL_INLINE Twice<T> select(Twice<M> m, Twice<T> x, Twice<T> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}

template <int by, class T>
TYNDALL_INLINE Twice<T> shift_left(Twice<T> x) {
  return {shift_left<by>(x.a), shift_left<by>(x.b)};
}
template <int by, class T>
TYNDALL_INLINE Twice<T> shift_right(Twice<T> x) {
  return {shift_right<by>(x.a), shift_right<by>(x.b)};
}
template <class S, class T>
TYNDALL_INLINE void store(S* to, Twice<T> x) {
  store(to, x.a);
  store(to + sizeof(T) / sizeof(S), x.b);
}
template <class S, class T, class M>
TYNDALL_INLINE int append(S* to, Twice<T> x, Twice<M> lanes) {
  const int first = append(to, x.a, lanes.a);
  return first + append(to + first, x.b, lanes.b);
}

template <Doubled F>
TYNDALL_INLINE F from_int(IntOf<F> v) {
  return {from_int<HalfOf<F>>(v.a), from_int<HalfOf<F>>(v.b)};
}
template <Doubled F, class S>
TYNDALL_INLINE LanesFrom<F, S> gather(const S* table, IntOf<F> index) {
  return {gather<HalfOf<F>>(table, index.a), gather<HalfOf<F>>(table, index.b)};
}
template <Doubled F, class S>
TYNDALL_INLINE LanesFrom<F, S> lookup(const S* table, int count, IntOf<F> index) {
  return {lookup<HalfOf<F>>(table, count, index.a), lookup<HalfOf<F>>(table, count, index.b)};
}
template <Doubled F, class S>
TYNDALL_INLINE LanesFrom<F, S> load(const S* from) {
  return {load<HalfOf<F>>(from), load<HalfOf<F>>(from + lanes_of<HalfOf<F>>)};
}
template <Doubled F>
TYNDALL_INLINE MaskOf<F> mask_from_bits(std::uint32_t b) {
  return {mask_from_bits<HalfOf<F>>(b), mask_from_bits<HalfOf<F>>(b >> lanes_of<HalfOf<F>>)};
}

/// One register of lanes.
using TargetLanes = HWY_NAMESPACE::Floats;
static_assert(lanes_of<TargetLanes> == floats_in(Target::TYNDALL_TARGET),
              "the SIMD library fell back to a narrower set: a flag is missing");

/// What kernels compute with: two registers where they are wide, so that one computes while the other waits.
using KernelLanes = std::conditional_t<(lanes_of<TargetLanes> >= 8), Twice<TargetLanes>, TargetLanes>;

}  // namespace tyndall
