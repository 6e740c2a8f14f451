#pragma once
#include "core/base/fields.h"
#include "core/base/ray.h"
#include "core/base/sampling.h"

#include <tuple>

/// Media and other media: what users set, how far light flies in them, and how they scatter it.
namespace tyndall {

/// Media, media or milk, the same everywhere inside its boundary. Its boundary and its colour (the scattering albedo)
/// are members of the scene's Volume.
template <class F = double>
struct Medium {
  static constexpr const char* type = "medium";
  static constexpr const char* about =
      "Homogeneous fog, smoke or coloured glass: it fills its boundary, whatever lies inside. Overlapping media "
      "add. A boundary equal to an object's shape makes the medium that object's interior.";
  F density = F(1);
  F g = F(0);
  bool operator==(const Medium&) const = default;
};

template <class F>
constexpr auto fields(const Medium<F>*) {
  return std::tuple{Field{"density", &Medium<F>::density, at_least(0), Slider{0.001, 100, true}, "",
                          "mean number of scattering or absorption events per unit length", true}
                        .also("fog density, extinction, opacity, absorption, thickness"),
                    Field{"g", &Medium<F>::g, inside(-1, 1), Slider{-0.95, 0.95}, "",
                          "mean cosine of the scattering angle (Henyey-Greenstein); 0 scatters evenly"}
                        .called("Asymmetry g")
                        .also("g, anisotropy, anisotropic, phase function, henyey-greenstein, forward scattering")};
}

/// Distance to the next event in a medium of the given density (> 0), for a random number u in (0, 1]. Distances are
/// distributed exponentially.
template <class F>
TYNDALL_INLINE F free_flight(F density, F u) {
  return -log(u) / density;
}

/// Fraction of light that passes an optical depth (density times length, >= 0): Beer and Lambert's law.
template <class F>
TYNDALL_INLINE F transmittance(F optical_depth) {
  return exp(-optical_depth);
}

/// Cosine of the scattering angle for a random number u in [0, 1), by the inverse of the distribution of Henyey &
/// Greenstein, Diffuse Radiation in the Galaxy, Astrophysical Journal 93 (1941). For small g the fraction is
/// rearranged, because the plain form divides a difference that cancels by g.
template <class F>
TYNDALL_INLINE F henyey_greenstein_cosine(F g, F u) {
  const F s = mul_add(F(2.0f), u, F(-1.0f));
  const F q = mul_add(g, s, F(1.0f));  // 1 + g s
  const F g2 = g * g, s2 = s * s;
  // [2s(1+g²) + g(3+s²) + g³(s²-1)] / (2(1+gs)²): the same function without the division by g.
  const F even = mul_add(F(2.0f) * s, F(1.0f) + g2, g * mul_add(g2, s2 - F(1.0f), F(3.0f) + s2)) / (F(2.0f) * q * q);
  const F r = (F(1.0f) - g2) / q;
  const F plain = (F(1.0f) + g2 - r * r) / (F(2.0f) * select(equal(g, F(0.0f)), F(1.0f), g));
  const F cosine = select(less(abs(g), F(0.5f)), even, plain);
  return min(max(cosine, F(-1.0f)), F(1.0f));
}

/// Probability density per steradian of the phase function at a cosine between the directions before and after.
template <class F>
TYNDALL_INLINE F henyey_greenstein_pdf(F g, F cosine) {
  const F d = F(1.0f) + g * g - F(2.0f) * g * cosine;
  return F(static_cast<float>(0.25 / pi)) * (F(1.0f) - g * g) / (d * sqrt(d));
}

/// New direction after scattering. unit_vector: a random direction, which is the result where g is 0. u in [0, 1)².
template <class F>
TYNDALL_INLINE Vec3<F> scatter_in_medium(F g, Vec3<F> direction, Vec3<F> unit_vector, Pair<F> u) {
  const auto even = equal(g, F(0.0f));
  if (all(even)) return unit_vector;
  return select(even, unit_vector, around(direction, henyey_greenstein_cosine(g, u.x), u.y));
}

}  // namespace tyndall
