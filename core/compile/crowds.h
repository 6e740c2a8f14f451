#pragma once
#include "core/compile/flatten.h"

#include <initializer_list>

/// Whether something reaches into a sphere, over the whole time from 0 to 1.
namespace tyndall {

/// A sphere in world space that moves from `center` by `way`.
struct RoundBody {
  Vec3d center, way;
  double radius = 1;  ///< > 0
};
RoundBody round_body(const Sphere<>& sphere, const Placement& placement);

/// Whether a surface other than the shapes in `own` (indices into Flattened::shapes), or a medium, is in `body` or
/// reaches into it. Touching by less than a millionth of its radius does not count; where something moves past a flat,
/// the answer may be yes too often, never no.
bool is_crowded(const Flattened& flat, const RoundBody& body, std::initializer_list<std::size_t> own);

/// Distance from a point to the nearest point of the parallelogram with the edges u and v from `corner`.
double distance_to_flat(Vec3d point, Vec3d corner, Vec3d u, Vec3d v);

}  // namespace tyndall
