#pragma once
#include "core/base/sampling.h"
#include "core/base/vec.h"

#include <cmath>

/// Rays beside a light path, which tell the curvature of its wave front and how it blurs.
namespace tyndall {

inline double squared_length(Vec3d v) { return dot(v, v); }
inline Vec3d normalized(Vec3d v) { return (1 / std::sqrt(squared_length(v))) * v; }

inline constexpr double angle_step = 1e-5;  ///< between a path and the rays beside it, radian

/// A ray that meets a surface, as its neighbours do.
struct MetSurface {
  bool is_sphere, inverted, far;  ///< far: the path met the sphere from within
  Vec3d center, point, normal;    ///< point, normal: of the path itself
  double radius, index;           ///< index: of refraction, inside over outside; 0: a mirror
  bool reflects;
};

/// Takes a ray near a light path to the same surface and on. False: it does not follow.
inline bool follow(const MetSurface& m, Vec3d& origin, Vec3d& direction) {
  Vec3d normal = m.normal;
  double t;
  if (m.is_sphere) {
    const Vec3d to_center = m.center - origin;
    const double middle = dot(to_center, direction);
    const Vec3d across = to_center - middle * direction;
    const double discriminant = m.radius * m.radius - dot(across, across);
    if (!(discriminant > 0)) return false;
    t = m.far ? middle + std::sqrt(discriminant) : middle - std::sqrt(discriminant);
    origin = origin + t * direction;
    normal = normalized(origin - m.center);
    if (m.inverted) normal = -normal;
  } else {
    t = dot(m.point - origin, normal) / dot(direction, normal);
    origin = origin + t * direction;
  }
  if (m.reflects) {
    direction = direction - (2 * dot(direction, normal)) * normal;
    return true;
  }
  const bool exiting = dot(direction, normal) > 0;
  const Vec3d facing = exiting ? -normal : normal;
  const double eta = exiting ? 1 / m.index : m.index, cosine = -dot(direction, facing);
  const double squared = eta * eta - 1 + cosine * cosine;
  if (!(squared > 0)) return false;
  direction = normalized(direction + (cosine - std::sqrt(squared)) * facing);
  return true;
}

/// A symmetric 2x2 matrix.
struct Symmetric {
  double xx = 0, xy = 0, yy = 0;
};

/// A 2x2 matrix.
struct Matrix {
  double a, b, c, d;
};
inline Matrix operator*(Matrix p, Matrix q) {
  return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
}
inline Matrix operator-(Matrix p, Matrix q) { return {p.a - q.a, p.b - q.b, p.c - q.c, p.d - q.d}; }
inline double determinant(Matrix m) { return m.a * m.d - m.b * m.c; }
inline Matrix inverse(Matrix m) {
  const double k = 1 / determinant(m);
  return {k * m.d, -k * m.b, -k * m.c, k * m.a};
}
inline void add_square(Matrix m, double scale, Symmetric& to) {
  to.xx += scale * (m.a * m.a + m.b * m.b), to.xy += scale * (m.a * m.c + m.b * m.d);
  to.yy += scale * (m.c * m.c + m.d * m.d);
}

struct ChangedPair {
  Matrix place, direction;
};

/// The changes of place and direction, in the plane across a flight at `point`, of two rays near it, as columns. They
/// are those of rays rotated or moved by `step`, divided by that.
inline ChangedPair changes_of(const Vec3d (&origin)[2], const Vec3d (&direction)[2], Vec3d point, Vec3d d,
                              double step) {
  const Basis<double> b = basis_around(d);
  double change[2][4];
  for (int i = 0; i < 2; ++i) {
    const double slope = 1 / dot(direction[i], d);
    const Vec3d flight = slope * direction[i], off = origin[i] + dot(point - origin[i], d) * flight - point;
    const double values[4] = {dot(off, b.s), dot(off, b.t), dot(flight, b.s), dot(flight, b.t)};
    for (int c = 0; c < 4; ++c) change[i][c] = values[c] / step;
  }
  return {{change[0][0], change[1][0], change[0][1], change[1][1]},
          {change[0][2], change[1][2], change[0][3], change[1][3]}};
}

}  // namespace tyndall
