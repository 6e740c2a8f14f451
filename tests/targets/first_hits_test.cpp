#include "core/targets/kernels.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace tyndall::test::first_hits_test {

namespace {

std::vector<FirstHit> seen(const Kernels& kernels, const RenderScene& scene, Region region) {
  std::vector<FirstHit> hits(static_cast<std::size_t>(region.width() * region.height()) + 32);
  for (FirstHit& hit : hits) hit.element = -7;
  const SceneViewOf view(scene);
  kernels.first_hits(view.view(), region, hits.data());
  for (std::size_t i = hits.size() - 32; i < hits.size(); ++i) CHECK(hits[i].element == -7);  // nothing beyond
  hits.resize(hits.size() - 32);
  return hits;
}

/// A sphere of radius 1 at the centre, before a wall at z = -2; 90 degrees from (0, 0, 4).
Scene sphere_before_wall(double radius) {
  Scene scene;
  scene.width = 90, scene.height = 60;
  scene.camera = {.look_from = {0, 0, 4}, .look_at = {0, 0, 0}, .vfov = 90};
  scene.materials = {{"ball", Vec3d{0.1, 0.2, 0.3}, Lambertian<>{}}, {"wall", Vec3d{0.7, 0.8, 0.9}, Lambertian<>{}}};
  scene.objects = {{"", Solid3d{Sphere<>{{0, 0, 0}, radius, {}}, 0}, {}},
                   {"", Solid3d{Quad<>{{-5, -5, -2}, {10, 0, 0}, {0, 10, 0}}, 1}, {}}};
  return scene;
}

/// The unit direction through the centre of a pixel of that camera.
Vec3d through(int x, int y) { return normalize(Vec3d{(x + 0.5 - 45) / 30, (30 - y - 0.5) / 30, -1}); }

}  // namespace

TEST_CASE("first_hits: what the middle of each pixel sees: element, depth along the axis, colour, own normal") {
  for (const double radius : {1.0, -1.0}) {
    const RenderScene scene = compile(sphere_before_wall(radius));
    for (const Kernels& kernels : available_kernels()) {
      const Region region{7, 3, 84, 60};
      const std::vector<FirstHit> hits = seen(kernels, scene, region);
      int ball = 0, wall = 0, nothing = 0, wrong = 0;
      for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
          const FirstHit& hit = hits[static_cast<std::size_t>((y - region.y0) * region.width() + x - region.x0)];
          const Vec3d d = through(x, y);
          const double middle = -4 * d.z, inside = 1 - (16 - middle * middle);  // of the quadratic of the sphere
          const Vec3d on_wall = Vec3d{0, 0, 4} + (6 / -d.z) * d;
          if (inside > 0) {
            const double t = middle - std::sqrt(inside);
            const Vec3d p = Vec3d{0, 0, 4} + t * d, normal = radius * p;
            wrong += hit.element == 0 && hit.albedo == Vec3f{0.1f, 0.2f, 0.3f} ? 0 : 1;
            wrong += std::abs(static_cast<double>(hit.depth) - t * -d.z) < 1e-3 ? 0 : 1;
            wrong += length(Vec3d{hit.normal.x, hit.normal.y, hit.normal.z} - normal) < 1e-3 ? 0 : 1;
            ++ball;
          } else if (std::abs(on_wall.x) < 5 && std::abs(on_wall.y) < 5) {
            wrong += hit.element == 1 && hit.albedo == Vec3f{0.7f, 0.8f, 0.9f} ? 0 : 1;
            wrong += std::abs(hit.depth - 6) < 1e-5f && hit.normal == Vec3f{0, 0, 1} ? 0 : 1;
            ++wall;
          } else {
            wrong += hit.element == -1 && hit.depth == 0 && hit.albedo == Vec3f{} && hit.normal == Vec3f{} ? 0 : 1;
            ++nothing;
          }
        }
      CAPTURE(std::string(kernels.isa));
      CHECK(wrong == 0);
      CHECK(ball > 100);
      CHECK(wall > 1000);
      CHECK(nothing > 100);
    }
  }
}

TEST_CASE("first_hits: ignores the lens and stands in the middle of the shutter") {
  Scene scene = sphere_before_wall(1);
  scene.camera.defocus_angle = 20;
  const Region middle{45, 30, 46, 31};
  CHECK(seen(scalar_kernels(), compile(scene), middle)[0].element == 0);
  // The sphere is in the middle of the picture half-way through the shutter alone.
  std::get<Sphere<>>(std::get<Solid3d>(scene.objects[0].kind).shape) = {{-40, 0, 0}, 1, Vec3d{40, 0, 0}};
  scene.camera.shutter_open = 0.25;
  scene.camera.shutter_close = 0.75;
  const RenderScene moving = compile(scene);
  for (const Kernels& kernels : available_kernels()) {
    const FirstHit hit = seen(kernels, moving, middle)[0];
    CHECK(hit.element == 0);
    CHECK(hit.depth == doctest::Approx(3).epsilon(1e-3).scale(0));
    CHECK(hit.normal.z == doctest::Approx(1).epsilon(0.01).scale(0));
  }
}

}  // namespace tyndall::test::first_hits_test
