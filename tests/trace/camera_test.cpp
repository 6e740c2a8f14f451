#include "core/trace/camera.h"

#include "tests/support/mixed_scene.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tyndall::test::camera_test {

namespace {

Scene slanted() {
  Scene scene;
  scene.width = 120, scene.height = 80;
  scene.camera = {.look_from = {3, 2, 5}, .look_at = {-1, 0.5, -2}, .vup = {0.2, 1, 0}, .vfov = 35};
  return scene;
}

Vec3d direction(const Ray<float>& ray) { return exact(ray.direction); }

}  // namespace

TEST_CASE("camera: x to the right, y down, the field of view from edge to edge of the picture's height") {
  const Scene scene = slanted();
  const RenderScene compiled = compile(scene);
  const auto through = [&](float x, float y) { return direction(camera_ray<float>(compiled.camera, x, y, {0, 0}, 0)); };
  const Vec3d axis = normalize(scene.camera.look_at - scene.camera.look_from);
  const Vec3d right = normalize(cross(axis, scene.camera.vup)), up = cross(right, axis);
  CHECK(length(through(60, 40) - axis) < 1e-6);
  const double half = std::tan(35.0 / 2 * pi / 180);
  CHECK(length(through(60, 0) - normalize(axis + half * up)) < 1e-6);
  CHECK(length(through(60, 80) - normalize(axis - half * up)) < 1e-6);
  CHECK(length(through(120, 40) - normalize(axis + 1.5 * half * right)) < 1e-6);
  CHECK(length(through(0, 0) - normalize(axis - 1.5 * half * right + half * up)) < 1e-6);
  const Ray<float> ray = camera_ray<float>(compiled.camera, 3, 4, {0, 0}, 0.25f);
  CHECK(length(exact(ray.origin) - (scene.camera.look_from - compiled.origin)) < 1e-6);
  CHECK(ray.from == from_nowhere);
  CHECK(ray.time == 0.25f);
}

TEST_CASE(
    "camera: rays of one pixel through all of the lens meet in the plane of focus; the lens has the cone's size") {
  Engine engine(1);
  for (const double focus : {0.0, 0.5, 20.0}) {
    Scene scene = slanted();
    scene.camera.defocus_angle = 4;
    if (focus > 0) scene.camera.focus_distance = focus;
    const double distance = focus > 0 ? focus : length(scene.camera.look_from - scene.camera.look_at);
    const RenderScene compiled = compile(scene);
    const Vec3d axis = normalize(scene.camera.look_at - scene.camera.look_from);
    const Vec3d center = scene.camera.look_from - compiled.origin;
    const double radius = distance * std::tan(2 * pi / 180);
    for (int i = 0; i < 1000; ++i) {
      const float x = static_cast<float>(uniform(engine, 0, 120)), y = static_cast<float>(uniform(engine, 0, 80));
      const auto in_focus = [&](Pair<float> lens) {
        const Ray<float> ray = camera_ray<float>(compiled.camera, x, y, lens, 0);
        const Vec3d start = exact(ray.origin), d = direction(ray);
        CHECK(std::abs(dot(start - center, axis)) < 1e-5 * distance);
        CHECK(length(start - center) == doctest::Approx(radius * std::hypot(lens.x, lens.y)).epsilon(1e-3).scale(0));
        return start + (distance - dot(start - center, axis)) / dot(d, axis) * d;
      };
      CHECK(length(in_focus({1, 0}) - in_focus({0, -1})) < 1e-5 * distance);
      CHECK(length(in_focus({0.6f, 0.8f}) - in_focus({-0.2f, 0.1f})) < 1e-5 * distance);
    }
  }
}

TEST_CASE("camera: samples fill the pixel, the lens and the shutter evenly") {
  Scene scene = slanted();
  scene.camera.defocus_angle = 4;
  scene.camera.shutter_open = 0.25;
  scene.camera.shutter_close = 0.75;
  scene.materials = {{"white", Vec3d{1, 1, 1}, Lambertian<>{}}};
  scene.objects = {{"", Solid3d{Sphere<>{{0, 0, 0}, 1, Vec3d{1, 0, 0}}, 0}, {}}};
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  constexpr int count = 40000;
  double time = 0, time2 = 0, lens = 0;
  float earliest = 9, latest = -9;
  Vec3d middle;
  const Vec3d center = scene.camera.look_from - compiled.origin;
  const double radius = length(scene.camera.look_from - scene.camera.look_at) * std::tan(2 * pi / 180);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Ray<float> ray = sample_ray(view.view(), 30.0f, 20.0f, Sampler<float>::of(1, 30, 20, i));
    time += static_cast<double>(ray.time) / count, time2 += std::pow(static_cast<double>(ray.time) - 0.5, 2) / count;
    earliest = std::min(earliest, ray.time), latest = std::max(latest, ray.time);
    lens += std::pow(length(exact(ray.origin) - center) / radius, 2) / count;
    middle = middle + (1.0 / count) * (exact(ray.origin) - center);
  }
  CHECK(std::abs(time - 0.5) < 4 * 0.5 / std::sqrt(12.0 * count));
  CHECK(std::abs(time2 - 0.25 / 12) < 4 * 0.25 / std::sqrt(180.0 * count));
  CHECK((earliest >= 0.25f && earliest < 0.2501f && latest > 0.7499f && latest <= 0.75f));
  CHECK(std::abs(lens - 0.5) < 4 / std::sqrt(12.0 * count));
  CHECK(length(middle) < 5 * 0.5 * radius / std::sqrt(count));
}

TEST_CASE("camera: without a lens all samples start at the centre, without a shutter at one time") {
  Scene scene = slanted();
  scene.camera.shutter_open = scene.camera.shutter_close = 0.5;
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  double x = 0, y = 0, minimum = 9, maximum = -9;
  constexpr int count = 20000;
  const Vec3f corner = compiled.camera.corner, du = compiled.camera.du, dv = compiled.camera.dv;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Ray<float> ray = sample_ray(view.view(), 30.0f, 20.0f, Sampler<float>::of(1, 30, 20, i));
    CHECK(ray.origin == compiled.camera.center);
    CHECK(ray.time == 0.5f);
    // Where in the pixel: the point of the focus plane in steps of pixels.
    const Vec3d target = length(scene.camera.look_from - scene.camera.look_at) /
                             dot(direction(ray), exact(compiled.camera.axis)) * direction(ray) -
                         exact(corner);
    const double px = dot(target, exact(du)) / dot(exact(du), exact(du)) - 30;
    const double py = dot(target, exact(dv)) / dot(exact(dv), exact(dv)) - 20;
    x += px / count, y += py / count;
    minimum = std::min({minimum, px, py}), maximum = std::max({maximum, px, py});
  }
  const double sigma = 1 / std::sqrt(12.0 * count);
  CHECK(std::abs(x - 0.5) < 4 * sigma);
  CHECK(std::abs(y - 0.5) < 4 * sigma);
  CHECK((minimum > -1e-3 && minimum < 1e-3 && maximum > 0.999 && maximum < 1.001));
}

TEST_CASE("camera: pixel (0, 0) of the rendered picture is the top left one") {
  Scene scene = dark_room();
  scene.camera = {.look_from = {0, 0, 5}, .look_at = {0, 0, 0}, .vfov = 40};
  add(scene, sphere({-1.6, 1.6, 0}, 0.2), lamp(1));  // up and to the left
  const Film film = film_of(scene, 16);
  CHECK(mean(film, film.at(2, 2)).x > 0.5f);
  CHECK(mean(film, film.at(29, 2)).x == 0.0f);
  CHECK(mean(film, film.at(2, 29)).x == 0.0f);
}

}  // namespace tyndall::test::camera_test
