#include "app/export/foreign_scene.h"

#include "core/base/error.h"
#include "core/base/kinds.h"
#include "core/base/text.h"
#include "core/compile/columns.h"
#include "core/compile/overlap.h"
#include "core/scene/place.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace tyndall {
namespace {

/// What is refused of one scene for one renderer.
struct Refusal {
  const std::string& scene;
  const ForeignRenderer& renderer;
  [[noreturn]] void operator()(const std::string& where, const std::string& found, const std::string& expected) const {
    throw SceneError(scene, where, found, expected + ": " + renderer.name + " has no equal of that");
  }
};

/// Null: the material has none.
const Texture* texture_of(const Material& material, const Scene& scene) {
  const auto* texture = std::get_if<TextureIndex>(&material.colour);
  return texture ? &scene.textures[static_cast<std::size_t>(texture->index)] : nullptr;
}
bool is_image(const Texture* texture) { return texture && std::holds_alternative<Image>(texture->kind); }

void check_texture(const Texture& texture, const Refusal& refuse) {
  const std::string where = "/textures/" + pointer_step(texture.name) + "/type";
  const bool checker = std::holds_alternative<Checker<>>(texture.kind);
  if (checker && !refuse.renderer.solid_checkers) refuse(where, "a checker pattern in space", "a colour or an image");
  if (is_image(&texture) && !refuse.renderer.images) refuse(where, "an image", "a colour");
  if (!checker && !is_image(&texture) && !std::holds_alternative<Solid<>>(texture.kind))
    refuse(where, in_quotes(std::visit([](const auto& kind) { return kind.type; }, texture.kind)),
           "a colour, a checker or an image");
}

void check_material(const Material& material, const Scene& scene, const Refusal& refuse) {
  const std::string where = "/materials/" + pointer_step(material.name) + "/";
  const Texture* texture = colour_name(material.kind) ? texture_of(material, scene) : nullptr;
  if (texture) check_texture(*texture, refuse);
  if (const auto* metal = std::get_if<Metal<double>>(&material.kind)) {
    if (metal->fuzz > 0) refuse(where + "fuzz", number_text(metal->fuzz), "0");
    if (!refuse.renderer.even_mirrors)
      refuse(where + "type", "a mirror that reflects the same at every angle", "another material");
  }
  if (is_image(texture) && !std::holds_alternative<Lambertian<double>>(material.kind))
    refuse(where + "type", "an image on what is not lambertian", "a colour");
}

ForeignSphere sphere_of(const Sphere<>& sphere, const Placement& placement, const Camera& camera) {
  const Vec3d begin = place(placement, sphere.center),
              end = place(placement, sphere.center_end.value_or(sphere.center));
  ForeignSphere out{begin, end, std::abs(sphere.radius), sphere.radius < 0, placement.degrees};
  if (camera.shutter_open == camera.shutter_close)  // a moment: everything is at rest
    out.center = out.center_end = begin + camera.shutter_open * (end - begin);
  return out;
}

ForeignShape shape_of(const PlacedShape& placed, const Camera& camera) {
  ForeignShape out;
  using enum ForeignFlat::Kind;
  const Placement& at = placed.placement;
  if (const auto* s = std::get_if<Sphere<>>(&placed.shape)) {
    out.sphere = sphere_of(*s, at, camera);
  } else if (const auto* d = std::get_if<Disk<>>(&placed.shape)) {
    out.flats.push_back({disk, place(at, d->center), rotate(at, d->u), rotate(at, d->v), d->inner});
  } else {
    const auto kind = std::holds_alternative<Triangle<>>(placed.shape) ? triangle : quad;
    each_face(placed, [&](const BoxFace& face, int) { out.flats.push_back({kind, face.corner, face.u, face.v}); });
  }
  return out;
}

/// A medium's boundary, or the cube around a sphere.
Block block_around(const PlacedVolume& volume) {
  if (const auto* box = std::get_if<Box<>>(&volume.boundary)) return block_of(*box, volume.placement);
  const Sphere<>& sphere = std::get<Sphere<>>(volume.boundary);
  const double r = std::abs(sphere.radius);
  return {place(volume.placement, sphere.center), {Vec3d{r, 0, 0}, Vec3d{0, r, 0}, Vec3d{0, 0, r}}};
}

bool is_inside(const PlacedVolume& volume, Vec3d point) {
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary))
    return length(point - place(volume.placement, sphere->center)) < std::abs(sphere->radius);
  const Block block = block_around(volume);
  return std::all_of(block.edge.begin(), block.edge.end(),
                     [&](Vec3d edge) { return std::abs(dot(point - block.middle, edge)) < dot(edge, edge); });
}

/// Whether both half axes are as long and at right angles, up to the rounding of what wrote the scene.
bool is_circle(const ForeignFlat& disk) {
  const double a = dot(disk.u, disk.u), b = dot(disk.v, disk.v), small = 1e-6 * std::max(a, b);
  return std::abs(a - b) <= small && std::abs(dot(disk.u, disk.v)) <= small;
}

void check_shape(const ForeignShape& shape, const Scene& scene, const Refusal& refuse) {
  const ForeignRenderer& r = refuse.renderer;
  if (shape.sphere && shape.sphere->moves()) {
    if (!r.moving_spheres) refuse("/camera/shutter", "spheres that move while it is open", "an instant");
    if (shape.shines()) refuse("/objects", "a light that moves", "one at rest");
  }
  for (const ForeignFlat& flat : shape.flats) {
    if (flat.kind != ForeignFlat::Kind::disk) continue;
    if (!r.ellipses && !is_circle(flat)) refuse("/objects", "an ellipse", "a circle");
    if (!r.rings && flat.inner > 0) refuse("/objects", "a ring", "a disk without a hole");
    if (is_image(texture_of(*shape.material, scene))) refuse("/objects", "an image on a disk", "a colour");
  }
}

/// Adds the media; those whose boundary is a surface become its interior.
void add_media(const Scene& scene, const Flattened& flat, const Refusal& refuse, ForeignScene& out) {
  for (const PlacedVolume& volume : flat.volumes) {
    if (!std::holds_alternative<Vec3d>(volume.albedo))
      refuse("/objects", "a texture as the albedo of a medium", "a colour");
    const auto overlaps = [&](const PlacedVolume& o) { return !are_apart(block_around(volume), block_around(o)); };
    if (!refuse.renderer.overlapping_media && std::any_of(out.media.begin(), out.media.end(), overlaps))
      refuse("/objects", "media that may overlap", "media apart from each other");
    const int index = static_cast<int>(out.media.size());
    out.media.push_back(volume);
    if (is_inside(volume, scene.camera.look_from)) out.camera_medium = index;
    if (!volume.surface) {
      const auto boundary = [&](const auto& shape) { return PlacedShape{shape, volume.placement}; };
      out.shapes.push_back(shape_of(std::visit(boundary, volume.boundary), scene.camera));
      out.shapes.back().medium = index;
      continue;
    }
    ForeignShape& shape = out.shapes[static_cast<std::size_t>(*volume.surface)];
    if (!refuse.renderer.media_in_lights && shape.shines())
      refuse("/objects", "a medium within a light", "one within another surface");
    if (shape.sphere && shape.sphere->inward)
      refuse("/objects", "a medium within a sphere of negative radius", "a positive one");
    if (shape.medium >= 0) refuse("/objects", "two media within one surface", "one");
    shape.medium = index;
  }
}

}  // namespace

ForeignScene foreign_scene(const Scene& scene, const std::string& name, const ForeignRenderer& renderer) {
  const Refusal refuse{name, renderer};
  if (scene.render.fresnel != FresnelKind::exact) refuse("/render/fresnel", "\"schlick\"", "\"exact\"");
  if (scene.render.max_depth == 0 && !renderer.depth_zero) refuse("/render/max_depth", "0", "at least 1");
  const Flattened flat = flatten(scene);
  ForeignScene out;
  std::set<const Material*> used;
  for (const PlacedShape& shape : flat.shapes) {
    out.shapes.push_back(shape_of(shape, scene.camera));
    used.insert(out.shapes.back().material = &scene.materials[static_cast<std::size_t>(shape.material)]);
    check_shape(out.shapes.back(), scene, refuse);
  }
  for (const Material* material : used) check_material(*material, scene, refuse);
  add_media(scene, flat, refuse, out);
  return out;
}

std::string numbers_of(Vec3d v, const char* between) {
  return number_text(v.x) + between + number_text(v.y) + between + number_text(v.z);
}

std::optional<Vec3d> plain_colour(const Material& material, const Scene& scene) {
  if (const auto* colour = std::get_if<Vec3d>(&material.colour)) return *colour;
  const auto* solid = std::get_if<Solid<>>(&texture_of(material, scene)->kind);
  return solid ? std::optional(solid->color) : std::nullopt;
}

double focus_of(const Camera& camera) {
  return camera.focus_distance.value_or(length(camera.look_at - camera.look_from));
}

LinearImage picture_of(int width, int height, const std::function<Vec3d(int x, int y)>& colour) {
  LinearImage out{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3f c = to_float(colour(x, y));
      out.rgb.insert(out.rgb.end(), {c.x, c.y, c.z});
    }
  return out;
}

Vec3d texel(const Image::Pixels& pixels, int x, int y) {
  const auto at = pixels.rgb.begin() + 3 * (std::ptrdiff_t{y} * pixels.width + x);
  return to_double({at[0], at[1], at[2]});
}

LinearImage sky_in_rows(const Image::Pixels& sky, int rows, double (*place)(int row, int rows)) {
  return picture_of(std::max(sky.width, 2), rows, [&](int x, int y) {
    const double at = std::clamp(place(y, rows) * sky.height - 0.5, 0.0, sky.height - 1.0);
    const int row = static_cast<int>(at);
    const Vec3d above = texel(sky, x % sky.width, row),
                below = texel(sky, x % sky.width, std::min(row + 1, sky.height - 1));
    return above + (at - row) * (below - above);
  });
}

Vec3d colour_at(const Background& sky, double height) {
  return std::visit(Overloaded{[](const Vec3d& colour) { return colour; }, [](const SkyPicture&) { return Vec3d{}; },
                               [&](const Gradient& g) { return g.bottom + (height + 1) / 2 * (g.top - g.bottom); },
                               [&](const Hemispheres& h) { return height > 0 ? h.up : h.down; }},
                    sky);
}

std::string beside(const std::string& file, const std::string& ending) {
  return all_printable(std::filesystem::path(file.empty() ? "scene" : file).stem().string()) + ending;
}

}  // namespace tyndall
