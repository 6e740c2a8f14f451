#pragma once
#include "core/base/lanes.h"

/// Three numbers for places, directions and colours, and their arithmetic.
namespace tyndall {

/// A point, a direction or a colour (linear Rec.709: x red, y green, z blue). Vec3<float> is a single vector; Vec3 of a
/// group of lanes holds one vector for each lane; Vec3d is the type of scene files.
template <class F>
struct Vec3 {
  F x{}, y{}, z{};
  bool operator==(const Vec3&) const = default;
};

/// Vectors of groups of lanes are zero only if initialised by {}: kernels have many that are assigned later, and
/// clearing all of them takes up to a twentieth of the time.
template <class F>
requires(lanes_of<F> > 1) struct Vec3<F> {
  F x, y, z;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

inline Vec3f to_float(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
inline Vec3d to_double(Vec3f v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

template <class F>
TYNDALL_INLINE Vec3<F> operator+(Vec3<F> a, Vec3<F> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class F>
TYNDALL_INLINE Vec3<F> operator-(Vec3<F> a, Vec3<F> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class F>
TYNDALL_INLINE Vec3<F> operator-(Vec3<F> a) {
  return {-a.x, -a.y, -a.z};
}
/// Component by component, as for colours.
template <class F>
TYNDALL_INLINE Vec3<F> operator*(Vec3<F> a, Vec3<F> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class F>
TYNDALL_INLINE Vec3<F> operator*(F s, Vec3<F> a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class F>
TYNDALL_INLINE F dot(Vec3<F> a, Vec3<F> b) {
  return mul_add(a.x, b.x, mul_add(a.y, b.y, a.z * b.z));
}
template <class F>
TYNDALL_INLINE Vec3<F> cross(Vec3<F> a, Vec3<F> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class F>
TYNDALL_INLINE F length(Vec3<F> a) {
  return sqrt(dot(a, a));
}
/// a / |a|; a must not be zero.
template <class F>
TYNDALL_INLINE Vec3<F> normalize(Vec3<F> a) {
  return (F(1) / sqrt(dot(a, a))) * a;
}
/// origin + t·direction.
template <class F>
TYNDALL_INLINE Vec3<F> point_at(Vec3<F> origin, F t, Vec3<F> direction) {
  return {mul_add(t, direction.x, origin.x), mul_add(t, direction.y, origin.y), mul_add(t, direction.z, origin.z)};
}
/// Returns d reflected at the plane with unit normal n: d - 2 (d · n) n.
template <class F>
TYNDALL_INLINE Vec3<F> reflect(Vec3<F> d, Vec3<F> n) {
  return point_at(d, F(-2) * dot(d, n), n);
}
template <class M, class F>
TYNDALL_INLINE Vec3<F> select(M m, Vec3<F> a, Vec3<F> b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class F>
TYNDALL_INLINE F max_component(Vec3<F> a) {
  return max(a.x, max(a.y, a.z));
}
/// The same vector in every lane of F.
template <class F>
TYNDALL_INLINE Vec3<F> splat(Vec3f v) {
  return {splat<F>(v.x), splat<F>(v.y), splat<F>(v.z)};
}
template <class F>
TYNDALL_INLINE Vec3<F> zero3() {
  return {F(0), F(0), F(0)};
}

}  // namespace tyndall
