#pragma once
#include "core/base/ray.h"
#include "core/base/sampling.h"

#include <random>

/// Scattering events for tests of materials alone.
namespace tyndall::test {

/// Event number `number` at a surface with this normal, as the path loop would give it to the material.
template <class F>
Incident<F> event(const Sampler<F>& sampler, Vec3<F> direction, Vec3<F> normal) {
  const F towards = dot(direction, normal);
  const bool along_normal = towards > 0;
  return {direction,
          normal,
          along_normal ? -normal : normal,
          min(abs(towards), F(1)),
          along_normal,
          on_sphere(sampler.next_2d(dimension::direction)),
          false,
          sampler};
}

template <class F>
Sampler<F> sampler(std::uint32_t number) {
  return Sampler<F>::of(7, number, number >> 16, number * 3u);
}

/// Unit vectors in all directions.
class Directions {
 public:
  template <class F>
  Vec3<F> next() {
    Vec3d v{normal_(engine_), normal_(engine_), normal_(engine_)};
    v = normalize(v);
    return {static_cast<F>(v.x), static_cast<F>(v.y), static_cast<F>(v.z)};
  }
  /// A unit vector at `angle` to the unit vector `axis`.
  template <class F>
  Vec3<F> at_angle(Vec3<F> axis, double angle) {
    const Vec3d a{axis.x, axis.y, axis.z}, unit = normalize(a);
    const Vec3d across = normalize(cross(unit, next<double>()));
    const Vec3d v = std::cos(angle) * unit + std::sin(angle) * across;
    return {static_cast<F>(v.x), static_cast<F>(v.y), static_cast<F>(v.z)};
  }

 private:
  std::mt19937 engine_{1};
  std::normal_distribution<double> normal_;
};

/// A direction of incidence at `angle` (radians) to the normal z, travelling down.
template <class F>
Vec3<F> down_at(double angle) {
  return {static_cast<F>(std::sin(angle)), F(0), static_cast<F>(-std::cos(angle))};
}

template <class F>
inline const Vec3<F> up{F(0), F(0), F(1)};

constexpr double degrees = pi / 180;

}  // namespace tyndall::test
