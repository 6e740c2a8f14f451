#include "core/trace/camera.h"

#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// The camera: which ray belongs to which pixel, the thin lens, focus.
namespace tyndall::test::camera_test {

namespace {

Vec3d widen(Vec3f v) { return {v.x, v.y, v.z}; }

Ray<double> ray_through(const Scene& scene, double x, double y, Pair<double> lens = {0, 0}) {
  return camera_ray(compile(scene).camera, x, y, lens, 0.0);
}

/// Where a ray meets the plane at `depth` along the axis, in the camera's right and up directions.
Pair<double> at_depth(const Scene& scene, Vec3d origin, Vec3d direction, double depth) {
  const Camera& c = scene.camera;
  const Vec3d w = normalize(c.look_at - c.look_from), right = normalize(cross(w, c.vup)),
              up_in_picture = cross(right, w);
  const Vec3d from = origin - (c.look_from - compile(scene).origin);
  const Vec3d at = point_at(from, (depth - dot(from, w)) / dot(direction, w), direction);
  return {dot(at, right), dot(at, up_in_picture)};
}

Scene slanted_camera() {
  Scene scene = white_room();
  scene.width = 64, scene.height = 48;
  scene.camera = {.look_from = {1, 2, 3}, .look_at = {-2, 0.5, 1}, .vup = {0.2, 1, -0.1}, .vfov = 50};
  return scene;
}

}  // namespace

TEST_CASE("camera: the picture's edges lie where vfov says, its upper left corner is pixel (0, 0)") {
  const Scene scene = slanted_camera();
  const double top = std::tan(25 * (pi / 180)), side = top * 64 / 48;
  const auto check = [&](double x, double y, double across, double upward) {
    const Ray<double> ray = ray_through(scene, x, y);
    CHECK(length(ray.direction) == doctest::Approx(1).epsilon(1e-12).scale(0));
    const Pair<double> p = at_depth(scene, ray.origin, ray.direction, 1);
    CHECK(p.x == doctest::Approx(across).epsilon(1e-6));
    CHECK(p.y == doctest::Approx(upward).epsilon(1e-6));
  };
  check(0, 0, -side, top);
  check(64, 0, side, top);
  check(0, 48, -side, -top);
  check(32, 24, 0, 0);
  check(48, 12, side / 2, top / 2);
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

TEST_CASE("camera: samples fill their pixel evenly and nothing else") {
  Scene scene = white_room();
  scene.width = 3, scene.height = 2;
  scene.camera = {.look_from = {0, 0, 1}, .look_at = {0, 0, 0}};
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  std::vector<double> xs, ys;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Ray<float> ray = sample_ray(view.view(), 2.0f, 1.0f, Sampler<float>::of(0, 2, 1, i));
    const Pair<double> p = at_depth(scene, widen(ray.origin), widen(ray.direction), 1);
    const double x = p.x + 1.5, y = 1 - p.y;  // the picture is 2 units high: a pixel is one
    REQUIRE(std::abs(x - 2.5) < 0.500001);
    REQUIRE(std::abs(y - 1.5) < 0.500001);
    xs.push_back(x - 2), ys.push_back(y - 1);
  }
  CHECK(kolmogorov_smirnov(xs, [](double v) { return v; }) < 2.23);
  CHECK(kolmogorov_smirnov(ys, [](double v) { return v; }) < 2.23);
}

TEST_CASE("lens: rays start evenly on a disc and meet in the plane of focus") {
  Scene scene = slanted_camera();
  scene.camera.defocus_angle = 10;
  scene.camera.focus_distance = 3.4;
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const double radius = 0.2974614559881416;
  const Vec3d middle = scene.camera.look_from - compiled.origin;
  std::vector<double> squares, azimuths;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const Ray<float> ray = sample_ray(view.view(), 20.0f, 11.0f, Sampler<float>::of(0, 20, 11, i));
    const Vec3d start = widen(ray.origin) - middle;
    const Pair<double> on_lens = at_depth(scene, widen(ray.origin), widen(ray.direction), 0);
    REQUIRE(length(start) <= radius * 1.000001);
    REQUIRE(std::abs(length(start) - std::hypot(on_lens.x, on_lens.y)) < 1e-6);  // in the lens' plane
    squares.push_back(dot(start, start) / (radius * radius));
    azimuths.push_back(std::atan2(on_lens.y, on_lens.x) / (2 * pi) + 0.5);
  }
  CHECK(kolmogorov_smirnov(squares, [](double v) { return v; }) < 2.23);
  CHECK(kolmogorov_smirnov(azimuths, [](double v) { return v; }) < 2.23);
  const Pair<double> sharp =
      at_depth(scene, ray_through(scene, 20, 11).origin, ray_through(scene, 20, 11).direction, 3.4);
  for (const Pair<double> lens : {Pair<double>{1, 0}, Pair<double>{-0.6, 0.8}, Pair<double>{0, -0.5}}) {
    const Ray<double> ray = ray_through(scene, 20, 11, lens);
    const Pair<double> p = at_depth(scene, ray.origin, ray.direction, 3.4);
    CHECK(p.x == doctest::Approx(sharp.x).epsilon(1e-6).scale(0));
    CHECK(p.y == doctest::Approx(sharp.y).epsilon(1e-6).scale(0));
  }
}

TEST_CASE("lens: without defocus the focus distance changes nothing; absent, it is the distance looked at") {
  Scene scene = white_room();
  scene.background = Gradient{};
  scene.camera = {.look_from = {0, 0.5, 4}, .look_at = {0, 0, 0}};
  add(scene, sphere({0, 0, 0}, 1), lambertian(0.5));
  const std::vector<float> sharp = resolve(film_of(scene, 4));
  scene.camera.focus_distance = 8 * length(scene.camera.look_from);
  CHECK(resolve(film_of(scene, 4)) == sharp);
  scene.camera.defocus_angle = 2;
  scene.camera.focus_distance = length(scene.camera.look_from);
  const std::vector<float> blurred = resolve(film_of(scene, 4));
  scene.camera.focus_distance.reset();
  CHECK(resolve(film_of(scene, 4)) == blurred);
  CHECK(blurred != sharp);
}

}  // namespace tyndall::test::camera_test
