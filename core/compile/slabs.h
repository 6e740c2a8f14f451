#pragma once
#include "core/compile/overlap.h"
#include "core/compile/render_scene.h"

#include <vector>

/// Slabs: boxes of glass through which specular paths are solved exactly.
namespace tyndall {

/// A box of glass, in world space.
struct Slab {
  std::size_t shape;  ///< index into Flattened::shapes
  Vec3d middle;
  Vec3d edge[3];              ///< unit
  double half[3] = {};        ///< half lengths of the edges
  double index = 1.5;         ///< of refraction
  double medium_density = 0;  ///< density within
  int closed = 0;             ///< see SlabNumber
};

/// The least refractive index at which light that enters a box by one face cannot leave by a face at right angles to
/// it: a little above the square root of 2.
inline constexpr double min_slab_index = 1.4143;

/// Returns all slabs. Left out are boxes of a lower index, and boxes into which a surface or the boundary of a medium
/// reaches. flats: all flats of the scene.
std::vector<Slab> list_slabs(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene);

/// Returns the worth of a pair of a slab and a light, >= 0, roughly the power that the light sends to the slab: pairs
/// are chosen by it. 0: the light is so large that BSDF sampling finds it well enough.
double worth_of(const Slab& slab, const Lights& lights, std::size_t light, Vec3d origin);

/// Appends its numbers; see SlabNumber.
void append_numbers(const Slab& slab, Vec3d origin, std::vector<float>& numbers);

}  // namespace tyndall
