#pragma once
#include "core/base/lanes_simd.h"

/// Two groups of lanes that work as one: while one waits for the result of an instruction, the other computes. It has
/// all the operations of base/lanes.h; lane i of the second group is lane lanes_of<T> + i of the whole.
namespace tyndall {

template <class T>
struct Twice {
  T a, b;
  Twice() = default;
  TYNDALL_INLINE Twice(T first, T second) : a(first), b(second) {}
  TYNDALL_INLINE Twice(typename T::Scalar value) : a(value), b(value) {}
};

template <class T>
requires(LaneTypes<T>::lanes > 1) struct LaneTypes<Twice<T>> {
  using Int = Twice<IntOf<T>>;
  using Uint = Twice<UintOf<T>>;
  using Mask = Twice<MaskOf<T>>;
  using Half = T;
  static constexpr int lanes = 2 * lanes_of<T>;
};

template <class T>
TYNDALL_INLINE Twice<T> operator+(Twice<T> x, Twice<T> y) {
  return {x.a + y.a, x.b + y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator-(Twice<T> x, Twice<T> y) {
  return {x.a - y.a, x.b - y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator*(Twice<T> x, Twice<T> y) {
  return {x.a * y.a, x.b * y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator/(Twice<T> x, Twice<T> y) {
  return {x.a / y.a, x.b / y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator&(Twice<T> x, Twice<T> y) {
  return {x.a & y.a, x.b & y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator^(Twice<T> x, Twice<T> y) {
  return {x.a ^ y.a, x.b ^ y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator|(Twice<T> x, Twice<T> y) {
  return {x.a | y.a, x.b | y.b};
}
template <class T>
TYNDALL_INLINE Twice<decltype(T() < T())> operator<(Twice<T> x, Twice<T> y) {
  return {x.a < y.a, x.b < y.b};
}
template <class T>
TYNDALL_INLINE Twice<decltype(T() <= T())> operator<=(Twice<T> x, Twice<T> y) {
  return {x.a <= y.a, x.b <= y.b};
}
template <class T>
TYNDALL_INLINE Twice<decltype(T() == T())> operator==(Twice<T> x, Twice<T> y) {
  return {x.a == y.a, x.b == y.b};
}
template <class T>
TYNDALL_INLINE Twice<T> operator-(Twice<T> x) {
  return {-x.a, -x.b};
}

template <class T>
TYNDALL_INLINE Twice<T> mask_and(Twice<T> x, Twice<T> y) {
  return {mask_and(x.a, y.a), mask_and(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> mask_or(Twice<T> x, Twice<T> y) {
  return {mask_or(x.a, y.a), mask_or(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> mask_and_not(Twice<T> x, Twice<T> y) {
  return {mask_and_not(x.a, y.a), mask_and_not(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> mask_not(Twice<T> x) {
  return {mask_not(x.a), mask_not(x.b)};
}
template <class T>
TYNDALL_INLINE bool any(Twice<T> x) {
  return any(mask_or(x.a, x.b));
}
template <class T>
TYNDALL_INLINE bool all(Twice<T> x) {
  return all(mask_and(x.a, x.b));
}
template <class T>
TYNDALL_INLINE std::uint32_t bits(Twice<T> x) {
  return bits(x.a) | bits(x.b) << T::lanes;
}
template <class M, class T>
TYNDALL_INLINE Twice<T> select(Twice<M> m, Twice<T> x, Twice<T> y) {
  return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}

template <class T>
TYNDALL_INLINE Twice<T> min(Twice<T> x, Twice<T> y) {
  return {min(x.a, y.a), min(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> max(Twice<T> x, Twice<T> y) {
  return {max(x.a, y.a), max(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> copy_sign(Twice<T> x, Twice<T> y) {
  return {copy_sign(x.a, y.a), copy_sign(x.b, y.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> abs(Twice<T> x) {
  return {abs(x.a), abs(x.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> sqrt(Twice<T> x) {
  return {sqrt(x.a), sqrt(x.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> floor(Twice<T> x) {
  return {floor(x.a), floor(x.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> mul_add(Twice<T> x, Twice<T> y, Twice<T> z) {
  return {mul_add(x.a, y.a, z.a), mul_add(x.b, y.b, z.b)};
}
template <class T>
TYNDALL_INLINE Twice<T> neg_mul_add(Twice<T> x, Twice<T> y, Twice<T> z) {
  return {neg_mul_add(x.a, y.a, z.a), neg_mul_add(x.b, y.b, z.b)};
}
template <class T>
TYNDALL_INLINE auto to_int(Twice<T> x) {
  return Twice<decltype(to_int(x.a))>{to_int(x.a), to_int(x.b)};
}
template <class T>
TYNDALL_INLINE auto float_from_int(Twice<T> x) {
  return Twice<decltype(float_from_int(x.a))>{float_from_int(x.a), float_from_int(x.b)};
}
template <class T>
TYNDALL_INLINE auto as_uint(Twice<T> x) {
  return Twice<decltype(as_uint(x.a))>{as_uint(x.a), as_uint(x.b)};
}
template <class T>
TYNDALL_INLINE auto as_int(Twice<T> x) {
  return Twice<decltype(as_int(x.a))>{as_int(x.a), as_int(x.b)};
}
template <class T>
TYNDALL_INLINE auto float_bits(Twice<T> x) {
  return Twice<decltype(float_bits(x.a))>{float_bits(x.a), float_bits(x.b)};
}
template <class T>
TYNDALL_INLINE auto float_from_bits(Twice<T> x) {
  return Twice<decltype(float_from_bits(x.a))>{float_from_bits(x.a), float_from_bits(x.b)};
}
template <int by, class T>
TYNDALL_INLINE Twice<T> shift_left(Twice<T> x) {
  return {shift_left<by>(x.a), shift_left<by>(x.b)};
}
template <int by, class T>
TYNDALL_INLINE Twice<T> shift_right(Twice<T> x) {
  return {shift_right<by>(x.a), shift_right<by>(x.b)};
}
template <class T>
TYNDALL_INLINE float min_lane(Twice<T> x) {
  return min_lane(min(x.a, x.b));
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
template <Doubled F>
TYNDALL_INLINE F gather(const float* table, IntOf<F> index) {
  return {gather<HalfOf<F>>(table, index.a), gather<HalfOf<F>>(table, index.b)};
}
template <Doubled F>
TYNDALL_INLINE IntOf<F> gather_int(const std::int32_t* table, IntOf<F> index) {
  return {gather_int<HalfOf<F>>(table, index.a), gather_int<HalfOf<F>>(table, index.b)};
}
template <Doubled F>
TYNDALL_INLINE F lookup(const float* table, int count, IntOf<F> index) {
  return {lookup<HalfOf<F>>(table, count, index.a), lookup<HalfOf<F>>(table, count, index.b)};
}
template <Doubled F>
TYNDALL_INLINE IntOf<F> lookup_int(const std::int32_t* table, int count, IntOf<F> index) {
  return {lookup_int<HalfOf<F>>(table, count, index.a), lookup_int<HalfOf<F>>(table, count, index.b)};
}
template <Doubled F>
TYNDALL_INLINE F load(const float* from) {
  return {load<HalfOf<F>>(from), load<HalfOf<F>>(from + lanes_of<HalfOf<F>>)};
}
template <Doubled F>
TYNDALL_INLINE IntOf<F> load_int(const std::int32_t* from) {
  return {load_int<HalfOf<F>>(from), load_int<HalfOf<F>>(from + lanes_of<HalfOf<F>>)};
}
template <Doubled F>
TYNDALL_INLINE UintOf<F> load_uint(const std::uint32_t* from) {
  return {load_uint<HalfOf<F>>(from), load_uint<HalfOf<F>>(from + lanes_of<HalfOf<F>>)};
}
template <Doubled F>
TYNDALL_INLINE MaskOf<F> mask_from_bits(std::uint32_t b) {
  return {mask_from_bits<HalfOf<F>>(b), mask_from_bits<HalfOf<F>>(b >> lanes_of<HalfOf<F>>)};
}

}  // namespace tyndall
