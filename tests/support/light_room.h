#pragma once
#include "core/compile/flatten.h"
#include "tests/support/light_draws.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// A scene as a second, simple tracer sees it. It computes in double and uses none of the kernels' code, so that it
/// does not repeat their faults. Made for scenes whose lengths are around 1; it tests every surface, without a tree.
namespace tyndall::test {

/// A sphere, or a parallelogram: a box is six of them.
struct RoomSurface {
  bool round = false;
  Vec3d center, motion;    ///< spheres: at time 0, and from there to time 1
  double radius = 0;       ///< spheres; below 0: the normal points inward
  Vec3d corner, u, v;      ///< parallelograms
  Vec3d normal;            ///< parallelograms: unit, outward
  Vec3d along_u, along_v;  ///< parallelograms: dot products with point - corner give the place in [0, 1]
  Placement placement;     ///< spheres: turns textures
  int material = 0;
  double area() const;
  Vec3d center_at(double time) const { return center + time * motion; }
};

struct RoomHit {
  double t = 1e300;
  int surface = -1;
  Vec3d normal;  ///< unit, outward
};

class LightRoom {
 public:
  /// Throws std::invalid_argument for what is not covered: a lens, Schlick's rule, a background that is not black,
  /// lights whose colour is noise, an image on a box.
  explicit LightRoom(const Scene& scene);

  /// The closest surface before `limit`. last: the surface that the ray starts on, or -1.
  RoomHit closest(Vec3d origin, Vec3d direction, double time, int last, double limit = 1e300) const;
  /// Fraction of light that passes all media up to a distance.
  double transmittance(Vec3d origin, Vec3d direction, double distance) const;
  /// The medium that scatters first before `limit`, or -1; then its distance is put into `limit`.
  int fly(Vec3d origin, Vec3d direction, double& limit, SplitMix& random) const;
  /// A surface's colour at a point.
  Vec3d colour(const RoomSurface& surface, Vec3d point, double time) const;
  Vec3d colour(const PlacedVolume& volume, Vec3d point) const;
  const MaterialKinds<double>& kind(const RoomSurface& surface) const {
    return scene_.materials[static_cast<std::size_t>(surface.material)].kind;
  }
  /// Whether light goes on in one direction alone: glass, and metal without fuzz.
  bool is_smooth(const RoomSurface& surface) const;

  std::vector<RoomSurface> surfaces;
  std::vector<int> lamps;  ///< surfaces
  std::vector<int> balls;  ///< surfaces: spheres that bend or mirror
  std::vector<PlacedVolume> media;

 private:
  void add(const PlacedShape& placed);
  void add_flat(const PlacedShape& placed, Vec3d corner, Vec3d u, Vec3d v);
  Scene scene_;
};

}  // namespace tyndall::test
