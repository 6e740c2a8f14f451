#include "core/trace/scene_view.h"

#include "core/compile/columns.h"

#include <algorithm>

namespace tyndall {
namespace {

SphereView view_of(const Spheres& s) {
  return {static_cast<int>(s.x.size()),
          s.x.data(),
          s.y.data(),
          s.z.data(),
          s.radius.data(),
          s.move_x.data(),
          s.move_y.data(),
          s.move_z.data(),
          s.element.data()};
}

FlatView view_of(const Flats& f) {
  const int count = static_cast<int>(f.map.size());
  FlatView v{count, count - f.bounding, f.map.data(), f.element.data(), {}, f.outline.data()};
  for (int k = 0; k < affine_numbers; ++k) v.column[k] = f.column[k].data();
  return v;
}

TextureView view_of(const TextureColumns& t) {
  return {t.kind,
          t.a,
          t.b,
          t.offset,
          t.scale,
          t.z_scale,
          t.z_offset,
          t.style,
          t.width,
          t.height,
          t.pixels ? t.pixels->rgb.data() : nullptr};
}

LightView view_of(const Lights& l) {
  LightView v{};
  v.count = l.count();
  v.kind = l.kind.data(), v.element = l.element.data();
  for (int i = 0; i < 3; ++i) {
    v.corner[i] = l.corner[i].data(), v.edge_u[i] = l.edge_u[i].data(), v.edge_v[i] = l.edge_v[i].data();
    v.normal[i] = l.normal[i].data(), v.center[i] = l.center[i].data();
  }
  v.length_u = l.length_u.data(), v.length_v = l.length_v.data(), v.area = l.area.data(), v.power = l.power.data();
  v.reach2 = l.reach2.data(), v.inner = l.inner.empty() ? nullptr : l.inner.data();
  const LightTree& tree = l.tree;
  v.tree = {{tree.center[0].data(), tree.center[1].data(), tree.center[2].data()},
            tree.power.data(),
            tree.reach2.data(),
            tree.child.data(),
            tree.parent.data(),
            tree.leaf.data()};
  return v;
}

SpecularView view_of(const SpecularPairs& c) {
  SpecularView v{};
  v.pairs = static_cast<int>(c.sphere.size()), v.spheres = static_cast<int>(c.radius.size());
  v.shells = std::any_of(c.inner_radius.begin(), c.inner_radius.end(), [](float r) { return r > 0; });
  v.has_overlaps = std::find(c.overlapped.begin(), c.overlapped.end(), 1) != c.overlapped.end();
  for (int i = 0; i < 3; ++i) v.center[i] = c.center[i].data(), v.move[i] = c.move[i].data();
  v.radius = c.radius.data(), v.index = c.index.data();
  v.inner_radius = c.inner_radius.data(), v.inner_index = c.inner_index.data();
  v.outer = c.outer.data(), v.inner = c.inner.data(), v.overlapped = c.overlapped.data(), v.sphere = c.sphere.data(),
  v.light = c.light.data();
  v.pair_of = c.pair_of.data(), v.sphere_of = c.sphere_of.data();
  v.sun_pair_of = c.sun_pair_of.empty() ? nullptr : c.sun_pair_of.data();
  v.first_mirror = c.first_mirror, v.first_slab = c.first_slab, v.flats = c.flats.data();
  v.choice = view_of(c.choice);
  return v;
}

int largest_power_of_two(int up_to) {
  int power = 1;
  while (power <= up_to / 2) power *= 2;
  return power;
}

}  // namespace

SkyView view_of(const SkyColumns& s) {
  SkyView v{};
  if (!s.pixels) return v;
  v.texels = s.pixels->rgb.data(), v.width = s.pixels->width, v.height = s.pixels->height;
  v.cos = s.cos, v.sin = s.sin, v.scale = s.scale, v.irradiance = s.irradiance;
  v.sampled = s.is_sampled();
  v.rows_per_texel = 2, v.rows = 2 * v.height, v.to_one = 1;
  if (!v.sampled) return v;
  const SkyDistribution& d = *s.distribution;
  v.rows = d.rows, v.rows_per_texel = d.rows_per_texel, v.to_one = d.to_one;
  v.row_step = largest_power_of_two(d.rows), v.column_step = largest_power_of_two(v.width);
  const auto rotated = [&](Vec3d before) {
    const auto c = static_cast<double>(s.cos), si = static_cast<double>(s.sin);
    return to_float(Vec3d{c * before.x + si * before.z, before.y, c * before.z - si * before.x});
  };
  v.sun_axis = rotated(d.sun.axis), v.sun_edge_u = rotated(d.sun.edge_u), v.sun_edge_v = rotated(d.sun.edge_v);
  v.sun_tangent = static_cast<float>(d.sun.tangent);
  v.row_ends = d.row_ends.data(), v.column_ends = d.column_ends.data();
  return v;
}

std::vector<TextureView> texture_views(const RenderScene& scene) {
  std::vector<TextureView> views;
  for (const TextureColumns& t : scene.textures) views.push_back(view_of(t));
  return views;
}

SceneView view_of(const RenderScene& s, const std::vector<TextureView>& textures) {
  SceneView v{};
  v.width = s.width, v.height = s.height;
  v.camera = s.camera;
  v.background = s.background;
  v.sky = view_of(s.sky);
  v.spheres = view_of(s.spheres), v.moving_spheres = view_of(s.moving_spheres);
  v.quads = view_of(s.quads), v.boxes = view_of(s.boxes), v.outlined = view_of(s.outlined);
  v.nodes = s.bvh ? s.bvh->nodes.data() : nullptr;
  v.leaves = s.bvh ? s.bvh->leaves.data() : nullptr;
  const Elements& e = s.elements;
  v.x = e.x.data(), v.y = e.y.data(), v.z = e.z.data(), v.inverse_radius = e.inverse_radius.data();
  v.move_x = e.move_x.data(), v.move_y = e.move_y.data(), v.move_z = e.move_z.data(), v.uv = e.uv.data(),
  v.plane = e.plane.data();
  v.material = e.material.data(), v.light_of = e.light.data(), v.disk = e.disk.data();
  v.lights = view_of(s.lights);
  v.element_count = static_cast<int>(e.material.size());
  const Materials& m = s.materials;
  v.material_count = static_cast<int>(m.kind.size());
  v.kind = m.kind.data(), v.texture_of = m.texture.data();
  v.red = m.red.data(), v.green = m.green.data(), v.blue = m.blue.data();
  for (std::size_t i = 0; i < max_material_fields; ++i) v.parameter[i] = m.parameter[i].data();
  v.texture_count = static_cast<int>(textures.size());
  v.textures = textures.data();
  v.medium_count = static_cast<int>(s.media.size());
  v.media = s.media.data();
  v.near_count = static_cast<int>(s.near.medium.size());
  v.near_medium = s.near.medium.data(), v.near_light = s.near.light.data();
  v.near_probability = s.near.probability.data();
  v.specular = view_of(s.specular);
  v.gradients = s.gradients ? s.gradients->data() : nullptr;
  v.max_depth = s.max_depth;
  v.seed = s.seed;
  v.schlick = s.schlick, v.sampler = s.sampler;
  v.light_sampling = s.light_sampling, v.integrator = s.integrator;
  v.features = s.features;
  v.kernel = s.kernel;
  v.splits_paths = s.splits_paths;
  return v;
}

}  // namespace tyndall
