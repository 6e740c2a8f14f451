#include "core/targets/kernels.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace tyndall::test::render_tile_test {

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// A matt wall on the left and a light on the right, seen straight on from so far that perspective does not matter;
/// black beyond them.
Scene wall_and_light() {
  Scene scene;
  scene.width = scene.height = 64;
  scene.camera = {.look_from = {0, 0, 1000}, .look_at = {0, 0, 0}};
  scene.camera.vfov = 2 * std::atan(1.0 / 1000) * 180 / 3.141592653589793;  // sees [-1, 1] squared at z = 0
  scene.materials = {{"wall", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"lamp", Vec3d{3, 2, 1}, Light<>{}}};
  scene.objects = {{"", Solid3d{Quad<>{{-2, -2, 0}, {2, 0, 0}, {0, 4, 0}}, 0}, {}},
                   {"", Solid3d{Quad<>{{0, -2, 0}, {2, 0, 0}, {0, 4, 0}}, 1}, {}}};
  return scene;
}

/// Glass, metal, fog, a light and a sky: every branch of the path loop.
Scene busy_scene() {
  Scene scene;
  scene.width = 61, scene.height = 47;  // not multiples of any tile or number of lanes
  scene.camera = {.look_from = {0, 1, 6}, .look_at = {0, 0.5, 0}, .vfov = 50, .defocus_angle = 1, .shutter_close = 1};
  scene.background = Gradient{};
  scene.materials = {{"floor", Vec3d{0.6, 0.5, 0.4}, Lambertian<>{}},
                     {"glass", Vec3d{1, 1, 1}, Dielectric<>{1.5}},
                     {"gold", Vec3d{0.8, 0.6, 0.2}, Metal<>{0.3}},
                     {"lamp", Vec3d{4, 4, 4}, Light<>{}}};
  const auto add = [&](auto shape, int material) { scene.objects.push_back({"", Solid3d{shape, material}, {}}); };
  add(Quad<>{{-10, 0, -10}, {20, 0, 0}, {0, 0, 20}}, 0);
  add(Sphere<>{{-1.2, 1, 0}, 1, {}}, 1);
  add(Sphere<>{{-1.2, 1, 0}, -0.8, {}}, 1);
  add(Sphere<>{{1.2, 0.7, 0}, 0.7, Vec3d{1.2, 0.9, 0}}, 2);
  add(Box<>{{-0.4, 0, -2}, {0.6, 1.5, -1}}, 0);
  add(Quad<>{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, 3);
  scene.objects.push_back({"", Volume{Box<>{{-2, 0, 0.5}, {2, 1, 2}}, {}, {0.5, 0.4}, Vec3d{0.9, 0.9, 0.9}}, {}});
  return scene;
}

struct Result {
  std::vector<FilmPixel> pixels;
  TileCounts counts;
};

Result run(const Kernels& kernels, const SceneViewOf& view, double film_quantum, const TileJob& job) {
  const auto size = static_cast<std::size_t>(job.tile.width()) * static_cast<std::size_t>(job.tile.height());
  Result result;
  result.pixels.resize(size + 64);  // room to see writes beyond the tile
  kernels.render_tile(view.view(), job, film_quantum, result.pixels.data(), result.counts);
  for (std::size_t i = size; i < result.pixels.size(); ++i) CHECK(result.pixels[i] == FilmPixel{});
  result.pixels.resize(size);
  return result;
}

Result run(const Kernels& kernels, const RenderScene& scene, const TileJob& job) {
  return run(kernels, SceneViewOf(scene), scene.film_quantum, job);
}

FilmTotals totals_of(const std::vector<FilmPixel>& pixels) {
  Film film;
  film.pixels = pixels;
  return totals(film);
}

bool empty(const FilmPixel& pixel) {
  for (const auto& half : pixel.sum)
    for (const ExactSum& sum : half)
      if (!(sum == ExactSum{})) return false;
  return true;
}

}  // namespace

TEST_CASE("render_unit: every pixel of the tile gets exactly the samples asked for") {
  const RenderScene scene = compile(busy_scene());
  for (const Kernels& kernels : available_kernels())
    for (const Region tile : {Region{0, 0, 1, 1}, Region{3, 5, 10, 10}, Region{28, 40, 61, 41}, Region{60, 0, 61, 47}})
      for (const std::uint32_t first : {0u, 7u}) {
        const Result result = run(kernels, scene, {tile, 1, 0, first, first + 3});
        for (const FilmPixel& pixel : result.pixels) CHECK(pixel.taken == 3);
        CHECK(result.counts.rays >= 3 * result.pixels.size());
        CHECK(result.counts.shadow_rays <= result.counts.rays);
        CHECK(totals_of(result.pixels).rejected == 0);
      }
}

TEST_CASE("render_unit: even samples go to one half, odd ones to the other") {
  const RenderScene scene = compile(wall_and_light());
  for (const Kernels& kernels : available_kernels())
    for (std::uint32_t first = 0; first < 4; ++first)
      for (std::uint32_t count = 1; count < 4; ++count) {
        const Result result = run(kernels, scene, {{40, 8, 48, 16}, 1, 0, first, first + count});  // the light
        const std::uint32_t odd = (first % 2 + count) / 2, even = count - odd;
        for (const FilmPixel& pixel : result.pixels) {
          CHECK(pixel.sum[0][0].value() * scene.film_quantum == 3.0 * even);
          CHECK(pixel.sum[1][1].value() * scene.film_quantum == 2.0 * odd);
        }
      }
}

TEST_CASE("render_unit: a path that carries nothing has ended, not been cut") {
  Scene black = wall_and_light();
  black.materials[0].colour = Vec3d{0, 0, 0};
  black.render.max_depth = 0;
  const RenderScene scene = compile(black);
  const Result result = run(scalar_kernels(), scene, {{0, 0, 64, 64}, 1, 0, 0, 1});
  CHECK(totals_of(result.pixels).truncated == 0);
}

TEST_CASE("render_unit: what is not a number is counted as rejected and leaves the sums clean") {
  struct Planted {
    const char* where;
    void (*plant)(RenderScene&);
  };
  const Planted faults[] = {
      {"red", [](RenderScene& s) { s.materials.colour.x[0] = not_a_number; }},
      {"green", [](RenderScene& s) { s.materials.colour.y[0] = not_a_number; }},
      {"blue", [](RenderScene& s) { s.materials.colour.z[0] = not_a_number; }},
      {"normal", [](RenderScene& s) { s.elements.center_or_normal.x[0] = not_a_number; }},
      {"infinite", [](RenderScene& s) { s.materials.colour.x[0] = std::numeric_limits<float>::infinity(); }},
  };
  for (const Vec3d sky : {Vec3d{0, 0, 0}, Vec3d{1, 1, 1}}) {
    Scene settings = wall_and_light();
    settings.background = sky;
    for (const Kernels& kernels : available_kernels())
      for (const Planted& fault : faults) {
        RenderScene scene = compile(settings);
        fault.plant(scene);
        const Result result = run(kernels, scene, {{0, 0, 64, 64}, 1, 0, 0, 4});
        CAPTURE(std::string(fault.where));
        CAPTURE(std::string(kernels.isa));
        CAPTURE(sky.x);
        int wrong = 0;
        for (int i = 0; i < 64 * 64; ++i) {
          if (i % 64 == 31 || i % 64 == 32) continue;  // these pixels see both the wall and the light
          const FilmPixel& pixel = result.pixels[static_cast<std::size_t>(i)];
          const bool wall = i % 64 < 31;
          const std::uint32_t rejected = pixel.rejected[0] + pixel.rejected[1];
          wrong += pixel.taken == 4 && rejected == (wall ? 4 : 0) && empty(pixel) == wall ? 0 : 1;
        }
        CHECK(wrong == 0);
      }
  }
}

TEST_CASE("render_unit: what a lamp or the sky sends that is no number or out of range is rejected") {
  for (const float bad : {not_a_number, std::numeric_limits<float>::infinity(), 1e30f}) {
    Scene settings = wall_and_light();
    settings.background = Vec3d{1, 1, 1};
    RenderScene lamp = compile(settings), sky = lamp;
    lamp.materials.colour.y[1] = bad;
    sky.background.a.z = bad;
    for (const Kernels& kernels : available_kernels()) {
      const Result by_light = run(kernels, lamp, {{40, 0, 64, 64}, 1, 0, 0, 2});
      CHECK(totals_of(by_light.pixels).rejected == 24 * 64 * 2);
      // The sky lights nothing but the wall.
      const Result by_sky = run(kernels, sky, {{0, 0, 30, 64}, 1, 0, 0, 2});
      CHECK(totals_of(by_sky.pixels).rejected == 30 * 64 * 2);
      for (const FilmPixel& pixel : by_sky.pixels) CHECK(empty(pixel));
    }
  }
}

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

}  // namespace tyndall::test::render_tile_test
