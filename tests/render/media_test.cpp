#include "tests/support/capture.h"
#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Media against closed forms and radiative transfer solved apart from this program.
namespace tyndall::test::media_test {

namespace {

/// The sphere fills a disc that touches the picture's edges, seen from so far that its rays are parallel.
Scene sphere_in_square() {
  Scene scene = white_room();
  scene.camera = {.look_from = {0, 0, 1000}, .look_at = {0, 0, 0}, .vfov = 2 * std::atan(1.0 / 1000) * (180 / pi)};
  return scene;
}

/// Mean over the disc, computed from the mean over the square around it; outside of the disc every pixel is 1.
Estimate over_disc(Estimate square) { return {1 - (1 - square.mean) * 4 / pi, square.error * 4 / pi}; }

/// Mean radiance over the picture from `runs` seeds: pixels differ, so they are no batches of one another.
Estimate picture_mean(Scene scene, int spp, int runs = 16) {
  std::vector<double> means;
  scene.render.seed *= static_cast<std::uint32_t>(runs);
  for (int run = 0; run < runs; ++run, ++scene.render.seed) {
    means.push_back(radiance(scene, spp).mean);
  }
  return estimate(means);
}

}  // namespace

TEST_CASE("beer-lambert: balls, at any scale") {
  struct Case {
    double density, impact, expected;
  };
  constexpr Case cases[] = {{0.01, 0, 0.9801986733067554},  {0.01, 0.6, 0.9841273200552851},
                            {0.1, 0, 0.8187307530779818},   {0.1, 0.6, 0.8521438489662112},
                            {1, 0, 0.13533528323661267},    {1, 0.6, 0.20189651799465538},
                            {5, 0, 4.5399929762484854e-05}, {5, 0.6, 0.0003354626279025118},
                            {20, 0, 4.248354255291589e-18}, {20, 0.6, 1.2664165549094176e-14}};
  ZScores scores;
  std::uint32_t seed = 0;
  for (const double scale : {1.0, 1e-6, 1e-4, 1e4, 1e6})
    for (const auto& [density, impact, expected] : cases)
      for (const char* isa : {"", "scalar"}) {
        if (*isa && (scale != 1 || impact != 0)) continue;
        CAPTURE(scale);
        CAPTURE_BOUND(density);
        Scene scene = sphere_seen_at(impact, scale);
        scene.render.seed = ++seed;
        add_medium(scene, sphere({0, 0, 0}, scale), {density / scale, 0}, 0);
        const Estimate measured = radiance(scene, *isa ? 64 : 512, isa);
        if (expected < 1e-10)
          CHECK(measured.mean == 0);
        else
          scores.add("transmittance", measured, expected, density < 5 ? 0.02 : 1.0);
      }
}

TEST_CASE("beer-lambert: a turned box along its short side; boundaries of groups; many small media in a row") {
  ZScores scores;
  std::uint32_t seed = 0;
  constexpr double expected[][2] = {
      {0.01, 0.9900498337491681}, {0.1, 0.9048374180359595}, {1, 0.3678794411714424}, {5, 0.006737946999085467}};
  for (const auto& [density, fraction] : expected)
    for (const double degrees : {0.0, 30.0, -117.0}) {
      Scene scene = white_room();
      scene.render.seed = ++seed;
      const Transform transform{RotateY{degrees}, Translate{{3, 1, -2}}};
      add_medium(scene, Box<>{{-0.5, -1, -1.5}, {0.5, 1, 1.5}}, {density, 0}, 0);
      scene.objects = {{"", Group{scene.objects}, transform}};
      const double a = degrees * (pi / 180);
      const Vec3d across{std::cos(a), 0, -std::sin(a)}, middle{3, 1.3, -2};
      aim(scene, middle + 4.0 * across, middle);
      scores.add("box", radiance(scene, 512), fraction, density < 5 ? 0.02 : 0.1);
    }
  Scene row = white_room();
  for (int i = 0; i < 10; ++i) add_medium(row, sphere({0, 0, 3.0 * i}, 1), {0.05, 0}, 0);
  aim(row, {0, 0, 50}, {0, 0, 0});
  scores.add("row", radiance(row, 512), std::exp(-1.0), 0.02);
}

TEST_CASE("beer-lambert: the mean over a ball's disc") {
  ZScores scores;
  constexpr double expected[][2] = {{0.01, 0.986766135547823},
                                    {0.1, 0.876154815321095},
                                    {1, 0.296997075145081},
                                    {5, 0.019990012015452256},
                                    {20, 0.0012499999999999998}};
  for (const auto& [density, fraction] : expected) {
    Scene scene = sphere_in_square();
    scene.render.seed = static_cast<std::uint32_t>(100 * density);
    add_medium(scene, sphere({0, 0, 0}, 1), {density, 0}, 0);
    scores.add("disc", over_disc(picture_mean(scene, 64)), fraction, density < 5 ? 0.01 : 1.0);
  }
}

TEST_CASE("fog ball: isotropic scattering in a white furnace") {
  struct Case {
    double radius, albedo, seen[3], absorbed;
  };
  constexpr double impacts[3] = {0, 0.6, 0.9};
  constexpr Case cases[] = {
      {0.5, 0.5, {0.6201847419693329, 0.6759187411554928, 0.799286856932106}, 0.27582931403648636},
      {0.5, 0.9, {0.9097097294523031, 0.9244464656928336, 0.954686006209053}, 0.06398110803349547},
      {0.5, 0.99, {0.9905753300338525, 0.9921513766211973, 0.9953291803865293}, 0.006638756252926929},
      {1.0, 0.5, {0.41049922560061036, 0.4735724771039833, 0.6388878485444975}, 0.4577428910118131},
      {1.0, 0.9, {0.835122130498284, 0.8580551818624801, 0.9085316716684134}, 0.12199384397279535},
      {1.0, 0.99, {0.9819170136511471, 0.984586560773442, 0.9902293903960028}, 0.013209967699616517},
      {2.0, 0.5, {0.23322543796962175, 0.2787034108762863, 0.4299334951894027}, 0.651076176966845},
      {2.0, 0.9, {0.7204873914343932, 0.7518521509111393, 0.82412940889434}, 0.21838268298282498},
      {2.0, 0.99, {0.9657221653572187, 0.9701602370643834, 0.9795591025276964}, 0.02608053420012232},
      {5.0, 0.5, {0.14510092143342027, 0.1662974983716092, 0.23589684480921994}, 0.7948050194477838},
      {5.0, 0.9, {0.5493858082480717, 0.5872608524697512, 0.672756767504141}, 0.3765154152299811},
      {5.0, 0.99, {0.9221812346823275, 0.9313974368033824, 0.9494306683383718}, 0.061463289552649944}};
  ZScores scores;
  std::uint32_t seed = 0;
  for (const Case& c : cases) {
    CAPTURE(c.radius);
    CAPTURE(c.albedo);
    for (std::size_t k = 0; k < 3; ++k) {
      Scene scene = sphere_seen_at(impacts[k], 1);
      scene.render.seed = ++seed;
      add_medium(scene, sphere({0, 0, 0}, 1), {c.radius, 0}, c.albedo);
      scores.add("radiance", radiance(scene, 256), c.seen[k], 4e-3);
      if (k == 1 && c.radius == 2.0) scores.add("scalar", radiance(scene, 32, "scalar"), c.seen[k], 0.01);
    }
    Scene whole = sphere_in_square();
    whole.render.seed = ++seed;
    add_medium(whole, sphere({0, 0, 0}, 1), {c.radius, 0}, c.albedo);
    const Estimate kept = over_disc(picture_mean(whole, 32));
    scores.add("absorbed", {1 - kept.mean, kept.error}, c.absorbed, 0.02);
  }
}

TEST_CASE("fog: the camera inside sees light decay to the boundary") {
  ZScores scores;
  std::uint32_t seed = 0;
  for (const double scale : {1.0, 1e-6, 1e-4, 1e4, 1e6})
    for (const double depth : {0.1, 1.0, 3.0}) {
      Scene scene = white_room();
      scene.render.seed = ++seed;
      add_medium(scene, sphere({0, 0, 0}, scale), {depth / scale, 0}, 0);
      aim(scene, {0, 0, 0}, {1, 2, 3});
      scores.add("from the middle", radiance(scene, 256), std::exp(-depth), 0.02);
      Scene box = white_room();
      box.render.seed = ++seed;
      add_medium(box, Box<>{{-scale, -scale, -scale}, {scale, scale, scale}}, {depth / scale, 0}, 0);
      aim(box, {0, 0, 0.5 * scale}, {0, 0, 0});
      scores.add("in a box", radiance(box, 256), std::exp(-1.5 * depth), 0.02);
    }
}

TEST_CASE("fog: a dense layer seen from afar reflects as from close by") {
  ZScores scores;
  for (const double distance : {3.0, 300.0}) {
    Scene scene = white_room();
    scene.render.seed = static_cast<std::uint32_t>(distance);
    scene.background = Hemispheres{{1, 1, 1}, {0, 0, 0}};
    add_medium(scene, Box<>{{-40, -1, -40}, {40, 0, 40}}, {1e5, 0}, 0.5);
    aim(scene, {0.3, distance, 0}, {0.3, 0, 0});
    scores.add("dense", radiance(scene, 256), 0.1152259, 4e-3);
  }
}

TEST_CASE("fog: overlapping media add up, in density and in colour") {
  ZScores scores;
  Scene absorbing = white_room();
  add_medium(absorbing, sphere({0, 0, 0}, 1), {0.7, 0}, 0);
  add_medium(absorbing, Box<>{{-0.5, -1, -2}, {0.5, 1, 0.25}}, {0.4, 0}, 0);
  aim(absorbing, {0, 0, 5}, {0, 0, 0});
  scores.add("absorption", radiance(absorbing, 512), std::exp(-0.7 * 2 - 0.4 * 2.25));
  // Two equal spheres, one black, one white, are one sphere of twice the density and albedo 1/2.
  Scene mixed = sphere_seen_at(0, 1);
  mixed.render.seed = 5;
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 1);
  add_medium(mixed, sphere({0, 0, 0}, 1), {0.5, 0}, 0);
  scores.add("equal balls", radiance(mixed, 512), 0.41049922560061036, 5e-3);
  // A sphere that is half one, half another medium of the same kind.
  Scene split = sphere_seen_at(0.6, 1);
  split.render.seed = 6;
  add_medium(split, sphere({0, 0, 0}, 1), {1.5, 0}, 0.9);
  add_medium(split, sphere({0, 0, 0}, 1), {0.5, 0}, 0.9);
  scores.add("layers", radiance(split, 512), 0.7518521509111393, 5e-3);
}

TEST_CASE("fog: without density it is not there") {
  Scene scene = white_room();
  scene.background = Gradient{};
  scene.camera = {.look_from = {0, 0.5, 3}, .look_at = {0, 0, 0}};
  add(scene, sphere({0, 0, 0}, 1), lambertian(0.5));
  const std::vector<float> clear = resolve(film_of(scene, 4));
  for (const double density : {0.0, 1e-38, 1e-30}) {
    Scene fog = scene;
    add_medium(fog, sphere({0, 0, 0}, 2), {density, 0}, 0.5);
    CHECK(resolve(film_of(fog, 4)) == clear);
  }
}

}  // namespace tyndall::test::media_test
