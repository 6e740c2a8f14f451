#pragma once
#include "core/compile/flatten.h"
#include "core/compile/render_scene.h"

/// The second half of compiling: converts each part of the scene to columns of floats.
namespace tyndall {

/// Of the whole lens, scene units; 0: a pinhole.
double lens_radius(const Camera& camera);
/// Fills in all but the surface on which the camera stands: see surroundings.h.
CameraColumns camera_columns(const Camera& camera, int width, int height, Vec3d origin);
BackgroundColumns background_columns(const Background& background);
/// The columns of a picture of the sky. They are empty for other backgrounds. before: those of an earlier scene, whose
/// distribution is taken over if the picture is the same; or null. is_sampled: the integrator samples lights.
SkyColumns sky_columns(const Background& background, bool is_sampled, const SkyColumns* before);
Materials material_columns(const std::vector<Material>& materials);
Column<TextureColumns> texture_columns(const std::vector<Texture>& textures, Vec3d origin);
/// 256 unit vectors for gradient noise, 3 floats each: the project's fixed table.
Column<float> gradient_table();

/// For a point p = corner + a u + b v: a and b are the dot products of p - corner with the members a and b.
struct Reciprocal {
  Vec3d a, b;
};
Reciprocal reciprocal_edges(Vec3d u, Vec3d v);

/// A quad, triangle or box as an affine map (see Affine). That of a triangle is that of its frame, but row 2 is the
/// distance from its plane over how far rounding moves a hit in rows 0 and 1, for each unit of the coordinates.
Affine quad_map(const Quad<>& quad, const Placement& placement, Vec3d origin);
Affine triangle_map(const Triangle<>& triangle, const Placement& placement, Vec3d origin);
/// With the size that rays need.
Outline outline_in_scene(const Triangle<>& triangle, const Placement& placement, Vec3d origin);
Affine box_map(const Box<>& box, const Placement& placement, Vec3d origin);

/// Face 0 … 5 of a box (x-, x+, y-, y+, z-, z+), in the box's own frame. Its u × v is along the outward normal.
struct BoxFace {
  Vec3d normal, corner, u, v;
};
BoxFace box_face_edges(const Box<>& box, std::int32_t face);

/// The columns of elements to be filled beside those that every scene needs.
struct MoreColumns {
  bool uv = false;      ///< for image textures
  bool motion = false;  ///< for moving spheres
  bool plane = false;   ///< for textures of any kind
  bool disk = false;    ///< for image textures, in scenes with disks
};

/// Appends an element for each sphere, flat shape or box face. checker: the shape's texture; null: it has another or
/// none.
void append_elements(const PlacedShape& shape, Vec3d origin, const MoreColumns& more, const Checker<>* checker,
                     Elements& elements);

}  // namespace tyndall
