#include "core/targets/kernels.h"
#include "tests/support/pictures.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Both ways at smooth glass that the camera sees (core/transport/splitting.h).
namespace tyndall::test::splitting_test {

namespace {

RenderResult rendered(const Scene& scene, std::uint32_t spp, const std::string& isa = "") {
  return render(*prepare(scene), {.isa = isa, .spp = spp});
}

/// Sum over the pixels of the squared difference of their halves: how noisy a picture is.
double noise(const Film& film) {
  double sum = 0;
  for (const FilmPixel& pixel : film.pixels) {
    const double apart = static_cast<double>(half_mean(film, pixel, 0).y - half_mean(film, pixel, 1).y);
    sum += apart * apart;
  }
  return sum;
}

/// A glass sphere that fills the picture, under a sky that is white above and black below.
Scene sphere_under_sky() {
  Scene scene = white_room();
  scene.background = Hemispheres{{1, 1, 1}, {0, 0, 0}};
  scene.render.integrator = Integrator::mis;
  add(scene, sphere({0, 0, 0}, 1), glass(1.5));
  aim(scene, {0, 0, 5}, {0, 0, 0});
  scene.camera.vfov = 16;
  return scene;
}

}  // namespace

TEST_CASE("splitting: glass keeps its mean and loses most of its noise") {
  Scene scene = sphere_under_sky();
  const RenderResult both = rendered(scene, 64);
  scene.render.integrator = Integrator::path;
  const RenderResult one = rendered(scene, 64);
  CHECK(both.split_events > 10000);
  CHECK(one.split_events == 0);
  CHECK(noise(both.film) < 0.25 * noise(one.film));
  check_agree(picture_mean(both.film), picture_mean(one.film));
}

TEST_CASE("splitting: every sample counts once, and every instruction set splits the same paths") {
  for (const char* name : {"hollow-glass", "showroom", "stress-shell-in-fog"}) {
    CAPTURE(name);
    const Scene scene = small_scene(name, 40, 30, 1);
    const RenderResult scalar = rendered(scene, 3, "scalar");
    const FilmTotals sum = totals(scalar.film);
    CHECK(sum.samples == 40 * 30 * 3);
    CHECK(sum.min_taken == 3);
    CHECK(sum.max_taken == 3);
    CHECK(scalar.split_events > 100);
    for (const Kernels& kernels : available_kernels()) {
      const RenderResult wide = rendered(scene, 3, kernels.isa);
      CHECK(static_cast<double>(wide.split_events) ==
            doctest::Approx(static_cast<double>(scalar.split_events)).epsilon(0.01));
    }
  }
}

TEST_CASE("splitting: the parts of a path are the whole path") {
  Scene scene = sphere_under_sky();
  scene.background = Vec3d{1, 1, 1};
  add(scene, sphere({0, 0, 0}, 0.9), glass(1 / 1.5));
  add(scene, sphere({0.2, 0.3, 0}, 0.3), glass(2.4));
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(kernels.isa);
    const RenderResult sample = rendered(scene, 1, kernels.isa);
    CHECK(static_cast<std::size_t>(sample.split_events) > sample.film.pixels.size() / 8);
    for (const FilmPixel& pixel : sample.film.pixels)
      REQUIRE(mean(sample.film, pixel).x == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("splitting: also where second vertices are shared, by every kernel") {
  Scene scene = small_scene("stress-white-room", 48, 36, 1);
  scene.objects.pop_back();  // the lamp, which is so small that specular paths would be solved for
  add(scene, sphere({0, 0, 0}, 0.3), lamp(1));
  add(scene, sphere({0.45, 0, 0.1}, 0.1), glass(1.5));
  aim(scene, {-0.3, 0, 0.7}, {0.45, 0, 0.1});
  scene.camera.vfov = 70;
  RenderScene columns = compile(scene);
  REQUIRE(SceneViewOf(columns).view().reuses_paths);
  REQUIRE(columns.kernel == KernelSet::specular_paths_only);
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(kernels.isa);
    const RenderOptions options{.isa = kernels.isa, .spp = 4};
    columns.kernel = KernelSet::specular_paths_only;
    const RenderResult small = render(columns, options);
    columns.kernel = KernelSet::everything;
    const RenderResult full = render(columns, options);
    CHECK(small.split_events > 20);
    CHECK(small.split_events == full.split_events);
    CHECK(small.film == full.film);
  }
}

TEST_CASE("splitting: is a part of mis with chains") {
  const Scene scene = small_scene("showroom", 24, 18, 1);
  const auto splits = [&](auto change) {
    Scene changed = scene;
    change(changed.render);
    return rendered(changed, 2).split_events > 0;
  };
  CHECK(splits([](RenderSettings&) {}));
  CHECK_FALSE(splits([](RenderSettings& s) { s.caustics = Caustics::scatter; }));
  CHECK_FALSE(splits([](RenderSettings& s) { s.integrator = Integrator::nee; }));
  CHECK_FALSE(splits([](RenderSettings& s) { s.integrator = Integrator::path; }));
  CHECK_FALSE(splits([](RenderSettings& s) { s.fresnel = FresnelKind::schlick; }));
}

}  // namespace tyndall::test::splitting_test
