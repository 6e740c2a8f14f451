#include "tests/bench/field.h"

#include "core/base/sampling.h"
#include "tests/support/prepared.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace tyndall::bench {

using namespace test;
namespace {

Object sphere(Vec3d center, double radius) {
  Object object;
  object.kind = Solid3d{Sphere<>{center, radius, std::nullopt}, 0};
  return object;
}

/// In [0, 1); the standard distributions differ between libraries.
double uniform(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// Small spheres, one in each cell of a square of edge² cells, as far as they keep clear of the large ones.
std::vector<Object> small_spheres(int edge, std::size_t maximum) {
  std::mt19937 random(7);
  std::vector<Object> spheres;
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j) {
      const double x = i - edge / 2 + 0.9 * uniform(random), z = j - edge / 2 + 0.9 * uniform(random);
      const bool clear = std::abs(z) > 1.3 || std::abs(x) > 5.3;
      if (clear && spheres.size() < maximum) spheres.push_back(sphere({x, 0.2, z}, 0.2));
    }
  return spheres;
}

/// In [0, 1), in single precision.
float uniform_single(std::mt19937& random) { return static_cast<float>(random() >> 8) * 0x1p-24f; }

/// Rays from the camera, two a pixel, tile by tile; then again.
class CameraRays {
 public:
  explicit CameraRays(const RenderScene& scene) : camera_(scene.camera) {
    constexpr int tile = 32;
    for (int top = 0; top < scene.height; top += tile)
      for (int left = 0; left < scene.width; left += tile)
        for (int y = top; y < std::min(top + tile, scene.height); ++y)
          for (int x = left; x < std::min(left + tile, scene.width); ++x) pixels_.insert(pixels_.end(), 2, {x, y});
  }

  TraceRay next(std::mt19937& random) {
    const auto [column, row] = pixels_[next_++ % pixels_.size()];
    const float x = static_cast<float>(column) + uniform_single(random);
    const float y = static_cast<float>(row) + uniform_single(random);
    return {camera_.center, normalize(camera_.corner + x * camera_.du + y * camera_.dv), 0, from_nowhere};
  }

 private:
  const CameraColumns& camera_;
  std::vector<std::pair<int, int>> pixels_;
  std::size_t next_ = 0;
};

/// The ray that leaves the surface which `ray` hit, in a cosine-weighted direction. It starts a few roundings above the
/// surface, so that Embree, which does not know where rays start, does not meet that surface again.
TraceRay bounce(const Elements& elements, const TraceRay& ray, const TraceHit& hit, std::mt19937& random) {
  const std::int32_t i = hit.element;
  const Vec3f center = elements.center_or_normal[i];
  const Vec3f normal = normalize(elements.inverse_radius[i] * (point_at(ray.origin, hit.t, ray.direction) - center));
  const float radius = 1 / elements.inverse_radius[i], lift = 4e-7f * (length(center) + radius);
  const float u = uniform_single(random), v = uniform_single(random);
  const Vec3f direction = normal + 0.9999f * on_sphere(Pair<float>{u, v});  // never zero
  return {point_at(center, radius + lift, normal), normalize(direction), 0,
          4 * hit.element + static_cast<std::int32_t>(Side::outward)};
}

}  // namespace

Scene field_of_spheres(int count) {
  Scene scene;
  scene.width = 400, scene.height = 225;
  scene.camera = {.look_from = {13, 2, 3}, .look_at = {0, 0, 0}, .vfov = 20};
  scene.background = Gradient{};
  scene.render.max_depth = 50;
  scene.materials = {Material{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {sphere({0, -1000, 0}, 1000), sphere({0, 1, 0}, 1), sphere({-4, 1, 0}, 1), sphere({4, 1, 0}, 1)};
  const auto small = static_cast<std::size_t>(count) - scene.objects.size();
  std::vector<Object> strewn;
  for (int edge = static_cast<int>(std::sqrt(static_cast<double>(small))); strewn.size() < small; ++edge)
    strewn = small_spheres(edge, small);
  scene.objects.insert(scene.objects.end(), strewn.begin(), strewn.end());
  return scene;
}

std::vector<TraceRay> rays_in_path_order(const RenderScene& scene, const Kernels& kernels, std::size_t count) {
  const SceneViewOf view(scene);
  const auto lanes = static_cast<std::size_t>(kernels.lanes);
  constexpr int max_bounces = 50;
  std::mt19937 random(1);
  CameraRays camera(scene);
  std::vector<TraceRay> group(lanes), rays;
  std::vector<TraceHit> hits(lanes);
  std::vector<int> bounces(lanes);
  for (TraceRay& ray : group) ray = camera.next(random);
  while (rays.size() < count) {
    rays.insert(rays.end(), group.begin(), group.end());
    kernels.trace(view.view(), group.data(), hits.data(), kernels.lanes, false);
    for (std::size_t k = 0; k < lanes; ++k) {
      const bool on = hits[k].element >= 0 && ++bounces[k] <= max_bounces;
      if (!on) bounces[k] = 0;
      group[k] = on ? bounce(scene.elements, group[k], hits[k], random) : camera.next(random);
    }
  }
  rays.resize(count);
  return rays;
}

std::vector<TraceRay> shuffled(std::vector<TraceRay> rays) {
  std::mt19937_64 random(3);
  for (std::size_t i = rays.size(); i > 1; --i) std::swap(rays[i - 1], rays[random() % i]);
  return rays;
}

}  // namespace tyndall::bench
