#pragma once
#include "core/base/fields.h"
#include "core/materials/bsdf.h"

#include <tuple>

/// Metal, from mirrors to brushed surfaces: what users set, and how light is reflected.
namespace tyndall {

/// Polished to brushed metal: a mirror whose reflected direction is blurred by adding a random point of a ball.
template <class F = double>
struct Metal {
  static constexpr const char* type = "metal";
  static constexpr const char* about = "A mirror, blurred by fuzz.";
  static constexpr const char* colour_name = "albedo";
  static constexpr BsdfTraits traits{
      .glossy = true, .constant_weight = true, .light_sampling = LightSampling::weighted};
  F fuzz = F(0);
  bool operator==(const Metal&) const = default;
};

template <class F>
constexpr auto fields(const Metal<F>*) {
  return std::tuple{Field{"fuzz", &Metal<F>::fuzz, between(0, 1), Slider{0, 1}, "",
                          "radius of the blur around the mirror direction; 0 is a mirror"}
                        .also("roughness, rough, glossiness, gloss")};
}

template <class F>
constexpr double lobe_width(const Metal<F>& metal) {
  return static_cast<double>(metal.fuzz);
}

/// Up to this fuzz a metal counts as a mirror, and lights are not sampled on it: directions in float are too coarse for
/// so narrow a lobe.
inline constexpr float min_sampled_fuzz = 1e-3f;

/// Probability density, per steradian, of scattering into a unit direction above the surface; 0 below it and for a
/// mirror. The random points fill a ball of radius fuzz around the tip of the mirror direction, with the uniform
/// density 3 / (4π fuzz³). A ray from the origin at the angle β from the mirror direction is in this ball at distances
/// from s- to s+, which are cos β ± h with h² = fuzz² - sin² β. The density of the direction is the integral over r² dr
/// there.
template <class F>
TYNDALL_INLINE F pdf(const Metal<F>& metal, const Incident<F>& in, Vec3<F> direction) {
  const Vec3<F> mirror = reflect(in.direction, in.normal);
  const F cosine = dot(mirror, direction);
  const Vec3<F> across = point_at(direction, -cosine, mirror);
  const F fuzz2 = metal.fuzz * metal.fuzz;
  const F h2 = fuzz2 - dot(across, across);  // sin² from the part across: exact for small angles
  const F h = sqrt(max(h2, F(0.0f)));
  // s+³ - s-³ = 2h (3 cos² + h²) where both ends are in front; at fuzz 1 the near end is the centre itself.
  const F middle = max(cosine, F(0.0f));
  const F volume = F(2.0f) * h * mul_add(F(3.0f) * middle, middle, h * h);
  const auto inside = mask_and(mask_and(less(F(0.0f), h2), less(F(0.0f), dot(direction, in.facing))),
                               less(F(min_sampled_fuzz), metal.fuzz));
  const F scale = F(static_cast<float>(0.25 / pi)) / max(fuzz2 * metal.fuzz, F(1e-30f));
  return select(mask_and(inside, less(F(0.0f), cosine)), volume * scale, F(0.0f));
}

/// The unit mirror direction plus fuzz times a random point of the unit ball; what ends below the surface is absorbed.
/// Ray Tracing in One Weekend, section 10.6 "Fuzzy Reflection", takes points on the sphere; with points in the ball the
/// density of directions stays bounded.
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const Metal<F>& metal, const Incident<F>& in) {
  const Vec3<F> mirror = reflect(in.direction, in.normal);
  const F radius = metal.fuzz * cube_root(in.sampler.next_1d(dimension::radius));
  const Vec3<F> sum = point_at(mirror, radius, in.unit_vector);
  const F squared = dot(sum, sum);
  const auto cancelled = less(squared, F(1e-12f));
  const F scale = F(1.0f) / sqrt(select(cancelled, F(1.0f), squared));
  const Vec3<F> out = select(cancelled, in.facing, scale * sum);
  return {out,
          F(1.0f),
          select(less(F(min_sampled_fuzz), metal.fuzz), pdf(metal, in, out), F(one_direction)),
          {less_equal(dot(out, in.facing), F(0.0f)), less(F(1.0f), F(0.0f))}};
}

}  // namespace tyndall
