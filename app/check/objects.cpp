#include "app/check/check.h"
#include "app/report/contents.h"
#include "app/report/replay.h"
#include "core/compile/compile.h"
#include "core/targets/kernels.h"
#include "core/trace/camera.h"
#include "core/trace/flight.h"

#include <algorithm>
#include <map>

namespace tyndall {
namespace {

constexpr float seen_depth = 0.1f;  // optical depth of a medium that is seen before what lies behind it

/// The medium that most of the light through the middle of a pixel comes from; -1: none that can be seen.
int seen_medium(const SceneView& view, int x, int y, float distance) {
  if (!view.features.media) return -1;
  const float time = view.camera.shutter_open + 0.5f * view.camera.shutter_length;
  const Ray<float> ray =
      camera_ray(view.camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, Pair<float>{0, 0}, time);
  int seen = -1;
  float max_depth = seen_depth;
  for (int k = 0; k < view.media.count(); ++k) {
    const MediumColumns& medium = view.media[k];
    const Interval<float> inside = medium_interval(medium, ray.origin, ray.direction, ray.from);
    if (!inside.hit) continue;
    const float depth = (std::min(inside.far, distance) - std::max(inside.near, 0.0f)) * medium.density;
    if (depth > max_depth) max_depth = depth, seen = k;
  }
  return seen;
}

bool has_noise(const Scene& scene, const ColourOrTexture& colour) {
  const auto* texture = std::get_if<TextureIndex>(&colour);
  return texture && std::holds_alternative<Noise<>>(scene.textures[static_cast<std::size_t>(texture->index)].kind);
}

SeenObjects::Object describe(const Scene& scene, const std::vector<int>& path) {
  const Object& object = *find_object(scene, path);
  SeenObjects::Object seen{object_text(scene, path), "smoke"};
  if (const auto* volume = std::get_if<Volume>(&object.kind)) seen.noisy_texture = has_noise(scene, volume->albedo);
  const auto* solid = std::get_if<Solid3d>(&object.kind);
  if (!solid) return seen;
  const Material& material = scene.materials[static_cast<std::size_t>(solid->material)];
  const BsdfTraits traits = traits_of(material.kind);
  const auto* sphere = std::get_if<Sphere<>>(&solid->shape);
  const bool moves = sphere && sphere->center_end && scene.camera.shutter_close > scene.camera.shutter_open;
  seen.kind = traits.emits ? "lights" : traits.transmissive ? "glass" : traits.diffuse ? "matt surfaces" : "metal";
  if (moves) seen.kind = "moving objects";
  seen.noisy_texture = !traits.transmissive && has_noise(scene, material.colour);
  return seen;
}

/// Of each object the pixels around which it is seen.
Regions regions_of(const SeenObjects& seen, const Lattice& lattice) {
  Regions regions{{}, static_cast<int>(seen.objects.size())};
  const int columns = lattice.columns(), rows = lattice.rows();
  const auto object_at = [&](int x, int y) {
    const std::ptrdiff_t row = std::clamp(y, 0, rows - 1);
    return seen.of_pixel[static_cast<std::size_t>(row * columns + std::clamp(x, 0, columns - 1))];
  };
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int object = object_at(x, y);
      bool same = !seen.objects[static_cast<std::size_t>(object)].noisy_texture;
      for (int k = 0; k < 9; ++k) same = same && object_at(x + k % 3 - 1, y + k / 3 - 1) == object;
      regions.of_pixel.push_back(same ? object : -1);
    }
  return regions;
}

}  // namespace

SeenObjects seen_objects(const Scene& scene, const Lattice& lattice) {
  const SceneView view{compile(scene)};
  const Kernels kernels = *choose_kernels("");
  SeenObjects seen{{{"the sky", "sky"}}, {}, {}};  // the media follow, and the others as they are seen
  for (const std::vector<int>& path : media_of(scene)) seen.objects.push_back(describe(scene, path));
  std::map<std::int32_t, int> numbers{{-1, 0}};
  const auto number_of = [&](std::int32_t element) {
    const std::int32_t object = element < 0 ? -1 : view.elements.object[element];
    const auto [place, is_new] = numbers.try_emplace(object, static_cast<int>(seen.objects.size()));
    if (is_new) seen.objects.push_back(describe(scene, view.objects.path(object)));
    return place->second;
  };
  std::vector<FirstHit> hits(static_cast<std::size_t>(lattice.width));
  for (int y = 0; y < lattice.height; y += lattice.step) {
    kernels.first_hits(view, {0, y, lattice.width, y + 1}, hits.data());
    for (int x = 0; x < lattice.width; x += lattice.step) {
      const FirstHit& hit = hits[static_cast<std::size_t>(x)];
      const float distance = hit.element < 0 ? std::numeric_limits<float>::infinity() : hit.depth;
      const int medium = seen_medium(view, x, y, distance);
      seen.of_pixel.push_back(medium < 0 ? number_of(hit.element) : 1 + medium);
    }
  }
  seen.regions = regions_of(seen, lattice);
  return seen;
}

void leave_out_rare_light(Regions& regions, const std::vector<SampleStatistics>& samples, const LatticeLight& right) {
  constexpr double rare_light = 0.5, dark = 0.003;  // of the light of a region, and light, that samples may be off
  const Numbers sampled = means_of(regions, samples, &SampleStatistics::mean), all = means_of(regions, right.light);
  for (int& region : regions.of_pixel) {
    if (region < 0) continue;
    const auto first = 3 * static_cast<std::size_t>(region);
    const double light = all[first] + all[first + 1] + all[first + 2];
    const double off = sampled[first] + sampled[first + 1] + sampled[first + 2] - light;
    if (std::abs(off) > rare_light * light + dark) region = -1;
  }
}

std::vector<ObjectDifference> differing_objects(const SeenObjects& seen, std::span<const CellDifference> cells) {
  std::vector<ObjectDifference> objects;
  for (std::size_t k = 0; k < cells.size(); k += 3) {
    const auto c = cells.subspan(k, 3);
    if (misfit_of(c).different == 0) continue;
    const Vec3d expected{c[0].expected, c[1].expected, c[2].expected};
    const Vec3d off{c[0].difference, c[1].difference, c[2].difference};
    objects.push_back({seen.objects[k / 3], c[0].pixels, expected + off, expected});
  }
  const auto amount = [](const ObjectDifference& d) {
    const Vec3d off = d.image - d.expected;
    return d.pixels * (std::abs(off.x) + std::abs(off.y) + std::abs(off.z));
  };
  std::ranges::sort(objects, std::greater{}, amount);
  return objects;
}

}  // namespace tyndall
