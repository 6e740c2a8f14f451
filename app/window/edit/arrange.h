#pragma once
#include "app/window/edit/drag_rounding.h"
#include "app/window/tools/selection.h"

/// Moving and turning objects.
namespace tyndall {

/// The transform of an object that moving and turning it changes: its own, or a medium's boundary's where its own has
/// nothing.
Transform& own_transform(Object& object);
const Transform& own_transform(const Object& object);

/// The numbers that moving an object changes: the shift at the end of its transform, else the shape's own place (the
/// centre of a sphere, the corner of a quad, the lower corner of a box). In the frame of the groups around it.
Vec3d anchor_of(const Scene& scene, const ObjectPath& path);
/// Sets these numbers; what else the shape holds goes along.
void set_anchor(Scene& scene, const ObjectPath& path, Vec3d anchor);

/// Where the frame of the groups around an object is in the world.
Placement outer_placement(const Scene& scene, const ObjectPath& path);

/// Turns an object about the vertical through its middle, by degrees in the sense of "rotate_y". A shape without a
/// transform is put around the origin first, so that its transform holds its place and its angle.
void rotate_object(Scene& scene, const ObjectPath& path, double degrees);
/// Its present angle, degrees, without that of the groups around it.
double angle_of(const Scene& scene, const ObjectPath& path);

/// The middle of an object in the world; of an empty group its origin.
Vec3d middle_of(const Scene& scene, const ObjectPath& path);

}  // namespace tyndall
