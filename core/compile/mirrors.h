#pragma once
#include "core/compile/overlap.h"
#include "core/compile/render_scene.h"

#include <vector>

/// Flat mirrors: what light takes exact specular paths off, beside spheres.
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
/// Those that no other flat covers, even in part. flats: of the scene.
std::vector<FlatMirror> list_flat_mirrors(const Flattened& flat, const std::vector<Flat>& flats, const Scene& scene);

/// What scatters light evenly, so that the light of specular paths shows on it.
struct Receiver {
  Extent extent;
  bool is_quad = false;
  Vec3d normal;  ///< of a quad
};
std::vector<Receiver> list_receivers(const Flattened& flat, const Scene& scene);

/// What a light sends to a mirror, as a measure for choosing. 0: nothing, or nothing that goes on to a receiver, or the
/// light is so large that chance finds it well enough.
double worth_of(const FlatMirror& mirror, const Lights& lights, std::size_t light, Vec3d origin,
                const std::vector<Receiver>& receivers);

/// Appends its numbers; see MirrorNumber.
void append_numbers(const FlatMirror& mirror, Vec3d origin, std::vector<float>& numbers);

}  // namespace tyndall
