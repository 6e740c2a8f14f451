#include "tests/support/capture.h"
#include "tests/support/probe.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

/// Glass against closed forms that sum all internal reflections.
namespace tyndall::test::glass_test {

TEST_CASE("glass plate: reflects and transmits what all internal reflections add up to") {
  struct Case {
    double index, degrees, reflected, with_schlick;
  };
  constexpr Case cases[] = {
      {1.333, 0, 0.03993281690409661, 0.03993281690409661},  {1.333, 45, 0.054282340665609795, 0.042077572734637234},
      {1.333, 60, 0.11265722503617397, 0.07064232636114723}, {1.333, 80, 0.5162287924220962, 0.41194962279699926},
      {1.5, 0, 0.07692307692307694, 0.07692307692307694},    {1.5, 45, 0.0956732085411113, 0.0789322819285995},
      {1.5, 60, 0.1637675372898316, 0.1059409523583672},     {1.5, 80, 0.5587708266256333, 0.4330745145246487},
      {2.417, 0, 0.29346997590870005, 0.2934699759087001},   {2.417, 45, 0.306686443375737, 0.29499297616768416},
      {2.417, 60, 0.34882880159370383, 0.3155496631469594},  {2.417, 80, 0.6046329786326626, 0.5657137619548231}};
  ZScores scores;
  std::uint32_t seed = 0;
  for (const Case& c : cases)
    for (const FresnelKind fresnel : {FresnelKind::exact, FresnelKind::schlick})
      for (const char* isa : {"", "scalar"}) {
        if (*isa && c.degrees != 60) continue;
        CAPTURE(c.index);
        CAPTURE(c.degrees);
        Scene plate = white_room();
        plate.render.fresnel = fresnel;
        plate.render.seed = ++seed;
        add(plate, Box<>{{-5000, -1, -5000}, {5000, 0, 5000}}, glass(c.index));
        const double angle = c.degrees * (pi / 180);
        aim(plate, {5 * std::sin(angle), 5 * std::cos(angle), 0}, {0, 0, 0});
        Scene below = plate;
        plate.background = Hemispheres{{1, 1, 1}, {0, 0, 0}};
        below.background = Hemispheres{{0, 0, 0}, {1, 1, 1}};
        const Estimate reflected = radiance(plate, *isa ? 128 : 1024, isa);
        const double expected = fresnel == FresnelKind::exact ? c.reflected : c.with_schlick;
        scores.add("reflected", reflected, expected, *isa ? 0.02 : 5e-3);
        // Both pictures have the same random numbers, so that each path is either reflected or transmitted.
        CHECK(radiance(below, *isa ? 128 : 1024, isa).mean ==
              doctest::Approx(1 - reflected.mean).epsilon(1e-7).scale(0));
      }
}

TEST_CASE("coloured glass: a ball that absorbs inside") {
  struct Case {
    double index, density, impact, expected;
  };
  constexpr Case cases[] = {
      {1.0, 0.25, 0.0, 0.6065306597126334}, {1.0, 0.25, 0.5, 0.64855225391183},   {1.0, 0.25, 0.9, 0.8041697122607419},
      {1.0, 1.0, 0.0, 0.13533528323661267}, {1.0, 1.0, 0.5, 0.17692120631776423}, {1.0, 1.0, 0.9, 0.41820656716303695},
      {1.5, 0.25, 0.0, 0.6128773633973973}, {1.5, 0.25, 0.5, 0.6301475285864073}, {1.5, 0.25, 0.9, 0.6837537397175935},
      {1.5, 1.0, 0.0, 0.16540385970575194}, {1.5, 1.0, 0.5, 0.18180241600403876}, {1.5, 1.0, 0.9, 0.276315850126701},
      {2.0, 0.25, 0.0, 0.6249757287859272}, {2.0, 0.25, 0.5, 0.6341171134733092}, {2.0, 0.25, 0.9, 0.6670203937532835},
      {2.0, 1.0, 0.0, 0.21967519865402108}, {2.0, 1.0, 0.5, 0.22830372266048232}, {2.0, 1.0, 0.9, 0.299673035724735}};
  ZScores scores;
  std::uint32_t seed = 0;
  constexpr double scales[] = {1, 1e-3, 1e3};
  for (const double scale : tried(scales, 1))
    for (const auto& [index, density, impact, expected] : cases) {
      CAPTURE(scale);
      CAPTURE_BOUND(index);
      CAPTURE_BOUND(impact);
      Scene scene = sphere_seen_at(impact, scale);
      scene.render.seed = ++seed;
      add(scene, sphere({0, 0, 0}, scale), glass(index));
      add_medium(scene, sphere({0, 0, 0}, scale), {density / scale, 0}, 0);
      scores.add("coloured glass", radiance(scene, 1024), expected, 5e-3);
      scene.render.seed = ++seed;
      if (scale == 1 && impact == 0.5) scores.add("scalar", radiance(scene, 128, "scalar"), expected, 0.02);
    }
}

TEST_CASE("hollow glass: by negative radius and by relative index the same picture, bit for bit") {
  Scene bubble = white_room();
  bubble.background = Gradient{};
  bubble.width = 120, bubble.height = 80;
  bubble.camera = {.look_from = {0.5, 0.7, 4}, .look_at = {0, 0, 0}, .vfov = 35};
  add(bubble, sphere({0, -101, 0}, 100), lambertian(0.5));
  add(bubble, sphere({0, 0, 0}, 1), glass(1.5));
  Scene relative = bubble;
  add(bubble, sphere({0, 0, 0}, -0.9), glass(1.5));
  add(relative, sphere({0, 0, 0}, 0.9), glass(1 / 1.5));
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(kernels.isa);
    CHECK(resolve(film_of(bubble, 8, kernels.isa)) == resolve(film_of(relative, 8, kernels.isa)));
  }
}

TEST_CASE("glass of index 1 changes no mean; single samples differ, because its events use up random numbers") {
  Scene scene = white_room();
  scene.background = Gradient{{0.1, 0.2, 0.3}, {1, 0.5, 0.2}};
  add(scene, sphere({0, -101, 0}, 100), lambertian(0.5));
  aim(scene, {0.3, 2, 4}, {0.1, -1, 0});
  const Estimate without = radiance(scene, 4096);
  add(scene, sphere({0, 0, 0}, 1), glass(1));
  const Estimate with = radiance(scene, 4096);
  CHECK(with.error < 1e-3 * with.mean);
  check_agree(with, without);
  Scene sky = white_room();  // nothing but sky: every ray goes straight on, in every bit
  sky.background = Gradient{{0.1, 0.2, 0.3}, {1, 0.5, 0.2}};
  sky.camera = {.look_from = {0, 0.2, 3}, .look_at = {0, 0, 0}};
  const std::vector<float> empty = resolve(film_of(sky, 4));
  add(sky, sphere({0, 0, 0}, 1), glass(1));
  add(sky, Box<>{{-2, -2, -2}, {2, 2, 1.5}}, glass(1), {RotateY{20}});
  CHECK(resolve(film_of(sky, 4)) == empty);
}

}  // namespace tyndall::test::glass_test
