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
/// Those of a picture of the sky, as kernels read it and sample it as a light; empty for other backgrounds. before:
/// those of an earlier scene, whose distribution is taken over if the picture is the same; or null. is_sampled: the
/// integrator samples lights.
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

/// A quad itself, or the parallelogram around a triangle or disk, in the shape's own frame; nothing for other shapes.
std::optional<Quad<>> frame_of_flat(const PlacedShape& shape);

/// Face 0 … 5 of a box (x-, x+, y-, y+, z-, z+), in the box's own frame. Its u × v is along the outward normal.
struct BoxFace {
  Vec3d normal, corner, u, v;
};
BoxFace box_face_edges(const Box<>& box, std::int32_t face);

/// Calls visit(face, i) for each face i of a box, or with 0 for the frame of a flat shape; in world space.
template <class Visit>
void each_face(const PlacedShape& shape, const Visit& visit) {
  const Placement& at = shape.placement;
  if (const std::optional<Quad<>> quad = frame_of_flat(shape)) {
    const Vec3d u = rotate(at, quad->u), v = rotate(at, quad->v);
    visit(BoxFace{normalize(cross(u, v)), place(at, quad->corner), u, v}, 0);
  }
  const auto* box = std::get_if<Box<>>(&shape.shape);
  for (std::int32_t i = 0; box && i < 6; ++i) {
    const BoxFace own = box_face_edges(*box, i);
    visit(BoxFace{rotate(at, own.normal), place(at, own.corner), rotate(at, own.u), rotate(at, own.v)}, i);
  }
}

/// Appends an element for each sphere, flat shape or box face, to the columns that the features need. checker: the
/// shape's texture; null: it has another or none.
void append_elements(const PlacedShape& shape, Vec3d origin, const SceneFeatures& features, const Checker<>* checker,
                     Elements& elements);

/// Collects the emitting primitives of a scene and enters them into elements.light. first_element: for each shape of
/// `flat` the number of its first element. Lights of power 0 are left out: rays meet them as black surfaces.
Lights collect_lights(const Scene& scene, const Flattened& flat, const std::vector<std::int32_t>& first_element,
                      Vec3d origin, Elements& elements);

/// The largest component of a light's radiance, 1 if that is a texture; 0: the material does not shine.
double brightness_of(const Material& material);

/// Fills `tree` from center, power and reach2 if there are more than max_lights_by_contribution lights. Each range is
/// split where the sum over both sides of power times squared extent is smallest. After A. Conty Estevez, C. Kulla,
/// Importance Sampling of Many Lights with Adaptive Tree Splitting, PACMCGIT 1(2), 2018; lights here emit to all sides.
void build_light_tree(Lights& lights);

/// Returns the pairs of a medium and a light for which distances along a ray are sampled by the angle under which the
/// light sees them (equiangular sampling, see core/trace/flight.h), because the glow around the light is so bright.
///
/// The conditions were found by measuring: where they hold, the same error takes 1.5 to 16 times less time; where they
/// do not, it could take twice as long. The medium scatters, and its half width is at most 4 mean free paths; the
/// centre of the light is at most 1.5 half widths from the medium's centre; the radius of the light is at most a tenth
/// of the medium's half width and of the light's distance to the camera.
NearLights find_near_lights(const RenderScene& scene);

}  // namespace tyndall
