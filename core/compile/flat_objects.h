#pragma once
#include "core/compile/overlap.h"
#include "core/compile/render_scene.h"

#include <optional>
#include <vector>

/// Flat objects as parts of exact specular paths, beside spheres: mirrors, and slabs, which are boxes of glass.
namespace tyndall {

/// A quad, or a face of a box, of metal without fuzz.
struct FlatMirror {
  std::size_t shape;  ///< index into Flattened::shapes
  int face = 0;       ///< of a box
  Vec3d middle;       ///< world space
  Vec3d u, v;         ///< half edges
  Vec3d normal;       ///< unit; out of a box
  double depth = 0;   ///< of the box behind the face; 0: a quad
};
/// Returns the mirrors that no other flat covers, even in part. flats: all flats of the scene.
std::vector<FlatMirror> list_flat_mirrors(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene);

/// A sphere that holds a light, in world space.
struct LightBounds {
  Vec3d center;
  double reach;  ///< radius
  double power;  ///< of the light
};
LightBounds light_bounds(const RenderScene& scene, std::size_t light);

/// Returns the worth of a pair of a mirror and a light, >= 0, roughly the power that the light sends to the mirror:
/// pairs are chosen by it. 0: no light arrives, or the light is so large that BSDF sampling finds it well enough.
double worth_of(const FlatMirror& mirror, const LightBounds& light);

/// A diffuse surface or a medium, on which the light of specular paths shows.
struct Receiver {
  Extent extent;
  std::optional<Vec3d> normal;  ///< unit; of a quad, triangle or disk
};
std::vector<Receiver> list_receivers(const Flattened& flat, const Scene& scene);

/// Whether a light may reach a receiver by way of the mirror. May wrongly be true, never wrongly false.
bool may_light(const FlatMirror& mirror, const LightBounds& light, const std::vector<Receiver>& receivers);

FlatRecord record_of(const FlatMirror& mirror, Vec3d origin);

/// A box of glass, in world space.
struct Slab {
  std::size_t shape;  ///< index into Flattened::shapes
  Vec3d middle;
  Vec3d edge[3];              ///< unit
  double half[3] = {};        ///< half lengths of the edges
  double index = 1.5;         ///< of refraction
  double medium_density = 0;  ///< density within
  int closed = 0;             ///< see FlatRecord
};

/// The least refractive index at which light that enters a box by one face cannot leave by a face at right angles to
/// it: a little above the square root of 2.
inline constexpr double min_slab_index = 1.4143;

/// Returns all slabs. Left out are boxes of a lower index, and boxes into which a surface or the boundary of a medium
/// reaches. flats: all flats of the scene.
std::vector<Slab> list_slabs(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene);

/// Returns the worth of a pair of a slab and a light, as for mirrors.
double worth_of(const Slab& slab, const LightBounds& light);

FlatRecord record_of(const Slab& slab, Vec3d origin);

}  // namespace tyndall
