#pragma once
#include "core/compile/flatten.h"

#include <array>
#include <initializer_list>
#include <vector>

/// Whether things meet: whether something reaches into a sphere, over the whole time from 0 to 1; and whether boxes and
/// flats meet or coincide.
namespace tyndall {

/// A sphere in world space that moves from `center` by `motion`.
struct RoundBody {
  Vec3d center, motion;
  double radius = 1;  ///< > 0
};
RoundBody round_body(const Sphere<>& sphere, const Placement& placement);

/// Whether a surface other than the shapes in `own` (indices into Flattened::shapes), or a medium, is in `body` or
/// reaches into it. Touching by less than a millionth of its radius does not count; where something moves past a flat,
/// the answer may be yes too often, never no.
bool is_overlapped(const Flattened& flat, const RoundBody& body, std::initializer_list<std::size_t> own);

/// Distance from a point to the nearest point of the parallelogram with the edges u and v from `corner`.
double distance_to_flat(Vec3d point, Vec3d corner, Vec3d u, Vec3d v);

/// A box of any directions, or a parallelogram: all middle + a edge[0] + b edge[1] + c edge[2] for a, b, c in [-1, 1].
struct Block {
  Vec3d middle;
  std::array<Vec3d, 3> edge;
};

Block block_of(const Box<>& box, const Placement& placement);

/// Whether two blocks have no point in common.
bool are_apart(const Block& a, const Block& b);

/// A parallelogram of a scene: a quad, or a face of a box. Its edge[2] is 0.
struct Flat {
  std::size_t shape;  ///< index into Flattened::shapes
  Block block;
  double radius;  ///< of a sphere around its middle that holds it
};
std::vector<Flat> list_flats(const Flattened& flat);

/// Whether another flat lies in the plane of a parallelogram and covers some of it. Which of the two a ray meets is
/// decided by rounding. shape: to which it belongs.
bool is_covered(const Block& parallelogram, std::size_t shape, const std::vector<Flat>& flats);

}  // namespace tyndall
