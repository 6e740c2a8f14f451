#pragma once
#include "core/base/math.h"
#include "core/base/ray.h"

/// What every material answers for light that meets its surface: its BSDF (bidirectional scattering distribution
/// function). M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, chapter 9 "Reflection Models".
///
/// A material M has M::traits and three functions over a number type F, in each of which the colour of the material is
/// left out, because the kernel multiplies by it:
///
///   BsdfSample<F> sample(const M&, const Incident<F>&)              draws the direction in which a path goes on
///   F pdf(const M&, const Incident<F>&, Vec3<F> direction)          probability density of that draw, per steradian
///   F eval(const M&, const Incident<F>&, Vec3<F> direction)         f |cos|: radiance out over irradiance in
///
/// with weight = eval / pdf wherever pdf > 0. Paths run from the camera to the light, so `incident.direction` points
/// along the path and `direction` towards the light. What passes into a medium of another index is not multiplied by
/// the square of the ratio of the indices (basic radiance, which is the same on both sides of a boundary).
namespace tyndall {

/// Whether shadow rays are sent to lights from where a material scatters. never: it sends light into single directions
/// only, like mirrors and glass. always. weighted: only with integrator mis, because the lobe may be so narrow that
/// directions to lights almost never fall into it, and without weights the few that do would be bright dots.
enum class LightSampling { never, weighted, always };

/// What is true of every material of a type. The compiler knows it, so what a trait decides costs no time.
struct BsdfTraits {
  bool diffuse = false;          ///< f = colour / pi above the surface: diffuse_pdf(), seen alike from all directions
  bool glossy = false;           ///< a lobe about the mirror direction, as wide as lobe_width() says
  bool specular = false;         ///< single directions only: eval() and pdf() are 0
  bool transmissive = false;     ///< light may leave on the other side of the surface
  bool smooth_boundary = false;  ///< has boundary_at() and refractive_index: exact specular paths go through it
  bool emits = false;            ///< its colour is the radiance that it sends from both sides; it scatters nothing
  bool constant_weight = false;  ///< the weight of each sample is 1 or 0 (absorbed): eval() is pdf()
  LightSampling light_sampling = LightSampling::never;
};

/// A ray that meets a surface: what a material is told in order to scatter it.
template <class F>
struct Incident {
  Vec3<F> direction;    ///< unit, towards the surface
  Vec3<F> normal;       ///< unit, the surface's own (reversed for a negative radius)
  Vec3<F> facing;       ///< the normal, turned against the direction
  F cosine;             ///< between facing and the reversed direction, in [0, 1]
  MaskOf<F> exiting;    ///< the direction is on the normal's side: the ray leaves what the surface encloses
  Vec3<F> unit_vector;  ///< uniform on the unit sphere, from the event's direction dimensions
  bool schlick;         ///< use the books' approximation of Fresnel's equations
  Sampler<F> sampler;   ///< a copy, because compilers keep a path in memory whose members are pointed to
};

/// Marks a direction that light sampling cannot choose: a mirror's, glass's, the camera's.
inline constexpr float one_direction = -1.0f;

template <class F>
struct BsdfFlags {
  MaskOf<F> absorbed;     ///< nothing leaves
  MaskOf<F> transmitted;  ///< the direction is on the other side of the surface
};

/// A direction in which light leaves a surface, drawn at random.
template <class F>
struct BsdfSample {
  Vec3<F> direction;  ///< unit
  F weight;           ///< eval / pdf, >= 0; does not count where `absorbed`
  F pdf;              ///< per steradian; one_direction: it was the only possible direction, or one of two
  BsdfFlags<F> flags;
};

/// Density of cosine-weighted directions, per steradian: cos / pi, 0 below the surface. Times the albedo it is the
/// reflected share.
template <class F>
TYNDALL_INLINE F diffuse_pdf(const Incident<F>& in, Vec3<F> direction) {
  return max(dot(direction, in.facing), F(0.0f)) * F(static_cast<float>(1 / pi));
}

/// What the traits of a material say of its pdf() and its eval().
template <class M, class F>
requires(M::traits.diffuse) TYNDALL_INLINE F pdf(const M&, const Incident<F>& in, Vec3<F> direction) {
  return diffuse_pdf(in, direction);
}
template <class M, class F>
requires(M::traits.specular || M::traits.emits) TYNDALL_INLINE F pdf(const M&, const Incident<F>&, Vec3<F>) {
  return F(0.0f);
}
template <class M, class F>
requires(M::traits.constant_weight) TYNDALL_INLINE F eval(const M& m, const Incident<F>& in, Vec3<F> direction) {
  return pdf(m, in, direction);
}

/// By how much directions deviate from those of a mirror or of smooth glass, roughly, in radians: 0 for single
/// directions, 1 for all.
template <class M>
requires(!M::traits.glossy) constexpr double lobe_width(const M&) { return M::traits.specular ? 0 : 1; }

}  // namespace tyndall
