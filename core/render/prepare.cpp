#include "core/render/prepare.h"

#include "core/compile/compile.h"
#include "core/compile/flatten.h"
#include "core/guide/camera_images.h"
#include "core/guide/find_guide.h"
#include "core/specular/find_subpixel_lights.h"
#include "core/targets/kernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr double min_catch = 0.01;  // fraction of a light's power that a smooth shape has to catch to matter
constexpr double max_fuzz = 0.05;   // largest fuzz with which metal counts as smooth

constexpr std::size_t max_pairs = 1000000;

struct BoundingSphere {
  Vec3d center;
  double radius = 0;
};

BoundingSphere bounding_sphere(const Extent& extent) {
  BoundingSphere sphere;
  for (const Vec3d& p : extent.points)
    sphere.center = sphere.center + (1.0 / static_cast<double>(extent.points.size())) * p;
  for (const Vec3d& p : extent.points) sphere.radius = std::max(sphere.radius, length(p - sphere.center));
  sphere.radius += extent.radius;
  return sphere;
}

/// Fraction of all directions that a sphere fills, seen from a point at `distance` from its centre; 1 inside the
/// sphere.
double fraction_of_directions(double radius, double distance) {
  if (radius >= distance) return 1;
  const double sine2 = (radius / distance) * (radius / distance);
  return 0.5 * sine2 / (1 + std::sqrt(1 - sine2));  // (1 - cos) / 2 without cancellation
}

const Material& material_of(const Scene& scene, const PlacedShape& shape) {
  return scene.materials[static_cast<std::size_t>(shape.material)];
}

bool is_light(const Material& material) { return traits_of(material.kind).emits; }

/// Whether a material reflects or refracts light in a narrow lobe.
bool is_smooth(const Material& material) { return lobe_width(material.kind) < max_fuzz; }

/// A light, or a smooth shape that throws light on other surfaces.
struct CausticPart {
  std::size_t shape;  // index into Flattened::shapes
  BoundingSphere sphere;
  double fuzz = 0;
  bool glass = false;
};

struct CausticParts {
  std::vector<CausticPart> lights, smooth;
};

CausticParts list_caustic_parts(const Scene& scene, const Flattened& flat) {
  CausticParts parts;
  for (std::size_t i = 0; i < flat.shapes.size(); ++i) {
    const Material& material = material_of(scene, flat.shapes[i]);
    if (!is_light(material) && !is_smooth(material)) continue;
    const bool smooth = is_smooth(material), glass = boundary_index(material.kind) > 0;
    const double fuzz = smooth ? lobe_width(material.kind) : 0;
    const CausticPart thing{i, bounding_sphere(extent_of(flat.shapes[i], scene.camera)), fuzz, glass};
    (is_light(material) ? parts.lights : parts.smooth).push_back(thing);
  }
  return parts;
}

/// The bounding box of a matt surface or a medium, on which light from any direction shows.
struct MattBox {
  Vec3d low, high;
};

Vec3d min_of(Vec3d a, Vec3d b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3d max_of(Vec3d a, Vec3d b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

MattBox matt_box_around(const Extent& extent) {
  MattBox box{extent.points.front(), extent.points.front()};
  for (const Vec3d& p : extent.points) box = {min_of(box.low, p), max_of(box.high, p)};
  const Vec3d grown{extent.radius, extent.radius, extent.radius};
  return {box.low - grown, box.high + grown};
}

std::vector<MattBox> list_matt_boxes(const Scene& scene, const Flattened& flat) {
  std::vector<MattBox> receivers;
  for (const PlacedVolume& volume : flat.volumes) receivers.push_back(matt_box_around(extent_of(volume, scene.camera)));
  for (const PlacedShape& shape : flat.shapes)
    if (traits_of(material_of(scene, shape).kind).diffuse)
      receivers.push_back(matt_box_around(extent_of(shape, scene.camera)));
  return receivers;
}

double distance_to_nearest(const std::vector<MattBox>& receivers, Vec3d point) {
  double minimum = std::numeric_limits<double>::infinity();
  for (const MattBox& box : receivers)
    minimum = std::min(minimum, length(max_of(max_of(box.low - point, point - box.high), {0, 0, 0})));
  return minimum;
}

/// Whether a light is inside a glass sphere and shines out of it. If the camera is in the sphere, too, the sphere is a
/// room and not a bulb.
bool is_bulb(const CausticPart& light, const CausticPart& thing, Vec3d camera) {
  const BoundingSphere& sphere = thing.sphere;
  return thing.glass && length(light.sphere.center - sphere.center) < sphere.radius &&
         light.sphere.radius < sphere.radius && length(camera - sphere.center) > sphere.radius;
}

/// chance_of_caustics() of the light of the sky's picture. Specular paths compute that of its sun alone.
double chance_of_sky_caustics(const Scene& scene, const RenderScene& compiled) {
  if (!compiled.sky.is_sampled()) return 1;
  double minimum = 1;
  const Flattened flat = flatten(scene);
  if (list_matt_boxes(scene, flat).empty()) return 1;
  const std::vector<std::int32_t> elements = first_elements(flat);
  const SpecularPairs& specular = compiled.specular;
  const auto has_sun_pair = [&](const CausticPart& thing) {
    if (specular.sun_pair_of.empty()) return false;
    const std::int32_t sphere = specular.sphere_of[static_cast<std::size_t>(elements[thing.shape])];
    return sphere >= 0 && specular.sun_pair_of[static_cast<std::size_t>(sphere / 2)] >= 0;
  };
  const SkyDistribution& sky = *compiled.sky.distribution;
  for (const CausticPart& thing : list_caustic_parts(scene, flat).smooth) {
    const double spread = has_sun_pair(thing) ? sky.spread_without_sun : sky.spread;
    minimum = std::min(minimum, spread + fraction_of_directions(thing.fuzz, 1));
  }
  return minimum;
}

}  // namespace

double chance_of_caustics(const Scene& scene, const IsFound& is_found) {
  const auto has = [&](const auto& is) { return std::any_of(scene.materials.begin(), scene.materials.end(), is); };
  if (!has(is_light) || !has(is_smooth)) return 1;  // at once, also in a scene of a million spheres
  const Flattened flat = flatten(scene);
  const std::vector<MattBox> receivers = list_matt_boxes(scene, flat);
  if (receivers.empty()) return 1;
  const CausticParts parts = list_caustic_parts(scene, flat);
  const std::size_t step =
      1 + parts.lights.size() * parts.smooth.size() / max_pairs;  // for very many pairs only every step-th
  double minimum = 1;
  for (const CausticPart& light : parts.lights)
    for (std::size_t i = 0; i < parts.smooth.size(); i += step) {
      const CausticPart& thing = parts.smooth[i];
      if (is_found && is_found(light.shape, thing.shape)) continue;
      double distance = length(light.sphere.center - thing.sphere.center);
      if (is_bulb(light, thing, scene.camera.look_from))
        distance = std::max(thing.sphere.radius, distance_to_nearest(receivers, light.sphere.center));
      else if (fraction_of_directions(thing.sphere.radius, distance) < min_catch)
        continue;
      minimum = std::min(minimum, fraction_of_directions(light.sphere.radius + thing.fuzz * distance, distance));
    }
  return minimum;
}

double chance_of_caustics(const Scene& scene, const RenderScene& compiled, const Guide* guide) {
  const SpecularPairs& specular = compiled.specular;
  const bool guided = guide && guide->lobes() > 0;
  if (specular.sphere.empty() && !guided) return chance_of_caustics(scene);
  const std::vector<std::int32_t> elements = first_elements(flatten(scene));
  const std::size_t lights = compiled.lights.kind.size();
  const auto is_pair = [&](std::size_t light, std::size_t thing) {
    if (guided && guide->thing_of[thing] >= 0) return true;
    if (specular.sphere.empty()) return false;
    const std::int32_t light_index = compiled.elements.light[light], sphere = specular.sphere_of[thing];
    if (light_index < 0 || sphere < 0) return false;
    return specular.pair_of[static_cast<std::size_t>(sphere / 2) * lights + static_cast<std::size_t>(light_index)] >= 0;
  };
  return chance_of_caustics(scene, [&](std::size_t light, std::size_t shape) {
    for (std::int32_t i = elements[light]; i < elements[light + 1]; ++i)
      for (std::int32_t k = elements[shape]; k < elements[shape + 1]; ++k)
        if (is_pair(static_cast<std::size_t>(i), static_cast<std::size_t>(k))) return true;
    return false;
  });
}

PreparedScene::PreparedScene(std::shared_ptr<const Scene> scene, RenderScene columns,
                             std::shared_ptr<const Guide> guide)
    : scene_(std::move(scene)),
      columns_(std::move(columns)),
      textures_(texture_views(columns_)),
      view_(view_of(columns_, textures_)) {
  if (!guide) guide = std::make_shared<const Guide>(columns_.may_guide_paths ? find_guide(view_) : Guide{});
  guide_ = std::move(guide);
  view_.guide = guide_->view();
  if (guide_->lobes() > 0) {
    const bool plain =
        columns_.kernel == KernelSet::specular_paths_only || columns_.kernel == KernelSet::no_media_no_textures;
    columns_.kernel = view_.kernel = plain ? KernelSet::guided_paths_only : KernelSet::everything;
  }
  subpixel_lights_ = find_subpixel_lights(view_, find_camera_images(view_));
  view_.subpixel_light_count = static_cast<int>(subpixel_lights_.size());
  view_.subpixel_lights = subpixel_lights_.data();
  // Guided light is not shared: its sums would depend on the order in which waiting requests are answered.
  const bool may_reuse_paths = columns_.may_reuse_paths && guide_->lobes() == 0;
  if (may_reuse_paths) reuse_gain_ = probe_reuse(view_, trace_groups);
  view_.reuses_paths = may_reuse_paths && is_worthwhile(reuse_gain_);
}

double PreparedScene::caustic_chance() const {
  std::call_once(caustic_chance_found_, [this] {
    caustic_chance_ =
        std::min(chance_of_caustics(*scene_, columns_, guide_.get()), chance_of_sky_caustics(*scene_, columns_));
  });
  return caustic_chance_;
}

std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before) {
  RenderScene columns = compile(*scene, before ? &before->columns() : nullptr);
  std::shared_ptr<const Guide> guide;
  if (before && before->guide().light_paths > 0 && !change_between(before->scene(), *scene).light)
    guide = before->shared_guide();  // its light paths are those of the scene
  return std::make_shared<const PreparedScene>(std::move(scene), std::move(columns), std::move(guide));
}

std::shared_ptr<const PreparedScene> prepare(const Scene& scene) {
  return prepare(std::make_shared<const Scene>(scene));
}

std::shared_ptr<const PreparedScene> prepare_without_splitting(const Scene& scene) {
  RenderScene columns = compile(scene);
  columns.splits_paths = false;
  return std::make_shared<const PreparedScene>(std::make_shared<const Scene>(scene), std::move(columns));
}

}  // namespace tyndall
