#pragma once
#include "core/base/sampling.h"
#include "core/guide/light_image.h"
#include "core/trace/scene_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// The near-specular elements of a scene, and paths over them with rays beside them, which tell the curvature of the
/// wave front and how it blurs.
namespace tyndall {

/// An entry of a column of the scene, in double.
inline double at(const float* column, int i) { return static_cast<double>(column[i]); }

inline constexpr int max_guide_lights = 16;  ///< that light paths start from: the first ones

/// A near-specular element: a sphere, a quad or a face of a box.
struct Thing {
  std::int32_t element = 0;
  bool is_sphere = false;
  Vec3d center, motion;  ///< of a sphere: at time 0, and from there to time 1
  double radius = 0;
  Vec3d corner, u, v;  ///< of a flat
  double fuzz = 0;     ///< 0 for mirrors and glass
  int object = -1;     ///< the specular object whose paths are solved for exactly; -1: none
  double power = 0;    ///< roughly the power that lights send to it
};

/// The things that matter most, at most max_guided_things. Empty if there are none, or no light or diffuse surface.
std::vector<Thing> list_things(const SceneView& scene);

inline constexpr double angle_step = 1e-5;  ///< between a path and the rays beside it, radian

/// A surface that a path meets, and with it the rays beside the path.
struct MetSurface {
  bool is_sphere, inverted, far;  ///< far: the path met the sphere from within
  Vec3d center, point, normal;    ///< point, normal: of the path itself
  double radius, index;           ///< index: of refraction, inside over outside; 0: a mirror
  bool reflects;
};

/// Takes a ray to a surface that the path beside it has met, and on. False: it does not meet it, or does not go on.
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
    normal = normalize(origin - m.center);
    if (m.inverted) normal = -normal;
  } else {
    t = dot(m.point - origin, normal) / dot(direction, normal);
    origin = origin + t * direction;
  }
  if (m.reflects) {
    direction = reflect(direction, normal);
    return true;
  }
  const bool exiting = dot(direction, normal) > 0;
  const Vec3d facing = exiting ? -normal : normal;
  const double eta = exiting ? 1 / m.index : m.index, cosine = -dot(direction, facing);
  const double squared = eta * eta - 1 + cosine * cosine;
  if (!(squared > 0)) return false;
  direction = normalize(direction + (cosine - std::sqrt(squared)) * facing);
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

/// How places and directions change from one ray to another, with each step between them.
struct Changes {
  Matrix place, direction;
};

/// A path from a light or from the camera, and rays beside it. The first ray is the path itself; at each fuzzy
/// reflection two rays join that are rotated there.
struct Beam {
  struct NearbyRay {
    Vec3d origin, direction;
    bool lost = false;
  };
  std::vector<NearbyRay> rays;
  std::vector<double> fuzz;  ///< of the fuzzy reflections
  double time = 0;
  std::int32_t from = from_nowhere;  ///< Ray::from of the path

  Ray<double> path() const { return {rays[0].origin, rays[0].direction, time, from}; }
  bool is_whole() const {
    return std::none_of(rays.begin(), rays.end(), [](const NearbyRay& ray) { return ray.lost; });
  }

  /// Sends the rays on from a surface of some fuzz. False: the path itself does not go on.
  bool pass(const MetSurface& m, double its_fuzz) {
    for (NearbyRay& ray : rays) ray.lost = ray.lost || !follow(m, ray.origin, ray.direction);
    const NearbyRay own = rays[0];
    if (own.lost || !(its_fuzz > 0)) return !own.lost;
    const Basis<double> b = basis_around(own.direction);
    for (const Vec3d& across : {b.s, b.t}) rays.push_back({own.origin, normalize(own.direction + angle_step * across)});
    fuzz.push_back(its_fuzz);
    return true;
  }

  /// The changes of the rays k and k + 1 in the plane across the path at `point`, as columns. step: by which they were
  /// rotated or moved.
  Changes changes(std::size_t k, Vec3d point, double step) const {
    const Vec3d d = rays[0].direction;
    const Basis<double> b = basis_around(d);
    double change[2][4];
    for (std::size_t i = 0; i < 2; ++i) {
      const NearbyRay& ray = rays[k + i];
      const double slope = 1 / dot(ray.direction, d);
      const Vec3d flight = slope * ray.direction, off = ray.origin + dot(point - ray.origin, d) * flight - point;
      const double values[4] = {dot(off, b.s), dot(off, b.t), dot(flight, b.s), dot(flight, b.t)};
      for (int c = 0; c < 4; ++c) change[i][c] = values[c] / step;
    }
    return {{change[0][0], change[1][0], change[0][1], change[1][1]},
            {change[0][2], change[1][2], change[0][3], change[1][3]}};
  }
};

}  // namespace tyndall
