#include "core/targets/replay.h"

#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>

namespace tyndall::test::replay_test {

namespace {

/// What the scalar kernel puts into the film for one sample.
FilmPixel film_pixel(const RenderScene& scene, const SceneView& view, int x, int y, std::uint32_t sample) {
  FilmPixel pixel{};
  TileCounts counts;
  scalar_kernels().render_tile(view, {{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1}, scene.film_quantum, &pixel,
                               counts);
  return pixel;
}

std::ptrdiff_t branches_of(const PathReplay& path) {
  return std::count_if(path.vertices.begin(), path.vertices.end(), [](const PathVertex& v) { return v.branch; });
}

/// What a replayed sample would put there.
FilmPixel replayed_pixel(const RenderScene& scene, const PathReplay& path, std::uint32_t sample) {
  FilmPixel pixel{};
  const bool branches = branches_of(path) > 0;
  if (!branches) add_sample(pixel, sample & 1u, path.radiance, 1 / scene.film_quantum);
  for (const PathVertex& v : path.vertices) {
    if (branches && v.fate != Fate::goes_on) add_sample(pixel, sample & 1u, v.radiance, 1 / scene.film_quantum);
    pixel.truncated += v.fate == Fate::cut ? 1 : 0;
  }
  pixel.taken = 1;
  return pixel;
}

}  // namespace

TEST_CASE("replay: every sample is, bit for bit, the scalar kernel's") {
  std::map<Fate, int> fates;
  std::map<Met, int> met;
  int branches = 0;
  for (const char* name :
       {"showroom", "next-week", "close up", "caustic close up", "cornell-smoke", "bouncing-spheres", "hollow-glass",
        "earth", "stress-caustic-mirror", "stress-light-in-fog", "stress-medium-in-glass", "stress-light-and-fuzz"}) {
    const std::string chosen = name;
    const bool reuses_paths = chosen == "close up" || chosen == "caustic close up";
    Scene settings = chosen == "close up" ? close_up("cornell-smoke", 24, 18)
                     : reuses_paths       ? caustic_close_up(24, 18)
                                          : small_scene(chosen, 24, 18, 1);
    settings.render.max_depth = 12;
    const RenderScene scene = compile(settings);
    const SceneViewOf view(scene);
    CHECK(view.view().reuses_paths == reuses_paths);
    int wrong = 0;
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 24; ++x)
        for (const std::uint32_t sample : {0u, 1u, 1000003u}) {
          const PathReplay path = replay(view.view(), x, y, sample);
          wrong += replayed_pixel(scene, path, sample) == film_pixel(scene, view.view(), x, y, sample) ? 0 : 1;
          for (const PathVertex& v : path.vertices) ++fates[v.fate], ++met[v.met];
          branches += static_cast<int>(branches_of(path));
          for (std::size_t k = 0; k < path.vertices.size(); ++k) {
            const PathVertex& v = path.vertices[k];
            const PathVertex* before = v.before < 0 ? nullptr : &path.vertices[static_cast<std::size_t>(v.before)];
            wrong += v.first_dimension == (before ? before->first_dimension + 16 : 8) ? 0 : 1;
            if (before && !v.branch) wrong += before + 1 == &v && before->fate == Fate::goes_on ? 0 : 1;
          }
        }
    CAPTURE(name);
    CHECK(wrong == 0);
  }
  for (const Fate fate : {Fate::goes_on, Fate::ends_at_light, Fate::escapes, Fate::absorbed, Fate::roulette, Fate::cut})
    CHECK(fates[fate] > 10);
  CHECK(met[Met::medium] > 100);
  CHECK(branches > 100);
}

TEST_CASE("replay: names the surfaces in order, with the way between them and what is carried") {
  // Through a sphere of matched glass to a grey wall, and from there to the white sky or a second time to the wall.
  Scene scene = white_room();
  add(scene, sphere({0, 0, 0}, 1), glass(1));
  add(scene, Quad<>{{-9, -9, -3}, {18, 0, 0}, {0, 18, 0}}, lambertian(0.5));
  aim(scene, {0, 0, 5}, {0, 0, 0});
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const PathReplay path = replay(view.view(), 3, 4, 5);
  REQUIRE(path.vertices.size() == 4);
  CHECK(path.vertices[0].element == 0);
  CHECK(path.vertices[0].inside);
  CHECK(path.vertices[0].distance == doctest::Approx(4));
  CHECK(path.vertices[1].element == 0);
  CHECK_FALSE(path.vertices[1].inside);
  CHECK(path.vertices[1].distance == doctest::Approx(2));
  CHECK(path.vertices[2].element == 1);
  CHECK(path.vertices[2].distance == doctest::Approx(2));
  CHECK(path.vertices[2].throughput == Vec3f{1, 1, 1});
  CHECK(path.vertices[3].met == Met::nothing);
  CHECK(path.vertices[3].throughput == Vec3f{0.5f, 0.5f, 0.5f});
  CHECK(path.radiance == Vec3f{0.5f, 0.5f, 0.5f});
  for (std::size_t k = 0; k < 3; ++k) {
    const double z[] = {1, -1, -3};
    CHECK(static_cast<double>(path.vertices[k].point.z) + compiled.origin.z == doctest::Approx(z[k]));
  }
}

TEST_CASE("replay: shows the other way at glass as a branch, with its part of the light") {
  Scene scene = white_room();
  scene.render.integrator = Integrator::mis;
  add(scene, sphere({0, 0, 0}, 1), glass(5));
  aim(scene, {0, 0, 5}, {0, 0, 0});
  const RenderScene compiled = compile(scene);
  const SceneViewOf view(compiled);
  const PathReplay path = replay(view.view(), 3, 4, 5);
  const double reflected = 4.0 / 9, passed = 1 - reflected;  // at each surface: ((5 - 1) / (5 + 1))^2
  REQUIRE(path.vertices.size() > 3);
  CHECK(path.vertices[2].met == Met::nothing);
  // At the back 4/9 of 5/9 would branch off, which is less than min_branch. So that is what the branch carries, if any.
  CHECK(static_cast<double>(path.vertices[2].throughput.x) == doctest::Approx(passed - 0.25));
  const auto front = std::find_if(path.vertices.begin(), path.vertices.end(),
                                  [](const PathVertex& v) { return v.branch && v.before == 0; });
  REQUIRE(front != path.vertices.end());
  CHECK(front->met == Met::nothing);
  CHECK(static_cast<double>(front->throughput.x) == doctest::Approx(reflected));
  CHECK(static_cast<double>(front->radiance.x) == doctest::Approx(reflected));
  CHECK(static_cast<double>(path.radiance.x) == doctest::Approx(1));
}

TEST_CASE("replay: says what smoke has left of a path's light") {
  for (const double density : {0.5, 1e6}) {
    Scene scene = white_room();
    scene.render.integrator = Integrator::mis;
    add(scene, Quad<>{{-9, -9, -3}, {18, 0, 0}, {0, 18, 0}}, lambertian(0.5));
    add_medium(scene, sphere({0, 0, 0}, 1), {density, 0}, 0);
    aim(scene, {0, 0, 5}, {0, 0, 0});
    const RenderScene compiled = compile(scene);
    const SceneViewOf view(compiled);
    const PathReplay path = replay(view.view(), 3, 4, 5);
    const double left = density < 1 ? std::exp(-1) : 0;
    CHECK(static_cast<double>(path.vertices[0].kept) == doctest::Approx(left));
    CHECK(static_cast<double>(path.vertices[0].throughput.x) == doctest::Approx(left));
    CHECK(path.vertices[0].met == Met::surface);
    CHECK(path.vertices[0].fate == (left > 0 ? Fate::goes_on : Fate::absorbed));
    CHECK(static_cast<double>(path.radiance.x) == doctest::Approx(0.5 * left));
  }
}

TEST_CASE("replay: shows where a number was lost") {
  Scene scene = white_room();
  add(scene, Quad<>{{-9, -9, -3}, {18, 0, 0}, {0, 18, 0}}, lambertian(0.5));
  aim(scene, {0, 0, 5}, {0, 0, 0});
  RenderScene compiled = compile(scene);
  compiled.materials.colour.y[0] = std::numeric_limits<float>::quiet_NaN();
  const SceneViewOf view(compiled);
  const PathReplay path = replay(view.view(), 0, 0, 0);
  CHECK(path.vertices.size() == 1);
  CHECK(path.vertices[0].fate == Fate::lost);
  CHECK(std::isnan(path.radiance.x));
}

TEST_CASE("replay: says what chains add, and how much a lamp counts that they find too") {
  Scene scene = dark_room();
  scene.render.integrator = Integrator::mis;
  add(scene, Quad<>{{-6, 0, -6}, {0, 0, 12}, {12, 0, 0}}, lambertian(0.7));
  add(scene, sphere({0, 5.2, 0}, 0.59), lamp(12));
  add(scene, sphere({0, 1.2, 0}, 1), glass(1.5));
  aim(scene, {0, 0.1, 5}, {0, 0, 0.1});
  const auto tell = [](const Scene& told) {
    const RenderScene compiled = compile(told);
    const SceneViewOf view(compiled);
    int by_specular_paths = 0, shared = 0;
    for (std::uint32_t sample = 0; sample < 400; ++sample) {
      const PathReplay path = replay(view.view(), 1, 2, sample);
      for (const PathVertex& v : path.vertices) {
        by_specular_paths += v.by_specular_paths.x > 0 && v.by_specular_paths.x <= v.radiance.x ? 1 : 0;
        shared += v.chance < 1 && v.fate == Fate::ends_at_light ? 1 : 0;
      }
    }
    return std::pair{by_specular_paths, shared};
  };
  const auto [by_specular_paths, shared] = tell(scene);
  CHECK(by_specular_paths > 50);
  CHECK(shared > 5);
  scene.render.caustics = Caustics::scatter;
  CHECK(tell(scene) == std::pair{0, 0});
}

}  // namespace tyndall::test::replay_test
