#pragma once
#include "core/base/fields.h"
#include "core/materials/bsdf.h"

#include <tuple>

/// Matt surfaces: how they scatter light.
namespace tyndall {

/// A matt surface: sends light into all directions of its side with density cos θ / π, from wherever it comes.
template <class F = double>
struct Lambertian {
  static constexpr const char* type = "lambertian";
  static constexpr const char* about = "Matt: scatters with the cosine, the same in all directions of view.";
  static constexpr const char* colour_name = "albedo";
  static constexpr BsdfTraits traits{.diffuse = true, .constant_weight = true, .light_sampling = LightSampling::always};
  bool operator==(const Lambertian&) const = default;
};

template <class F>
constexpr auto fields(const Lambertian<F>*) {
  return std::tuple{};
}

/// The direction of the normal plus a random unit vector, which has density cos θ / π. Where they nearly cancel, to a
/// length below 1e-3 (once in four million times), rounding could lead below the surface: then the normal is taken.
/// Ray Tracing in One Weekend, section 9.4 "True Lambertian Reflection".
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const Lambertian<F>&, const Incident<F>& in) {
  const Vec3<F> sum = in.facing + in.unit_vector;
  const F squared = dot(sum, sum);
  const auto cancelled = less(squared, F(1e-6f));
  const F scale = F(1.0f) / sqrt(select(cancelled, F(1.0f), squared));
  const MaskOf<F> none = less(F(1.0f), F(0.0f));
  const Vec3<F> out = select(cancelled, in.facing, scale * sum);
  return {out, F(1.0f), diffuse_pdf(in, out), {none, none}};
}

}  // namespace tyndall
