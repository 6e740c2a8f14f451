#pragma once
#include "core/base/fields.h"
#include "core/materials/bsdf.h"

#include <tuple>

/// Glass and water: what users set, and how light is reflected and refracted.
namespace tyndall {

/// Smooth, clear glass or water: reflects or refracts, never absorbs. Unpolarised light.
template <class F = double>
struct Dielectric {
  static constexpr const char* type = "dielectric";
  static constexpr const char* about = "Smooth, clear glass or water: reflects or refracts, never absorbs.";
  static constexpr const char* colour_name = nullptr;
  static constexpr BsdfTraits traits{
      .specular = true, .transmissive = true, .smooth_boundary = true, .constant_weight = true};
  F refractive_index = F(1.5);
  bool operator==(const Dielectric&) const = default;
};

template <class F>
constexpr auto fields(const Dielectric<F>*) {
  return std::tuple{Field{"refractive_index", &Dielectric<F>::refractive_index, above(0), Slider{0.5, 3}, "",
                          "inside over outside; below 1 for a bubble", true}
                        .also("ior, index of refraction, refraction, eta")};
}

/// Snell's law at one boundary: eta times the cosine of the refracted direction, sqrt(cos_in² + eta² - 1); 0 at total
/// reflection. cos_in: between the ray and the normal on its own side, in [0, 1]. eta: index of the far side over that
/// of the near side. With eta = 1 the result is cos_in to the last bit, so that matched glass is invisible.
template <class F>
TYNDALL_INLINE F refracted_cosine(F cos_in, F eta) {
  const F root = sqrt(max(mul_add(eta - F(1.0f), eta + F(1.0f), cos_in * cos_in), F(0.0f)));
  return select(equal(eta, F(1.0f)), cos_in, root);
}

/// Reflected fraction of unpolarised light at a smooth boundary, in [0, 1].
/// cos_in, eta: as above; scaled_cos_out: refracted_cosine(cos_in, eta), 0 gives 1 (total reflection).
/// Fresnel's equations: Born & Wolf, Principles of Optics, section 1.5.2.
template <class F>
TYNDALL_INLINE F fresnel(F cos_in, F eta, F scaled_cos_out) {
  const F tiny = F(1e-30f);
  const F s = (cos_in - scaled_cos_out) / max(cos_in + scaled_cos_out, tiny);
  const F e2 = eta * eta;
  const F p = mul_add(e2, cos_in, -scaled_cos_out) / max(mul_add(e2, cos_in, scaled_cos_out), tiny);
  const F reflectance = F(0.5f) * mul_add(s, s, p * p);
  return select(less_equal(mul_add(eta - F(1.0f), eta + F(1.0f), cos_in * cos_in), F(0.0f)),
                select(equal(eta, F(1.0f)), reflectance, F(1.0f)), reflectance);
}
template <class F>
TYNDALL_INLINE F fresnel(F cos_in, F eta) {
  return fresnel(cos_in, eta, refracted_cosine(cos_in, eta));
}

/// The books' approximation of fresnel(), kept for comparison: r0 + (1 - r0)(1 - cos_in)^5, and total reflection as in
/// the books. They take the cosine on the ray's own side also inside the glass, where the result is wrong by up to
/// 0.93. Ray Tracing in One Weekend, section 11.4 "Schlick Approximation".
template <class F>
TYNDALL_INLINE F schlick(F cos_in, F eta) {
  const F root = (F(1.0f) - eta) / (F(1.0f) + eta);
  const F r0 = root * root;
  const F m = F(1.0f) - cos_in;
  const F m2 = m * m;
  const F reflectance = mul_add(F(1.0f) - r0, m2 * m2 * m, r0);
  const auto total = less(mul_add(eta - F(1.0f), eta + F(1.0f), cos_in * cos_in), F(0.0f));
  return select(total, F(1.0f), reflectance);
}

/// A smooth boundary where a ray meets it.
template <class F>
struct Boundary {
  F eta;             ///< refractive index of the far side over that of the near side
  F scaled_cos_out;  ///< refracted_cosine()
  F reflected;       ///< fraction of the light that is reflected
};

template <class F>
TYNDALL_INLINE Boundary<F> boundary_at(const Dielectric<F>& glass, const Incident<F>& in) {
  const F eta = select(in.exiting, F(1.0f) / glass.refractive_index, glass.refractive_index);
  const F g = refracted_cosine(in.cosine, eta);
  return {eta, g, in.schlick ? schlick(in.cosine, eta) : fresnel(in.cosine, eta, g)};
}

/// What leaves a boundary that reflects in some lanes and refracts in the others.
/// The direction by Snell's law in vector form: (d + (cos_in - n cos_out) n) / eta.
template <class F>
TYNDALL_INLINE BsdfSample<F> leave_boundary(const Boundary<F>& b, const Incident<F>& in, MaskOf<F> reflects) {
  const Vec3<F> bent = point_at(in.direction, in.cosine - b.scaled_cos_out, in.facing);
  const F scale = select(equal(b.eta, F(1.0f)), F(1.0f), F(1.0f) / sqrt(max(dot(bent, bent), F(1e-30f))));
  return {select(reflects, reflect(in.direction, in.normal), scale * bent),
          F(1.0f),
          F(one_direction),
          {less(F(1.0f), F(0.0f)), mask_not(reflects)}};
}

/// Reflects with the probability of the reflected share, else refracts.
template <class F>
TYNDALL_INLINE BsdfSample<F> sample(const Dielectric<F>& glass, const Incident<F>& in) {
  const Boundary<F> b = boundary_at(glass, in);
  return leave_boundary(b, in, less(in.sampler.next_1d(dimension::lobe), b.reflected));
}

}  // namespace tyndall
