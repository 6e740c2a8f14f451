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

std::string place_of(const Material& material, const char* key) {
  return "/materials/" + pointer_step(material.name) + "/" + key;
}

void check_texture(const Texture& texture, const Refusal& refuse) {
  const std::string where = "/textures/" + pointer_step(texture.name) + "/type";
  const ForeignRenderer& r = refuse.renderer;
  std::visit(
      Overloaded{[&](const Solid<>&) {},
                 [&](const Checker<>&) {
                   if (!r.solid_checkers) refuse(where, "a checker pattern in space", "a colour or an image");
                 },
                 [&](const Image&) {
                   if (!r.images) refuse(where, "an image", "a colour");
                 },
                 [&](const auto& other) { refuse(where, in_quotes(other.type), "a colour, a checker or an image"); }},
      texture.kind);
}

/// Null: the material has none.
const Texture* texture_of(const Material& material, const Scene& scene) {
  const auto* texture = std::get_if<TextureIndex>(&material.colour);
  return texture ? &scene.textures[static_cast<std::size_t>(texture->index)] : nullptr;
}
bool is_image(const Texture* texture) { return texture && std::holds_alternative<Image>(texture->kind); }

void check_material(const Material& material, const Scene& scene, const Refusal& refuse) {
  const Texture* texture = colour_name(material.kind) ? texture_of(material, scene) : nullptr;
  if (texture) check_texture(*texture, refuse);
  if (const auto* metal = std::get_if<Metal<double>>(&material.kind)) {
    if (metal->fuzz > 0) refuse(place_of(material, "fuzz"), number_text(metal->fuzz), "0");
    if (!refuse.renderer.even_mirrors)
      refuse(place_of(material, "type"), "a mirror that reflects the same at every angle", "another material");
  }
  if (is_image(texture) && !std::holds_alternative<Lambertian<double>>(material.kind))
    refuse(place_of(material, "type"), "an image on what is not lambertian", "a colour");
}

ForeignSphere sphere_of(const Sphere<>& sphere, const Placement& placement, const Camera& camera) {
  const Vec3d begin = place(placement, sphere.center),
              end = place(placement, sphere.center_end.value_or(sphere.center));
  ForeignSphere out{begin, end, std::abs(sphere.radius), sphere.radius < 0, placement.degrees};
  if (camera.shutter_open == camera.shutter_close)  // a moment: everything is at rest
    out.center = out.center_end = begin + camera.shutter_open * (end - begin);
  return out;
}

ForeignFlat flat_of(Vec3d corner, Vec3d u, Vec3d v, const Placement& placement) {
  return {place(placement, corner), rotate(placement, u), rotate(placement, v)};
}

ForeignGeometry shape_of(const auto& shape, const Placement& placement, const Camera& camera) {
  using Result = ForeignGeometry;
  return std::visit(
      Overloaded{
          [&](const Sphere<>& s) -> Result { return sphere_of(s, placement, camera); },
          [&](const Quad<>& q) -> Result { return std::vector{flat_of(q.corner, q.u, q.v, placement)}; },
          [&](const Box<>& b) -> Result {
            std::vector<ForeignFlat> faces;
            for (int i = 0; i < 6; ++i) {
              const BoxFace face = box_face_edges(b, i);
              faces.push_back(flat_of(face.corner, face.u, face.v, placement));
            }
            return faces;
          },
          [&](const Triangle<>& t) -> Result { return ForeignTriangle{flat_of(t.corner, t.u, t.v, placement)}; },
          [&](const Disk<>& d) -> Result {
            return ForeignDisk{place(placement, d.center), rotate(placement, d.u), rotate(placement, d.v), d.inner};
          }},
      shape);
}

bool is_inside(const PlacedVolume& volume, Vec3d point) {
  if (const auto* sphere = std::get_if<Sphere<>>(&volume.boundary))
    return length(point - place(volume.placement, sphere->center)) < std::abs(sphere->radius);
  const Block block = block_of(std::get<Box<>>(volume.boundary), volume.placement);
  return std::all_of(block.edge.begin(), block.edge.end(),
                     [&](Vec3d edge) { return std::abs(dot(point - block.middle, edge)) < dot(edge, edge); });
}

/// Whether two media may have a point in common; where one is a sphere, by the boxes around them.
bool may_overlap(const PlacedVolume& a, const PlacedVolume& b, const Camera& camera) {
  const auto *box_a = std::get_if<Box<>>(&a.boundary), *box_b = std::get_if<Box<>>(&b.boundary);
  if (box_a && box_b) return !are_apart(block_of(*box_a, a.placement), block_of(*box_b, b.placement));
  const auto range = [&](const PlacedVolume& volume, double Vec3d::*axis) {
    const Extent extent = extent_of(volume, camera);
    double low = extent.points[0].*axis, high = low;
    for (const Vec3d& point : extent.points) low = std::min(low, point.*axis), high = std::max(high, point.*axis);
    return std::pair{low - extent.radius, high + extent.radius};
  };
  for (const auto axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    const auto [a0, a1] = range(a, axis);
    const auto [b0, b1] = range(b, axis);
    if (a1 < b0 || b1 < a0) return false;
  }
  return true;
}

/// Whether both half axes are as long and at right angles, up to the rounding of what wrote the scene.
bool is_circle(const ForeignDisk& disk) {
  const double a = dot(disk.u, disk.u), b = dot(disk.v, disk.v), small = 1e-6 * std::max(a, b);
  return std::abs(a - b) <= small && std::abs(dot(disk.u, disk.v)) <= small;
}

void check_disk(const ForeignDisk& disk, const Material& material, const Scene& scene, const Refusal& refuse) {
  if (!refuse.renderer.ellipses && !is_circle(disk)) refuse("/objects", "an ellipse", "a circle");
  if (!refuse.renderer.rings && disk.inner > 0) refuse("/objects", "a ring", "a disk without a hole");
  if (is_image(texture_of(material, scene))) refuse("/objects", "an image on a disk", "a colour");
}

void check_sphere(const ForeignSphere& sphere, const Material& material, const Refusal& refuse) {
  if (!sphere.moves()) return;
  if (!refuse.renderer.moving_spheres) refuse("/camera/shutter", "spheres that move while it is open", "an instant");
  if (std::holds_alternative<Light<double>>(material.kind)) refuse("/objects", "a light that moves", "one at rest");
}

/// Adds the media; those whose boundary is a surface become its interior.
void add_media(const Scene& scene, const Flattened& flat, const Refusal& refuse, ForeignScene& out) {
  for (std::size_t i = 0; i < flat.volumes.size(); ++i) {
    const PlacedVolume& volume = flat.volumes[i];
    const auto* albedo = std::get_if<Vec3d>(&volume.albedo);
    if (!albedo) refuse("/objects", "a texture as the albedo of a medium", "a colour");
    for (std::size_t k = 0; k < i && !refuse.renderer.overlapping_media; ++k)
      if (may_overlap(volume, flat.volumes[k], scene.camera))
        refuse("/objects", "media that may overlap", "media apart from each other");
    const int index = static_cast<int>(out.media.size());
    out.media.push_back({volume.medium.density, volume.medium.g, *albedo});
    if (is_inside(volume, scene.camera.look_from)) out.camera_medium = index;
    if (!volume.surface) {
      out.shapes.push_back({shape_of(volume.boundary, volume.placement, scene.camera), -1, index});
      continue;
    }
    ForeignShape& shape = out.shapes[static_cast<std::size_t>(*volume.surface)];
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    if (!refuse.renderer.media_in_lights && std::holds_alternative<Light<double>>(material.kind))
      refuse("/objects", "a medium within a light", "one within another surface");
    if (const auto* sphere = std::get_if<ForeignSphere>(&shape.shape); sphere && sphere->inward)
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
  std::set<int> used;
  for (const PlacedShape& shape : flat.shapes) {
    used.insert(shape.material);
    out.shapes.push_back({shape_of(shape.shape, shape.placement, scene.camera), shape.material, -1});
    const Material& material = scene.materials[static_cast<std::size_t>(shape.material)];
    std::visit(
        Overloaded{[&](const ForeignSphere& sphere) { check_sphere(sphere, material, refuse); },
                   [&](const ForeignDisk& disk) { check_disk(disk, material, scene, refuse); }, [](const auto&) {}},
        out.shapes.back().shape);
  }
  for (const int material : used) check_material(scene.materials[static_cast<std::size_t>(material)], scene, refuse);
  add_media(scene, flat, refuse, out);
  out.forward = normalize(scene.camera.look_at - scene.camera.look_from);
  out.right = normalize(cross(out.forward, scene.camera.vup));
  out.up = cross(out.right, out.forward);
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

LinearImage sky_in_rows(const Image::Pixels& sky, int rows, double (*place)(int row, int rows)) {
  LinearImage out{std::max(sky.width, 2), rows, {}};
  out.rgb.reserve(3 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(rows));
  for (int y = 0; y < rows; ++y) {
    const double at = std::clamp(place(y, rows) * sky.height - 0.5, 0.0, sky.height - 1.0);
    const int above = static_cast<int>(at), below = std::min(above + 1, sky.height - 1);
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto texel = [&](int row) {
          return static_cast<double>(sky.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(sky.width) +
                                                  static_cast<std::size_t>(x % sky.width)) +
                                             static_cast<std::size_t>(c)]);
        };
        out.rgb.push_back(static_cast<float>(texel(above) + (at - above) * (texel(below) - texel(above))));
      }
  }
  return out;
}

LinearImage sky_of_heights(const Background& sky, int width, int rows, const std::function<double(int, int)>& height) {
  LinearImage out{width, rows, {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < width; ++x) {
      const double at = height(x, y);
      const Vec3d c =
          std::visit(Overloaded{[](const Vec3d& colour) { return colour; }, [](const SkyPicture&) { return Vec3d{}; },
                                [at](const Gradient& g) { return g.bottom + (at + 1) / 2 * (g.top - g.bottom); },
                                [at](const Hemispheres& h) { return at > 0 ? h.up : h.down; }},
                     sky);
      out.rgb.insert(out.rgb.end(), {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
    }
  return out;
}

std::string beside(const std::string& file, const std::string& ending) {
  return all_printable(std::filesystem::path(file.empty() ? "scene" : file).stem().string()) + ending;
}

}  // namespace tyndall
