#pragma once
#include "core/guide/guide_trail.h"
#include "core/specular/specular_trail.h"
#include "core/trace/flight.h"
#include "core/trace/subpixel_lights.h"

/// The state of the paths in a group of lanes.
namespace tyndall {

/// All that a group of paths carries from event to event.
template <class F>
struct Paths {
  Ray<F> ray;
  Vec3<F> throughput, radiance;
  Sampler<F> sampler;
  IntOf<F> depth;  ///< scattering events so far
  F pdf;  ///< of the ray's direction, per steradian; one_direction: light sampling cannot choose this direction
  MediumFlight<F> flight;   ///< the flight to the ray's origin; only in scenes with lights in media
  SpecularTrail<F> trail;   ///< events since it last scattered; only in scenes with specular paths
  GuideTrail<F> guide;      ///< likewise; only in scenes with a guide
  IntOf<F> slot;            ///< 2 · pixel within the tile + half; in kernels that reuse paths an index of ReusedPaths
  F weight;                 ///< of the sample, see subpixel_lights.h; only with has_sample_weights()
  GlassRoute<F> route;      ///< remaining events to a subpixel light; only in scenes with specular paths
  std::uint32_t alive = 0;  ///< bit i: lane i follows a path
  /// Bit i: the path has met only smooth glass and mirrors so far; 0 without lights and without splitting.
  std::uint32_t straight = 0;
  std::uint32_t branch = 0;  ///< bit i: the path is a branch (splitting.h); its sample is counted by another path
  /// Bit i: the path's first, or second, vertex takes part in reuse (reuse.h). 0 in kernels without reuse.
  std::uint32_t first = 0, second = 0;
};

/// Lanes steered to a subpixel light: they were drawn in its box, and have met only smooth glass and mirrors so far.
template <class F>
TYNDALL_INLINE MaskOf<F> seeks_subpixel_light(const Paths<F>& p) {
  return mask_and(p.route.is_set(), mask_from_bits<F>(p.straight));
}

/// `colour`, what a path has gathered or carries, times the weight of its sample (subpixel_lights.h).
template <class F>
TYNDALL_INLINE Vec3<F> weighed(const auto& s, const Paths<F>& p, Vec3<F> colour) {
  return has_sample_weights(s) ? p.weight * colour : colour;
}

/// Returns the lanes in which `part` of the path's state is not finite. Sets their radiance to not a number, so that
/// the film rejects and counts the sample.
template <class F>
TYNDALL_INLINE MaskOf<F> lose(Paths<F>& p, MaskOf<F> lanes, Vec3<F> part) {
  const F sum = F(0.0f) * part.x + F(0.0f) * part.y + F(0.0f) * part.z;  // 0, or not a number
  const auto lost = mask_and_not(lanes, equal(sum, F(0.0f)));
  if (any(lost)) p.radiance = select(lost, Vec3<F>{sum, sum, sum}, p.radiance);
  return lost;
}

}  // namespace tyndall
