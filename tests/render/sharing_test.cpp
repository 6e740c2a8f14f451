#include "core/render/pass.h"
#include "core/reuse/probe.h"
#include "core/reuse/reuse_tile.h"
#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>

/// Second vertices that are shared between pixels: the light is what separate paths find, with less noise.
namespace tyndall::test::sharing_test {

namespace {

/// A picture for which a scene's second vertices are shared, or not, whatever the probe says.
Film picture_of(Scene scene, bool sharing, std::uint32_t seed, std::uint32_t spp) {
  scene.render.seed = seed;
  const RenderScene compiled = compile(scene);
  CHECK(compiled.may_reuse_paths);
  const SceneViewOf of_scene(compiled);
  SceneView view = of_scene.view();
  view.reuses_paths = sharing;
  Film film = make_film(scene.width, scene.height, {0, 0, scene.width, scene.height}, 0, compiled.film_quantum);
  Pass pass(film.region, 0, spp, 1, 0, {0, sharing});
  ThreadPool thread_pool(2);
  const std::atomic<bool> give_up = false;
  CHECK(pass.run({thread_pool, available_kernels().back(), view}, film, give_up));
  return film;
}

/// A value for each pixel or block: all three channels added.
using Values = std::vector<double>;

/// Means over blocks of `size` by `size` pixels.
Values block_means(const Film& film, int size) {
  const std::vector<float> rgb = resolve(film);
  const int columns = film.width / size;
  Values means(static_cast<std::size_t>(columns * (film.height / size)));
  for (int y = 0; y < film.height / size * size; ++y)
    for (int x = 0; x < columns * size; ++x)
      for (int c = 0; c < 3; ++c)
        means[static_cast<std::size_t>(y / size * columns + x / size)] +=
            static_cast<double>(rgb[film.index(x, y) * 3 + static_cast<std::size_t>(c)]) / (size * size);
  return means;
}

/// The estimate of one of the values from pictures of different seeds.
Estimate estimate_at(const std::vector<Values>& pictures, std::size_t i) {
  std::vector<double> values;
  for (const Values& picture : pictures) values.push_back(picture[i]);
  return estimate(values);
}

/// Relative variance of the means over all pictures, added up over the values.
double noise(const std::vector<Values>& pictures) {
  double sum = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i) {
    const Estimate value = estimate_at(pictures, i);
    sum += value.error * value.error / (value.mean * value.mean + 0.1);
  }
  return sum;
}

Scene box(int size) { return small_scene("cornell-box", size, size, 1); }

/// Posts close to the back wall: what one pixel sees is often hidden from what its neighbour sees. Every other one is
/// so dark that roulette would end most paths at their first event.
Scene room_with_posts() {
  Scene scene = box(48);
  for (int i = 0; i < 9; ++i) {
    const double x = 20 + 60 * i;
    add(scene, Box<>{{x, 0, 500}, {x + 25, 555, 520}}, lambertian(i % 2 ? 0.03 : 0.7));
  }
  return scene;
}

/// Media in half of the room, so that groups see walls and media together, and a wall that reflects no green.
Scene room_with_medium() {
  Scene scene = box(48);
  add_medium(scene, Box<>{{1, 1, 1}, {554, 300, 554}}, {2e-2}, 0.95);
  for (Material& m : scene.materials)
    if (Vec3d* colour = std::get_if<Vec3d>(&m.colour); colour && colour->x > 2 * colour->y) *colour = {0.65, 0, 0};
  return scene;
}

}  // namespace

TEST_CASE("sharing: what leaves the blocks of a picture is what separate paths find") {
  const std::pair<const char*, Scene> cases[] = {{"fog", room_with_medium()},
                                                 {"glass ball", small_scene("stress-caustic-glass", 64, 48, 1)},
                                                 {"room", box(48)},
                                                 {"posts", room_with_posts()},
                                                 {"mirror ball", small_scene("stress-caustic-mirror", 64, 48, 1)},
                                                 {"shell in fog", small_scene("stress-caustic-shell", 64, 48, 1)},
                                                 {"flat mirrors", small_scene("stress-mirror-wall", 64, 48, 1)}};
  for (const auto& one : tried(cases, 2)) {
    const Scene& scene = one.second;
    CAPTURE(std::string(one.first));
    std::vector<Values> shared, alone;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
      shared.push_back(block_means(picture_of(scene, true, seed, 64), 8));
      alone.push_back(block_means(picture_of(scene, false, seed + 100, 64), 8));
    }
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < shared[0].size(); ++i) {
      const Estimate with = estimate_at(shared, i), without = estimate_at(alone, i);
      if (with.error == 0 && without.error == 0) {
        CHECK(std::abs(with.mean - without.mean) <= 1e-5 * without.mean);
        continue;
      }
      const double z = (with.mean - without.mean) / std::hypot(with.error, without.error);
      CHECK(std::abs(z) < 5.5);  // the errors themselves are known from 12 seeds only
      squares += z * z, ++count;
    }
    CHECK(count > 20);
    // With 11 degrees of freedom on each side the mean of the squares is 22/20.
    CHECK(squares / count == doctest::Approx(1.1).epsilon(4 * std::sqrt(2 / count)).scale(0));
  }
}

TEST_CASE("sharing: rooms have far less noise") {
  const std::pair<Scene, double> cases[] = {{box(128), 0.4},
                                            {small_scene("cornell-smoke", 128, 128, 1), 0.7},
                                            {small_scene("stress-white-room", 48, 48, 1), 0.5},
                                            {small_scene("stress-caustic-mirror", 200, 150, 1), 0.6}};
  for (const auto& [scene, less] : cases) {
    std::vector<Values> shared, alone;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      shared.push_back(block_means(picture_of(scene, true, seed, 8), 1));
      alone.push_back(block_means(picture_of(scene, false, seed, 8), 1));
    }
    CHECK(noise(shared) < less * noise(alone));
  }
}

TEST_CASE("sharing: a scene reuses paths where a probe says that it pays, whatever its seed") {
  const auto reuses_paths = [](const char* name, auto change) {
    Scene scene = load_scene(name).scene;
    change(scene);
    return SceneViewOf(compile(scene)).view().reuses_paths;
  };
  const auto as_it_is = [](Scene&) {};
  for (const char* name : {"cornell-box", "cornell-smoke", "stress-white-room", "stress-caustic-mirror"})
    CHECK(reuses_paths(name, as_it_is));
  for (const char* name : {"cover", "showroom", "next-week", "quads", "checkered-spheres", "stress-dense-fog"})
    CHECK_FALSE(reuses_paths(name, as_it_is));
  for (const std::uint32_t seed : {1u, 77u})
    CHECK(reuses_paths("cornell-box", [&](Scene& s) { s.render.seed = seed; }));
  CHECK_FALSE(reuses_paths("cornell-box", [](Scene& s) { s.render.sharing = false; }));
  CHECK_FALSE(reuses_paths("cornell-box", [](Scene& s) { s.render.integrator = Integrator::path; }));
  CHECK_FALSE(reuses_paths("cornell-box", [](Scene& s) { s.width = s.height = 1; }));
}

TEST_CASE("sharing: the probe is near to what sharing changes") {
  const Scene box = small_scene("cornell-box", 256, 256, 1);
  const RenderScene compiled = compile(box);
  const ReuseGain gain = probe_reuse(SceneViewOf(compiled).view(), trace_groups);
  CHECK(gain.variance == doctest::Approx(0.2).epsilon(0.4).scale(0));
  CHECK(gain.time == doctest::Approx(1.3).epsilon(0.2).scale(0));
}

TEST_CASE("sharing: the pdf of a link between two floors falls with the square of its length") {
  const RenderScene empty = compile(Scene{});
  const SceneViewOf view(empty);
  const auto paths = std::make_unique<ReusedPaths>();
  paths->first.facing[1][0] = 1, paths->second.facing[1][1] = -1;
  paths->first.surface[0] = from_nowhere, paths->second.surface[1] = -1;
  const auto pdf = [&](float length) {
    TileCounts counts;
    paths->second.point[1][1] = length;
    return link_pdf<float>(view.view(), *paths, 0, 1, true, counts);
  };
  CHECK(pdf(1) == 1);
  CHECK(pdf(2) == 0.25f);
}

TEST_CASE("sharing: the second sample of a pixel is in the second half, and coarse passes take every step-th pixel") {
  const Scene scene = close_up("cornell-box", 37, 29);
  const Film one = picture_of(scene, true, 0, 1), two = picture_of(scene, true, 0, 2);
  for (std::size_t i = 0; i < one.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c) REQUIRE(two.pixels[i].sum[0][c] == one.pixels[i].sum[0][c]);
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  REQUIRE(view.view().reuses_paths);
  std::vector<FilmPixel> pixels(one.pixels.size());
  TileCounts counts;
  available_kernels().back().render_tile(view.view(), {{0, 0, 37, 29}, 4, 0, 0, 1}, one.quantum, pixels.data(), counts);
  const auto taken =
      std::count_if(pixels.begin(), pixels.end(), [](const FilmPixel& pixel) { return pixel.taken > 0; });
  CHECK(taken == 10 * 8);
}

TEST_CASE("sharing: pixels that lack different numbers of samples get the samples of their groups") {
  const Scene scene = close_up("cornell-box", 37, 29);
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  REQUIRE(view.view().reuses_paths);
  const Film few = picture_of(scene, true, 0, 2), whole = picture_of(scene, true, 0, 9);
  std::vector<std::uint32_t> wanted(few.pixels.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = i % 3 == 0 ? 9 : i % 3 == 1 ? 5 : 2;
  ThreadPool thread_pool(2);
  const std::atomic<bool> give_up = false;
  for (const int edge : {0, 5, 16}) {
    Film film = few;
    Pass pass(film, wanted, film.region, {edge, true});
    CHECK(pass.run({thread_pool, available_kernels().back(), view.view()}, film, give_up));
    const Film middle = picture_of(scene, true, 0, 5);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Film& expected = wanted[i] == 9 ? whole : wanted[i] == 5 ? middle : few;
      REQUIRE(film.pixels[i] == expected.pixels[i]);
    }
  }
}

}  // namespace tyndall::test::sharing_test
