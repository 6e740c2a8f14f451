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

/// A whole image from units of the given edge and number of samples.
std::vector<FilmPixel> image(const Kernels& kernels, const RenderScene& scene, int tile, std::uint32_t samples,
                             std::uint32_t at_once) {
  std::vector<FilmPixel> all(static_cast<std::size_t>(scene.width * scene.height));
  const SceneViewOf view(scene);  // prepared once
  for (std::uint32_t first = 0; first < samples; first += at_once)
    for (int y = 0; y < scene.height; y += tile)
      for (int x = 0; x < scene.width; x += tile) {
        const Region where{x, y, std::min(x + tile, scene.width), std::min(y + tile, scene.height)};
        const TileJob job{where, 1, 0, first, std::min(first + at_once, samples)};
        const Result part = run(kernels, view, scene.film_quantum, job);
        for (int row = where.y0; row < where.y1; ++row)
          for (int column = where.x0; column < where.x1; ++column)
            add_pixel(all[static_cast<std::size_t>(row * scene.width + column)],
                      part.pixels[static_cast<std::size_t>((row - y) * where.width() + column - x)]);
      }
  return all;
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

TEST_CASE("render_unit: no samples, and the largest tile") {
  Scene big = wall_and_light();
  const RenderScene scene = compile(big);
  for (const Kernels& kernels : available_kernels()) {
    const Result none = run(kernels, scene, {{0, 0, 64, 64}, 1, 0, 5, 5});
    CHECK(none.counts.rays == 0);
    for (const FilmPixel& pixel : none.pixels) CHECK(pixel == FilmPixel{});
    const Result all = run(kernels, scene, {{0, 0, 64, 64}, 1, 0, 0, 1});
    CHECK(totals_of(all.pixels).samples == 64 * 64);
    CHECK(totals_of(all.pixels).min_taken == 1);
  }
}

TEST_CASE("render_unit: coarse passes and the finer ones that skip them partition the pixels") {
  const RenderScene scene = compile(busy_scene());
  for (const Kernels& kernels : available_kernels()) {
    const Region tile{5, 3, 59, 46};
    const Result whole = run(kernels, scene, {tile, 1, 0, 0, 1});
    std::vector<FilmPixel> sum(whole.pixels.size());
    for (const TileJob& job :
         {TileJob{tile, 8, 0, 0, 1}, TileJob{tile, 4, 8, 0, 1}, TileJob{tile, 2, 4, 0, 1}, TileJob{tile, 1, 2, 0, 1}}) {
      const Result part = run(kernels, scene, job);
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const int x = tile.x0 + static_cast<int>(i) % tile.width(), y = tile.y0 + static_cast<int>(i) / tile.width();
        const bool meant = x % job.step == 0 && y % job.step == 0 &&
                           !(job.skip_step && x % job.skip_step == 0 && y % job.skip_step == 0);
        CHECK(part.pixels[i].taken == (meant ? 1 : 0));
        add_pixel(sum[i], part.pixels[i]);
      }
    }
    CHECK(sum == whole.pixels);
  }
}

TEST_CASE("render_unit: tiles and the order of samples change no bit") {
  const RenderScene scene = compile(busy_scene());
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(std::string(kernels.isa));
    const std::vector<FilmPixel> whole = image(kernels, scene, 61, 6, 6);
    CHECK(image(kernels, scene, 8, 6, 1) == whole);
    CHECK(image(kernels, scene, 13, 6, 4) == whole);
    CHECK(totals_of(whole).samples == 61 * 47 * 6);
  }
}

TEST_CASE("render_unit: depth 0 shows lamps and counts every path that would have gone on") {
  Scene settings = wall_and_light();
  settings.render.max_depth = 0;
  const RenderScene scene = compile(settings);
  for (const Kernels& kernels : available_kernels()) {
    const Result result = run(kernels, scene, {{0, 0, 64, 64}, 1, 0, 0, 4});
    Film film = make_film(64, 64, {0, 0, 64, 64}, 0, scene.film_quantum);
    film.pixels = result.pixels;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        if (x == 31 || x == 32) continue;  // these pixels see both the wall and the light
        const bool lamp = x > 31;
        CHECK(mean(film, film.at(x, y)) == (lamp ? Vec3f{3, 2, 1} : Vec3f{0, 0, 0}));
        CHECK(film.at(x, y).truncated == (lamp ? 0 : 4));
      }
    CHECK(result.counts.rays == 64 * 64 * 4);
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

}  // namespace tyndall::test::render_tile_test
