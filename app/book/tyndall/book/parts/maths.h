#pragma once
#include "random.h"

#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>

/// Vectors, colours, rays, intervals and boxes. Scenes are built from vectors and colours. The others are here for
/// readers' own classes, so that these compile: nothing is traced by them.
using std::fabs;
using std::make_shared;
using std::shared_ptr;
using std::sqrt;

struct vec3;

namespace tyndall_book {

/// Whether a loop in main() is being followed: see loop.h.
inline std::atomic<bool> follows_sums{false};
/// Told before a vector is added to a sum.
void take_sum(const vec3& sum, const vec3& added);

/// A coordinate that serves readers who write v.x() and those who write v.x.
struct coordinate {
  double value;

  double operator()() const { return value; }
  operator double() const { return value; }
  coordinate& operator=(double to) { return value = to, *this; }
  coordinate& operator+=(double add) { return *this = value + add; }
  coordinate& operator-=(double subtract) { return *this = value - subtract; }
  coordinate& operator*=(double factor) { return *this = value * factor; }
  coordinate& operator/=(double divisor) { return *this = value / divisor; }
};

}  // namespace tyndall_book

struct vec3 {
  __extension__ union {
    double e[3] = {0, 0, 0};
    struct {
      tyndall_book::coordinate x, y, z;
    };
    struct {
      tyndall_book::coordinate r, g, b;
    };
  };

  vec3() = default;
  vec3(double on_x, double on_y, double on_z) : e{on_x, on_y, on_z} {}
  explicit vec3(double all) : vec3(all, all, all) {}
  TYNDALL_BOOK_VEC3_MEMBERS

  double operator[](int axis) const { return e[axis]; }
  double& operator[](int axis) { return e[axis]; }

  const vec3& operator+() const { return *this; }
  vec3 operator-() const { return vec3(-e[0], -e[1], -e[2]); }
  vec3& operator+=(const vec3& other) {
    if (tyndall_book::follows_sums) tyndall_book::take_sum(*this, other);
    for (int k = 0; k < 3; ++k) e[k] += other.e[k];
    return *this;
  }
  vec3& operator-=(const vec3& other) {
    for (int k = 0; k < 3; ++k) e[k] -= other.e[k];
    return *this;
  }
  vec3& operator*=(const vec3& other) {
    for (int k = 0; k < 3; ++k) e[k] *= other.e[k];
    return *this;
  }
  vec3& operator/=(const vec3& other) {
    for (int k = 0; k < 3; ++k) e[k] /= other.e[k];
    return *this;
  }
  vec3& operator*=(double factor) { return *this *= vec3(factor, factor, factor); }
  vec3& operator/=(double divisor) { return *this *= 1 / divisor; }

  double length_squared() const { return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]; }
  double squared_length() const { return length_squared(); }
  double lengthSquared() const { return length_squared(); }
  double length() const { return std::sqrt(length_squared()); }
  double magnitude() const { return length(); }
  double mag() const { return length(); }
  double mag_squared() const { return length_squared(); }
  void make_unit_vector() { *this /= length(); }
  bool near_zero() const { return std::fabs(e[0]) < 1e-8 && std::fabs(e[1]) < 1e-8 && std::fabs(e[2]) < 1e-8; }
  void write_color(std::ostream& out, int samples) const;
  double dot(const vec3& other) const;
  vec3 cross(const vec3& other) const;
  vec3 unit_vector() const;
  vec3 normalized() const;

  /// With parentheses, as readers write it: in braces the order of the three draws would be from left to right, with
  /// any compiler.
  static vec3 random() { return vec3(random_double(), random_double(), random_double()); }
  static vec3 random(double low, double high) {
    return vec3(random_double(low, high), random_double(low, high), random_double(low, high));
  }
};

using point3 = vec3;

/// A class of its own, not another name for vec3: a function of the reader's may be called color, too, as in the first
/// edition, and then hides it.
struct color : vec3 {
  using vec3::vec3;
  color() = default;
  color(const vec3& other) : vec3(other) {}
};

inline std::ostream& operator<<(std::ostream& out, const vec3& v) { return out << v[0] << ' ' << v[1] << ' ' << v[2]; }
inline std::istream& operator>>(std::istream& in, vec3& v) { return in >> v[0] >> v[1] >> v[2]; }
inline vec3 operator+(const vec3& a, const vec3& b) { return vec3(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
inline vec3 operator-(vec3 a, const vec3& b) { return a -= b; }
inline vec3 operator*(vec3 a, const vec3& b) { return a *= b; }
inline vec3 operator/(vec3 a, const vec3& b) { return a /= b; }
inline vec3 operator*(vec3 v, double factor) { return v *= factor; }
inline vec3 operator*(double factor, vec3 v) { return v *= factor; }
inline vec3 operator/(vec3 v, double divisor) { return v /= divisor; }

inline double dot(const vec3& a, const vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline vec3 cross(const vec3& a, const vec3& b) {
  return vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline vec3 unit_vector(const vec3& v) { return v / v.length(); }
inline double vec3::dot(const vec3& other) const { return ::dot(*this, other); }
inline vec3 vec3::cross(const vec3& other) const { return ::cross(*this, other); }
inline vec3 vec3::unit_vector() const { return ::unit_vector(*this); }
inline vec3 vec3::normalized() const { return ::unit_vector(*this); }

TYNDALL_BOOK_HELPER vec3 random_in_unit_sphere() {
  vec3 point = vec3::random(-1, 1);
  while (point.length_squared() >= 1) point = vec3::random(-1, 1);
  return point;
}
TYNDALL_BOOK_HELPER vec3 random_unit_vector() { return unit_vector(random_in_unit_sphere()); }
TYNDALL_BOOK_HELPER vec3 random_on_hemisphere(const vec3& normal) {
  const vec3 direction = random_unit_vector();
  return dot(direction, normal) > 0 ? direction : -direction;
}
TYNDALL_BOOK_HELPER vec3 random_in_hemisphere(const vec3& normal) {
  const vec3 point = random_in_unit_sphere();
  return dot(point, normal) > 0 ? point : -point;
}
TYNDALL_BOOK_HELPER vec3 random_in_unit_disk() {
  for (;;) {
    const vec3 point = vec3(random_double(-1, 1), random_double(-1, 1), 0);
    if (point.length_squared() < 1) return point;
  }
}
TYNDALL_BOOK_HELPER vec3 random_cosine_direction() {
  const double phi = 2 * tyndall_book::half_turn * random_double(), radius2 = random_double();
  return vec3(std::cos(phi) * std::sqrt(radius2), std::sin(phi) * std::sqrt(radius2), std::sqrt(1 - radius2));
}
TYNDALL_BOOK_HELPER vec3 reflect(const vec3& v, const vec3& normal) { return v - 2 * dot(v, normal) * normal; }
TYNDALL_BOOK_HELPER vec3 refract(const vec3& unit, const vec3& normal, double ratio) {
  const vec3 across = ratio * (unit + std::fmin(-dot(unit, normal), 1.0) * normal);
  return across - std::sqrt(std::fabs(1 - across.length_squared())) * normal;
}

namespace tyndall_book {

/// A vector that serves readers who write r.direction() and those who write r.direction.
struct vector_member : vec3 {
  vector_member() = default;
  vector_member(const vec3& v) : vec3(v) {}
  const vec3& operator()() const { return *this; }
};

}  // namespace tyndall_book

struct ray {
  tyndall_book::vector_member origin, direction;
  point3 orig, A;  ///< the origin, too; A in the first edition
  vec3 dir, B;     ///< the direction, too
  double tm = 0;

  ray() = default;
  ray(const point3& from, const vec3& along, double at_time = 0)
      : origin(from), direction(along), orig(from), A(from), dir(along), B(along), tm(at_time) {}
  double time() const { return tm; }
  point3 at(double t) const { return orig + t * dir; }
  point3 point_at_parameter(double t) const { return at(t); }
};

struct interval {
  double min = tyndall_book::endless, max = -tyndall_book::endless;

  interval() = default;
  interval(double low, double high) : min(low), max(high) {}
  interval(const interval& a, const interval& b) : min(std::fmin(a.min, b.min)), max(std::fmax(a.max, b.max)) {}
  double size() const { return max - min; }
  bool contains(double x) const { return min <= x && x <= max; }
  bool surrounds(double x) const { return min < x && x < max; }
  double clamp(double x) const { return x < min ? min : x > max ? max : x; }
  interval expand(double delta) const { return interval(min - delta / 2, max + delta / 2); }
  static const interval empty, universe;
};
inline const interval interval::empty = interval(tyndall_book::endless, -tyndall_book::endless);
inline const interval interval::universe = interval(-tyndall_book::endless, tyndall_book::endless);
inline interval operator+(const interval& range, double shift) {
  return interval(range.min + shift, range.max + shift);
}
inline interval operator+(double shift, const interval& range) { return range + shift; }

struct aabb {
  interval x, y, z;
  point3 minimum, maximum;

  aabb() = default;
  aabb(const interval& on_x, const interval& on_y, const interval& on_z)
      : x(on_x), y(on_y), z(on_z), minimum(x.min, y.min, z.min), maximum(x.max, y.max, z.max) {}
  aabb(const point3& a, const point3& b) : aabb(between(a, b, 0), between(a, b, 1), between(a, b, 2)) {}
  aabb(const aabb& a, const aabb& b) : aabb(interval(a.x, b.x), interval(a.y, b.y), interval(a.z, b.z)) {}
  const interval& axis_interval(int axis) const { return axis == 1 ? y : axis == 2 ? z : x; }
  const interval& axis(int n) const { return axis_interval(n); }
  point3 min() const { return minimum; }
  point3 max() const { return maximum; }
  int longest_axis() const {
    if (x.size() > y.size()) return x.size() > z.size() ? 0 : 2;
    return y.size() > z.size() ? 1 : 2;
  }
  bool hit(const ray&, interval) const { return true; }
  bool hit(const ray&, double, double) const { return true; }
  aabb pad() const { return *this; }
  static const aabb empty, universe;

 private:
  static interval between(const point3& a, const point3& b, int axis) {
    return interval(std::fmin(a[axis], b[axis]), std::fmax(a[axis], b[axis]));
  }
};
inline const aabb aabb::empty = aabb(interval(), interval(), interval());
inline const aabb aabb::universe = aabb(interval::universe, interval::universe, interval::universe);
inline aabb operator+(const aabb& box, const vec3& shift) {
  return aabb(box.x + shift.x(), box.y + shift.y(), box.z + shift.z());
}
inline aabb surrounding_box(const aabb& a, const aabb& b) { return aabb(a, b); }

/// Three directions at right angles, the third along a given one.
struct onb {
  vec3 axes[3];

  onb() = default;
  explicit onb(const vec3& w) { build_from_w(w); }
  void build_from_w(const vec3& w) {
    axes[2] = unit_vector(w);
    axes[1] = unit_vector(cross(axes[2], std::fabs(axes[2][0]) > 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    axes[0] = cross(axes[2], axes[1]);
  }
  const vec3& u() const { return axes[0]; }
  const vec3& v() const { return axes[1]; }
  const vec3& w() const { return axes[2]; }
  const vec3& operator[](int axis) const { return axes[axis]; }
  vec3 local(double a, double b, double c) const { return a * axes[0] + b * axes[1] + c * axes[2]; }
  vec3 local(const vec3& v) const { return local(v[0], v[1], v[2]); }
  vec3 transform(const vec3& v) const { return local(v); }
};
