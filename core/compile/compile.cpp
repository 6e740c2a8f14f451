#include "core/compile/compile.h"

#include "core/compile/columns.h"
#include "core/compile/flatten.h"
#include "core/compile/overlap.h"
#include "core/compile/specular_pairs.h"
#include "core/compile/surroundings.h"
#include "core/film/film.h"
#include "core/shapes/outline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tyndall {
namespace {

constexpr int max_by_brute_force = 16;    // primitives; with more of them the tree is faster
constexpr double bounds_slack = 0x1p-20;  // share by which bounds grow on each side, to cover rounding in the tests

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Vec3d median_center(const Flattened& flat, const Camera& camera) {
  std::vector<double> x, y, z;
  const auto add = [&](Vec3d c) { x.push_back(c.x), y.push_back(c.y), z.push_back(c.z); };
  for (const PlacedShape& shape : flat.shapes) add(center_of(shape));
  for (const PlacedVolume& volume : flat.volumes) add(center_of(volume));
  if (x.empty()) return camera.look_from;
  return {median(std::move(x)), median(std::move(y)), median(std::move(z))};
}

/// The bounds of an extent, widened on all axes by a fraction of their largest coordinate: a hit on a tilted surface
/// that is far away on one axis has that axis's rounding errors in its other coordinates, too.
Bounds bounds_of(const Extent& extent, Vec3d origin) {
  const Vec3d reach{extent.radius, extent.radius, extent.radius};
  Vec3d low = extent.points[0] - origin - reach, high = extent.points[0] - origin + reach;
  for (const Vec3d& point : extent.points) {
    const Vec3d from = point - origin - reach, to = point - origin + reach;
    low = {std::min(low.x, from.x), std::min(low.y, from.y), std::min(low.z, from.z)};
    high = {std::max(high.x, to.x), std::max(high.y, to.y), std::max(high.z, to.z)};
  }
  // The largest of these is >= every |coordinate|.
  const double slack = bounds_slack * std::max({-low.x, -low.y, -low.z, high.x, high.y, high.z});
  const Vec3d room{slack, slack, slack};
  return {to_float(low - room), to_float(high + room)};
}

PrimitiveKind kind_of(const Sphere<>& s) { return s.center_end ? PrimitiveKind::moving_sphere : PrimitiveKind::sphere; }
PrimitiveKind kind_of(const Quad<>&) { return PrimitiveKind::quad; }
PrimitiveKind kind_of(const Box<>&) { return PrimitiveKind::box; }
PrimitiveKind kind_of(const Triangle<>&) { return PrimitiveKind::outlined; }
PrimitiveKind kind_of(const Disk<>&) { return PrimitiveKind::outlined; }

struct SlotFiller {
  RenderScene& out;
  const Placement& placement;
  std::int32_t element;

  void operator()(const Sphere<>& s) const {
    Spheres& to = s.center_end ? out.moving_spheres : out.spheres;
    to.center.push_back(to_float(place(placement, s.center) - out.origin));
    to.radius.push_back(static_cast<float>(std::abs(s.radius)));
    to.element.push_back(element);
    if (s.center_end) to.move.push_back(to_float(rotate(placement, *s.center_end - s.center)));
  }
  void operator()(const Quad<>& q) const {
    out.quads.map.push_back(quad_map(q, placement, out.origin));
    out.quads.element.push_back(element);
  }
  void operator()(const Box<>& b) const {
    const Affine map = box_map(b, placement, out.origin);
    out.boxes.map.push_back(map);
    for (std::size_t row = 0; row < 3; ++row) {
      const Vec3f r = map.row[row];
      out.boxes.column[3 * row].push_back(r.x), out.boxes.column[3 * row + 1].push_back(r.y);
      out.boxes.column[3 * row + 2].push_back(r.z), out.boxes.column[9 + row].push_back(map.offset[row]);
    }
    out.boxes.element.push_back(element);
  }
  void operator()(const Triangle<>& t) const {
    add_outlined(triangle_map(t, placement, out.origin), outline_in_scene(t, placement, out.origin));
  }
  void operator()(const Disk<>& d) const { add_outlined(quad_map(frame_of(d), placement, out.origin), outline_of(d)); }

  void add_outlined(const Affine& map, const Outline& outline) const {
    out.outlined.map.push_back(map);
    out.outlined.outline.push_back(outline);
    out.outlined.element.push_back(element);
  }
};

/// Builds the tree if there are enough primitives, and returns the order in which primitives fill the columns. The tree
/// of `before` is kept if the geometry is equal.
Column<std::int32_t> choose_tree(const Flattened& flat, const Camera& camera, const RenderScene* before,
                                 RenderScene& out) {
  if (flat.shapes.size() <= max_by_brute_force) {
    Column<std::int32_t> order;
    order.resize(flat.shapes.size());
    std::iota(order.begin(), order.end(), 0);
    const auto bounding = std::stable_partition(order.begin(), order.end(), [&](std::int32_t i) {
      return out.sky.pixels || !bounds_scene(flat, static_cast<std::size_t>(i), camera);  // the sky is behind walls
    });
    out.quads.bounding = static_cast<int>(order.end() - bounding);
    return order;
  }
  Column<BvhInput> input;
  input.reserve(flat.shapes.size());
  for (const PlacedShape& placed : flat.shapes)
    input.push_back({bounds_of(extent_of(placed, camera), out.origin),
                     std::visit([](const auto& shape) { return kind_of(shape); }, placed.shape)});
  out.bvh = before && before->bvh.input == input ? before->bvh : build_bvh(input);
  return out.bvh.order;
}

/// The checker of a material; null: it has another texture or none.
const Checker<>* checker_of(const Scene& scene, std::int32_t material) {
  const Material& m = scene.materials[static_cast<std::size_t>(material)];
  const auto* texture = std::get_if<TextureIndex>(&m.colour);
  return texture ? std::get_if<Checker<>>(&scene.textures[static_cast<std::size_t>(texture->index)].kind) : nullptr;
}

void fill_geometry(const Flattened& flat, const Scene& scene, const RenderScene* before, RenderScene& out) {
  const std::vector<std::int32_t> first_element = first_elements(flat);
  for (const PlacedShape& shape : flat.shapes)
    append_elements(shape, out.origin, out.features, checker_of(scene, shape.material), out.elements);
  for (const std::int32_t number : plane_numbers(flat)) out.elements.shared_plane.push_back(number);
  out.camera.surface = camera_surface(flat, first_element, scene.camera, out.origin);
  out.lights = collect_lights(scene, flat, first_element, out.origin, out.elements);
  for (const std::int32_t i : choose_tree(flat, scene.camera, before, out)) {
    const PlacedShape& shape = flat.shapes[static_cast<std::size_t>(i)];
    std::visit(SlotFiller{out, shape.placement, first_element[static_cast<std::size_t>(i)]}, shape.shape);
  }
  for (const PlacedVolume& volume : flat.volumes) {
    MediumColumns m;
    if (const auto* box = std::get_if<Box<>>(&volume.boundary)) {
      m.box = true;
      m.map = box_map(*box, volume.placement, out.origin);
      m.count = 6;
    } else {
      const auto& sphere = std::get<Sphere<>>(volume.boundary);
      m.center = to_float(place(volume.placement, sphere.center) - out.origin);
      m.radius = static_cast<float>(sphere.radius);
    }
    // A boundary that is no surface gets its own element numbers, after all others, because rays can start within it.
    m.first = volume.surface ? first_element[static_cast<std::size_t>(*volume.surface)]
                             : out.elements.count() + 6 * static_cast<std::int32_t>(out.media.size());
    m.density = static_cast<float>(volume.medium.density);
    m.g = static_cast<float>(volume.medium.g);
    if (const auto* texture = std::get_if<TextureIndex>(&volume.albedo)) m.texture = texture->index;
    m.albedo = m.texture < 0 ? to_float(std::get<Vec3d>(volume.albedo)) : Vec3f{1, 1, 1};
    m.weighs = scene.render.integrator == Integrator::mis && m.texture < 0 && m.albedo == Vec3f{0, 0, 0};
    if (m.density > 0) out.media.push_back(m);
  }
}

KernelSet min_kernel(const RenderScene& s) {
  if (s.features.triangles || s.features.disks || s.sky.pixels) return KernelSet::everything;
  const bool media_or_textures = s.features.media || s.features.textures;
  if (!s.specular.sphere.empty() || s.splits_paths)
    return media_or_textures ? KernelSet::common_models : KernelSet::specular_paths_only;
  return media_or_textures ? KernelSet::no_specular_paths : KernelSet::no_media_no_textures;
}

/// Whether some smooth boundary reflects a part of the light: one of index 1 transmits all of it.
bool has_reflecting_glass(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
    const double index = boundary_index(m.kind);
    return index != 0 && index != 1;
  });
}

bool samples_lights(Integrator integrator) {
  switch (integrator) {
    case Integrator::path:
      return false;
    case Integrator::nee:
    case Integrator::mis:
      return true;
  }
  return false;
}

double brightest(const Scene& scene) {
  double maximum = std::visit(
      Overloaded{[](const Vec3d& colour) { return max_component(colour); },
                 [](const Gradient& sky) { return std::max(max_component(sky.bottom), max_component(sky.top)); },
                 [](const Hemispheres& sky) { return std::max(max_component(sky.up), max_component(sky.down)); },
                 [](const SkyPicture& sky) { return sky.scale * static_cast<double>(sky.pixels->largest); }},
      scene.background);
  for (const Material& material : scene.materials) maximum = std::max(maximum, brightness_of(material));
  return maximum;
}

}  // namespace

RenderScene compile(const Scene& scene, const RenderScene* before) {
  Flattened flat = flatten(scene);
  RenderScene out;
  out.width = scene.width;
  out.height = scene.height;
  out.features = features_of(scene, flat);
  out.origin = median_center(flat, scene.camera);
  out.camera = camera_columns(scene.camera, scene.width, scene.height, out.origin);
  out.background = background_columns(scene.background);
  out.sky = sky_columns(scene.background, samples_lights(scene.render.integrator), before ? &before->sky : nullptr);
  out.materials = material_columns(scene.materials);
  out.textures = texture_columns(scene.textures, out.origin);
  for (const TextureColumns& t : out.textures)
    if (t.kind == place_in<Noise<>, TextureKinds<double>> && out.gradients.empty()) out.gradients = gradient_table();
  const std::optional<Flattened> apart = set_glass_apart(flat, scene.materials, out.origin);
  fill_geometry(apart ? *apart : flat, scene, before, out);
  out.max_depth = scene.render.max_depth;
  out.seed = scene.render.seed;
  out.schlick = scene.render.fresnel == FresnelKind::schlick;
  out.sampler = scene.render.sampler;
  out.integrator = scene.render.integrator;
  out.light_sampling = samples_lights(out.integrator) && (out.lights.count() > 0 || out.sky.is_sampled());
  if (out.integrator == Integrator::mis) out.near = find_near_lights(out);
  if (out.integrator == Integrator::mis && !out.schlick && scene.render.caustics == Caustics::chains) {
    out.specular = find_specular_pairs(flat, scene, out);
    out.may_guide_paths = out.light_sampling && !out.sky.pixels;
    out.splits_paths = needs_trait<&BsdfTraits::smooth_boundary>(out.features) && has_reflecting_glass(scene);
  }
  out.objects = std::move(flat.objects);
  out.kernel = min_kernel(out);
  // Moving spheres prevent reuse: a vertex on one exists at one time only.
  out.may_reuse_paths = scene.render.sharing && out.integrator == Integrator::mis && !out.features.moving_spheres;
  out.film_quantum = film_quantum(brightest(scene));
  return out;
}

int RenderScene::primitives() const {
  return spheres.count() + moving_spheres.count() + quads.count() + boxes.count() + outlined.count();
}

const char* name_of(KernelSet set) {
  constexpr const char* names[kernel_sets] = {"everything",
                                              "no triangles, disks, sky picture or guide",
                                              "chains, no fog, no textures",
                                              "no chains",
                                              "no fog, no textures",
                                              "a guide, no fog, no textures"};
  return names[static_cast<int>(set)];
}

std::size_t bytes_of(const RenderScene& s) {
  const std::size_t sphere = 5 * sizeof(float), element = 9 * sizeof(float);
  std::size_t bytes = sizeof s + sphere * s.spheres.radius.size() + (sphere + 12) * s.moving_spheres.radius.size();
  bytes += (sizeof(Affine) + 4) * (s.quads.map.size() + 2 * s.boxes.map.size());
  bytes += (sizeof(Affine) + sizeof(Outline) + 4) * s.outlined.map.size();
  bytes += element * static_cast<std::size_t>(s.elements.count()) + sizeof(float) * s.elements.uv.size();
  bytes += sizeof(BvhNode) * s.bvh.nodes.size() + sizeof(BvhLeaf) * s.bvh.leaves.size() +
           (sizeof(BvhInput) + 4) * s.bvh.input.size();
  if (s.sky.pixels) bytes += sizeof(float) * s.sky.pixels->rgb.size();
  bytes += sizeof(std::int32_t) * s.elements.shared_plane.size();
  bytes += sizeof(std::int32_t) * s.sky.distribution.column_ends.size();
  for (const TextureColumns& t : s.textures)
    if (t.pixels) bytes += sizeof(float) * t.pixels->rgb.size();
  return bytes;
}

}  // namespace tyndall
