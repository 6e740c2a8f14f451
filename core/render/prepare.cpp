#include "core/render/prepare.h"

#include "core/compile/compile.h"
#include "core/compile/flatten.h"
#include "core/guide/find_guide.h"
#include "core/guide/things.h"
#include "core/specular/find_subpixel_lights.h"
#include "core/targets/kernels.h"
#include "core/trace/shade.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

constexpr double min_catch = 0.01;          // fraction of a light's power that a smooth shape has to catch to matter
constexpr double max_fuzz = 0.05;           // fuzz from which on metal does not count as smooth
constexpr std::size_t max_pairs = 1000000;  // of a light and a smooth shape that are looked at

/// Fraction of all directions that a sphere fills, seen from a point at `distance` from its centre; 1 inside the
/// sphere.
double fraction_of_directions(double radius, double distance) {
  if (radius >= distance) return 1;
  const double sine2 = (radius / distance) * (radius / distance);
  return 0.5 * sine2 / (1 + std::sqrt(1 - sine2));  // (1 - cos) / 2 without cancellation
}

/// Whether the elements of a shape show a light to specular paths or to the guide. light: -1: the sky's sun.
bool is_found(const SceneView& s, std::int32_t first, std::int32_t last, int light) {
  for (std::int32_t element = first; element < last; ++element) {
    if (light >= 0 && s.has_guide() && s.guide.thing_of[element] >= 0) return true;
    const std::int32_t object = s.has_specular_paths() ? s.specular.sphere_of[element] >> 1 : -1;
    if (object < 0) continue;
    if (light >= 0 ? s.specular.pair_of[object * s.lights.count() + light] >= 0
                   : s.has_sun_paths() && s.specular.sun_pair_of[object] >= 0)
      return true;
  }
  return false;
}

/// The chance of caustics by way of one shape, whose elements are first … last - 1.
double chance_by(const SceneView& s, Vec3d middle, double radius, std::int32_t first, std::int32_t last) {
  const double fuzz = lobe_width_of(s, s.elements.material[first]);
  const bool is_sphere = s.elements.inverse_radius[first] != 0,
             outside = length(to_double(s.camera.center) - middle) > radius;
  double chance = 1;
  for (int k = 0; k < s.lights.count(); ++k) {
    if (is_found(s, first, last, k)) continue;
    double distance = length(to_double(s.lights.center[k]) - middle);
    if (is_sphere && outside) distance = std::max(distance, radius);
    if (fraction_of_directions(radius, distance) < min_catch) continue;
    const double reach = std::sqrt(static_cast<double>(s.lights.reach2[k]));
    chance = std::min(chance, fraction_of_directions(reach + fuzz * distance, distance));
  }
  return chance;
}

double chance_of_caustics(const Scene& scene, const SceneView& s) {
  bool some = false;
  for (std::int32_t m = 0; m < s.materials.count(); ++m) some = some || lobe_width_of(s, m) < max_fuzz;
  const bool shown = needs_trait<&BsdfTraits::diffuse>(s.features) || s.has_media();
  if (!some || !shown || !(s.has_lights() || s.samples_sky())) return 1;  // at once, also with a million spheres
  const Flattened flat = flatten(scene);
  const std::vector<std::int32_t> elements = first_elements(flat);
  std::vector<std::size_t> shapes;  // the smooth ones
  for (std::size_t i = 0; i < flat.shapes.size(); ++i)
    if (lobe_width_of(s, s.elements.material[elements[i]]) < max_fuzz) shapes.push_back(i);
  const std::size_t step = 1 + shapes.size() * s.lights.kind.size() / max_pairs;  // of very many only every step-th
  double chance = 1;
  for (std::size_t k = 0; k < shapes.size(); k += step) {
    const std::size_t i = shapes[k];
    const std::int32_t first = elements[i], last = elements[i + 1];
    if (s.samples_sky()) {
      const SkyDistribution& sky = s.sky.distribution;
      const double spread = is_found(s, first, last, -1) ? sky.spread_without_sun : sky.spread;
      const double fuzz = lobe_width_of(s, s.elements.material[first]);
      chance = std::min(chance, spread + fraction_of_directions(fuzz, 1));
    }
    const Extent extent = extent_of(flat.shapes[i], scene.camera);
    const Vec3d middle = center_of(flat.shapes[i]);
    double radius = 0;
    for (const Vec3d& point : extent.points) radius = std::max(radius, length(point - middle));
    chance = std::min(chance, chance_by(s, middle - s.origin, radius + extent.radius, first, last));
  }
  return chance;
}

}  // namespace

PreparedScene::PreparedScene(std::shared_ptr<const Scene> scene, const RenderScene& columns, const Guide* guide)
    : scene_(std::move(scene)), view_{columns} {
  if (guide)
    view_.guide = *guide;
  else if (columns.may_guide_paths)
    view_.guide = find_guide(view_);
  if (view_.has_guide()) {
    const bool plain =
        view_.kernel == KernelSet::specular_paths_only || view_.kernel == KernelSet::no_media_no_textures;
    view_.kernel = plain ? KernelSet::guided_paths_only : KernelSet::everything;
  }
  view_.subpixel_lights = find_subpixel_lights(view_, find_camera_images(view_));
  // Guided light is not shared: its sums would depend on the order in which waiting requests are answered.
  const bool may_reuse_paths = columns.may_reuse_paths && !view_.has_guide();
  if (may_reuse_paths) reuse_gain_ = probe_reuse(view_, trace_groups);
  view_.reuses_paths = may_reuse_paths && is_worthwhile(reuse_gain_);
}

double PreparedScene::caustic_chance() const {
  std::call_once(caustic_chance_found_, [this] { caustic_chance_ = chance_of_caustics(*scene_, view_); });
  return caustic_chance_;
}

std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before) {
  const RenderScene columns = compile(*scene, before ? &before->columns() : nullptr);
  const bool kept = before && before->guide().light_paths > 0 && !change_between(before->scene(), *scene).light;
  return std::make_shared<const PreparedScene>(std::move(scene), columns, kept ? &before->guide() : nullptr);
}

std::shared_ptr<const PreparedScene> prepare(const Scene& scene) {
  return prepare(std::make_shared<const Scene>(scene));
}

std::shared_ptr<const PreparedScene> prepare_without_splitting(const Scene& scene) {
  RenderScene columns = compile(scene);
  columns.splits_paths = false;
  return std::make_shared<const PreparedScene>(std::make_shared<const Scene>(scene), columns);
}

}  // namespace tyndall
