#pragma once
#include "core/compile/columns.h"

#include <array>
#include <initializer_list>
#include <vector>

/// Tests for overlap: whether a shape or medium reaches into a sphere at any time from 0 to 1, and whether boxes and
/// flats meet or coincide; and how much of a light a sphere sees past the rest of the scene. They take the whole
/// parallelogram around triangles and disks, for which they may wrongly be true.
namespace tyndall {

/// A sphere in world space that moves from `center` to `center + motion` while time runs from 0 to 1.
struct RoundBody {
  Vec3d center, motion;
  double radius = 1;  ///< > 0
};
RoundBody round_body(const Sphere<>& sphere, const Placement& placement);

/// Whether a medium, or a surface of a shape that is not in `own` (indices into Flattened::shapes), is in `body` or
/// reaches into it. An overlap below a millionth of the radius does not count. Where something moves past a flat, or is
/// within the parallelogram around a triangle or disk, the answer may wrongly be true, never wrongly false.
bool is_overlapped(const Flattened& flat, const RoundBody& body, std::initializer_list<std::size_t> own);

/// Distance from a point to the nearest point of the parallelogram with the edges u and v from `corner`.
double distance_to_flat(Vec3d point, Vec3d corner, Vec3d u, Vec3d v);

/// A box of any orientation, or a parallelogram: all points middle + a edge[0] + b edge[1] + c edge[2] for a, b, c in
/// [-1, 1].
struct Block {
  Vec3d middle;
  std::array<Vec3d, 3> edge;
};

Block block_of(const Box<>& box, const Placement& placement);

/// Whether two blocks have no point in common.
bool are_apart(const Block& a, const Block& b);

/// A parallelogram of a scene: a quad, one around a triangle or disk, or a face of a box. Its edge[2] is 0.
struct Flat {
  std::size_t shape;  ///< index into Flattened::shapes
  Block block;
  double radius;  ///< of a sphere around its middle that holds it
};
std::vector<Flat> list_flats(const Flattened& flat);

/// Whether another flat lies in the plane of a parallelogram and covers a part of it, so that rounding decides which of
/// the two a ray hits. shape: index of the shape to which the parallelogram belongs.
bool is_covered(const Block& parallelogram, std::size_t shape, const std::vector<Flat>& flats);

/// For each element, twice the number of the plane in which it lies, plus 1 for the face of a box, where another shape
/// has a flat or face in that plane; else -1. Empty: no two shapes have. Planes that differ by less than a billionth of
/// the scene's size, and directions that differ by less than a billionth, are one.
std::vector<std::int32_t> plane_numbers(const Flattened& flat);

/// The scene with boxes of glass a hair (a 2^-19th of the greatest distance of their corners from `origin`) smaller
/// where a face lies in one plane with another shape's flat or face, so that rays meet the glass before what it stands
/// on, and what it stands on when they have left it. Nothing: there are none.
std::optional<Flattened> set_glass_apart(const Flattened& flat, const std::vector<Material>& materials, Vec3d origin);

/// All surfaces of a scene, which may block a line of sight. Spheres are blocks without edges.
using Obstacles = std::vector<Flat>;
Obstacles list_obstacles(const Flattened& flat);

/// Returns the fraction, in (0, 1], of the lines of sight from a light to a sphere that nothing blocks, estimated from
/// 64 lines. If all 64 are blocked, 1/64, because other lines may be open; 1 if the light is within the sphere. Moving
/// shapes are taken at half time.
///
/// A sphere that holds an end of a line does not block it: for example the light and the sphere themselves. Nor do
/// spheres within the sphere. light: index into `lights`; origin: see RenderScene.
double visible_fraction(const Obstacles& obstacles, const Lights& lights, std::size_t light, Vec3d origin,
                        const RoundBody& sphere);

}  // namespace tyndall
