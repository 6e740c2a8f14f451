#include "tests/support/mixed_scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

/// The books' ground is a sphere so large that single precision cannot tell exactly where its surface is.
namespace tyndall::test::ground_test {

namespace {

/// A ground of the given radius below three small spheres, which keep the scene's origin with them.
RenderScene ground(double radius) {
  Scene scene;
  scene.materials = {{"white", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {{"", Solid3d{Sphere<>{{0, -radius, 0}, radius, {}}, 0}, {}}};
  for (const double x : {-4.0, 0.0, 4.0}) scene.objects.push_back({"", Solid3d{Sphere<>{{x, 1, 0}, 0.2, {}}, 0}, {}});
  return compile(scene);
}

/// Rays from a camera close by to the ground within 20 units.
std::vector<TraceRay> seen_ground(Engine& engine, const RenderScene& scene, int count) {
  const Vec3d eye{13, 2, 3};
  std::vector<TraceRay> rays;
  for (int i = 0; i < count; ++i) {
    const Vec3d at{uniform(engine, -20, 20), 0, uniform(engine, -20, 20)};
    rays.push_back({rounded(eye - scene.origin), unit_vector(at - eye), 0, from_nowhere});
  }
  return rays;
}

/// Whether a ray that starts on a sphere would meet it again beyond a least distance: the books' rule.
bool met_beyond(float minimum, Vec3f to_center, float radius, Vec3f d) {
  const float a = dot(d, d), h = dot(d, to_center), c = dot(to_center, to_center) - radius * radius;
  const float discriminant = h * h - a * c;
  if (discriminant < 0) return false;
  const float root = std::sqrt(discriminant);
  return (h - root) / a > minimum || (h + root) / a > minimum;
}

}  // namespace

TEST_CASE("ground: of a million diffuse bounces none meets the ground again, at radii from 100 to 1,000,000") {
  const Kernels kernels = available_kernels().back();
  int bounces = 0, naive = 0;
  for (const double radius : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const RenderScene scene = ground(radius);
    Engine engine(3);
    const std::vector<TraceRay> rays = seen_ground(engine, scene, 250000);
    const std::vector<TraceHit> hits = traced(kernels, scene, rays);
    const Vec3f center = scene.elements.center_or_normal[0];
    std::vector<TraceRay> leaving;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].element != 0) continue;
      const Vec3f point = point_at(rays[i].origin, hits[i].t, rays[i].direction);
      const Vec3d normal = normalize(exact(point) - exact(center));
      const Vec3f out = unit_vector(normal + 0.999999 * direction(engine));
      leaving.push_back({point, out, 0, static_cast<std::int32_t>(Side::outward)});
      naive += met_beyond(1e-4f, center - point, static_cast<float>(radius), out) ? 1 : 0;
    }
    int again = 0;
    for (const TraceHit& hit : traced(kernels, scene, leaving)) again += hit.element == 0 ? 1 : 0;
    CAPTURE(radius);
    CHECK(again == 0);
    bounces += static_cast<int>(leaving.size());
  }
  CHECK(bounces > 1000000);
  CHECK(naive > bounces / 100);  // with the books' least distance of 0.0001 some percent do
}

}  // namespace tyndall::test::ground_test
