#pragma once
#include "core/base/math.h"
#include "core/base/vec.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// What the light tracer draws at random, and its camera.
namespace tyndall::test {

/// SplitMix64. G. Steele, D. Lea, C. Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.
struct SplitMix {
  std::uint64_t state = 0;
  /// Uniform in (0, 1).
  double operator()() {
    state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
};

struct Axes {
  Vec3d s, t;
};

/// Two unit vectors at right angles to a third and to each other.
inline Axes axes_around(Vec3d unit_vector) {
  const Vec3d s = normalize(cross(unit_vector, std::abs(unit_vector.x) > 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
  return {s, cross(unit_vector, s)};
}

/// The unit vector at an angle to the axis whose cosine is 1 - versine.
inline Vec3d lean(Vec3d axis, double versine, double u) {
  const Axes a = axes_around(axis);
  const double sine = std::sqrt(std::max(versine * (2 - versine), 0.0));
  return (1 - versine) * axis + (sine * std::cos(2 * pi * u)) * a.s + (sine * std::sin(2 * pi * u)) * a.t;
}

inline Vec3d on_unit_sphere(SplitMix& random) { return lean({0, 0, 1}, 2 * random(), random()); }

/// In the directions of one side, with a density of the cosine over pi.
inline Vec3d by_cosine(Vec3d normal, SplitMix& random) { return lean(normal, 1 - std::sqrt(random()), random()); }

/// Reflected fraction of unpolarised light. Born & Wolf, Principles of Optics, section 1.5.2.
inline double reflected_fraction(double cos_in, double index) {
  const double squared = 1 - (1 - cos_in * cos_in) / (index * index);
  if (squared <= 0) return 1;
  const double cos_out = std::sqrt(squared);
  const double s = (cos_in - index * cos_out) / (cos_in + index * cos_out);
  const double p = (index * cos_in - cos_out) / (index * cos_in + cos_out);
  return (s * s + p * p) / 2;
}

/// Henyey and Greenstein's phase function, per steradian.
inline double phase(double g, double cosine) {
  return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

inline double phase_cosine(double g, double u) {
  if (std::abs(g) < 1e-6) return 2 * u - 1;
  const double r = (1 - g * g) / (1 - g + 2 * g * u);
  return (1 + g * g - r * r) / (2 * g);
}

/// A camera without a lens.
struct Pinhole {
  Vec3d eye, right, up, back;
  double half_width, half_height;  ///< of the picture, at distance 1
  int width, height;

  explicit Pinhole(const Scene& scene)
      : eye(scene.camera.look_from),
        right(normalize(cross(scene.camera.vup, normalize(scene.camera.look_from - scene.camera.look_at)))),
        up(cross(normalize(scene.camera.look_from - scene.camera.look_at), right)),
        back(normalize(scene.camera.look_from - scene.camera.look_at)),
        half_width(std::tan(scene.camera.vfov * pi / 360) * scene.width / scene.height),
        half_height(std::tan(scene.camera.vfov * pi / 360)),
        width(scene.width),
        height(scene.height) {}

  Vec3d direction(double x, double y) const {
    return normalize((2 * x / width - 1) * half_width * right + (1 - 2 * y / height) * half_height * up - back);
  }
};

}  // namespace tyndall::test
