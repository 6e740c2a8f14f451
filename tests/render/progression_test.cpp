#include "core/render/progression.h"

#include "core/accuracy/estimate.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

/// The passes of a picture: in which order its samples come, when it is finished, and what is reported meanwhile.
namespace tyndall::test::progression_test {

namespace {

RenderScene smoke() { return compile(small_scene("cornell-smoke", 37, 23, 1)); }

Film film_of(const RenderScene& scene, std::uint32_t first, std::uint32_t spp, Film film = {}) {
  return render(scene, {.threads = 2, .first_sample = first, .spp = spp}, {}, std::move(film)).film;
}

/// Some pixels of one film, the others of another with more samples: what an interrupted pass leaves.
Film mixed(Film few, const Film& many) {
  for (std::size_t i = 0; i < few.pixels.size(); ++i)
    if (i * i % 7 < 3) few.pixels[i] = many.pixels[i], few.emission[i] = many.emission[i];
  return few;
}

}  // namespace

TEST_CASE("an interrupted film that is continued is, bit for bit, the film of one render") {
  const RenderScene scene = smoke();
  for (const std::uint32_t first : {0u, 3u}) {
    const Film few = film_of(scene, first, 2), some = film_of(scene, first, 9), many = film_of(scene, first, 12);
    const Film uneven = mixed(few, some);
    REQUIRE(totals(uneven).min_taken == 2);
    REQUIRE(totals(uneven).max_taken == 9);
    CHECK(film_of(scene, first, 12, uneven) == many);
    CHECK(film_of(scene, first, 9, uneven) == some);
    CHECK(film_of(scene, first, 4, uneven) == some);  // no sample is thrown away
  }
}

TEST_CASE("progression: making a film even can be interrupted, leaves whole prefixes and is counted") {
  const Ready ready(smoke());
  const Film few = film_of(ready.scene, 0, 2), some = film_of(ready.scene, 0, 9);
  const Film before = mixed(few, some);
  Progression picture;
  picture.go_on(before, {});
  CHECK(picture.taken() == 2);
  CHECK_FALSE(picture.run_pass(ready.engine, {}, true));
  CHECK(picture.within_pass());
  CHECK(picture.film() == before);
  CHECK(picture.tally().rays == 0);
  CHECK(picture.run_pass(ready.engine, {}, false));
  CHECK_FALSE(picture.within_pass());
  CHECK(picture.film() == some);
  CHECK(picture.taken() == 9);
  CHECK(picture.tally().rays > 0);
}

TEST_CASE("progression: a coarse pass, the rest of the first sample, then growing passes give the blocking film") {
  const Ready ready(smoke());
  const RenderScene& scene = ready.scene;
  Progression picture;
  // The second round replaces what the first has left in the film.
  for (int round = 0; round < 2; ++round) {
    picture.start(scene, {0, 0, scene.width, scene.height}, 0, {.coarse_step = 4});
    CHECK_FALSE(picture.has_picture());
    CHECK(picture.step() == 4);
    std::vector<std::uint32_t> taken;
    while (!picture.reached({.spp = 21})) {
      REQUIRE(picture.run_pass(ready.engine, {.spp = 21}, false));
      CHECK(picture.has_picture());
      taken.push_back(picture.taken());
    }
    CHECK(taken == std::vector<std::uint32_t>{0, 1, 2, 4, 8, 16, 21});
    CHECK(picture.step() == 1);
    CHECK(picture.film() == film_of(scene, 0, 21));
    CHECK(picture.tally().rays == render(scene, {.spp = 21}).rays);  // no path is followed twice
  }
}

TEST_CASE("progression: a coarse pass of a scene that shares is replaced, with all that was counted of it") {
  Scene scene = close_up("cornell-box", 37, 23);
  scene.render.max_depth = 2;
  const Ready ready(compile(scene));
  REQUIRE(ready.view.view().reuses_paths);
  ProgressionOptions options{.coarse_step = 4};
  Progression picture;
  picture.start(ready.scene, {0, 0, 37, 23}, 0, options);
  while (!picture.reached({.spp = 4})) {
    REQUIRE(picture.run_pass(ready.engine, {.spp = 4}, false));
    const PassTally tally = picture.tally();
    CHECK(tally.truncated > tally.samples / 4);
    CHECK(tally.truncated <= tally.samples);
    CHECK(picture.cut_throughput() > 0.01);
    CHECK(picture.cut_throughput() < 1);
  }
  const Film& film = picture.film();
  const FilmTotals sum = totals(film);
  CHECK(film == film_of(ready.scene, 0, 4));
  CHECK(picture.tally().samples == sum.samples);
  CHECK(picture.tally().truncated == sum.truncated);
  CHECK(picture.cut_throughput() == sum.cut_throughput);

  Progression continued;
  continued.go_on(film, options);
  CHECK(continued.tally().truncated == sum.truncated);
  CHECK(continued.cut_throughput() == sum.cut_throughput);
  options.first = {8, 4, 16, 12};  // refined first: its pixels have more samples than the others
  continued.go_on(film, options);
  REQUIRE(continued.run_pass(ready.engine, {.spp = 64}, false));
  CHECK(continued.taken() == 4);
  CHECK(continued.cut_throughput() == doctest::Approx(totals(continued.film()).cut_throughput));
}

TEST_CASE("progression: ends at the first of the limits, but not before a pass") {
  const Ready ready(smoke());
  Progression picture;
  picture.start(ready.scene, {0, 0, 37, 23}, 0, {});
  const Limits no_time{.spp = {}, .seconds = 0}, rough{.spp = {}, .error = 1e6};
  CHECK(picture.reached({.spp = 0}));
  CHECK_FALSE(picture.reached(no_time));
  CHECK_FALSE(picture.reached(rough));
  picture.run_pass(ready.engine, rough, false);
  CHECK(picture.reached(no_time));
  CHECK_FALSE(picture.reached(rough));  // with one sample a pixel the error is not known
  CHECK_FALSE(picture.estimate_is_new());
  picture.run_pass(ready.engine, rough, false);
  CHECK(picture.reached(rough));
  CHECK(picture.estimate_is_new());
  CHECK(picture.error() == estimate_error(ready.scene, ready.kernels, picture.film()).relative_error);
  CHECK_FALSE(picture.reached({}));
}

TEST_CASE("progression: levels that an estimate has asked for are not those of the next scene") {
  const Scene lit = small_scene("stress-light-and-fuzz", 111, 83, 1);
  Scene dim = lit;  // the same pixels decide, at half the level
  for (Material& material : dim.materials)
    if (std::holds_alternative<Light<>>(material.kind)) material.colour = 0.5 * std::get<Vec3d>(material.colour);
  Progression picture;
  for (const Scene& scene : {lit, dim}) {
    const Ready ready(compile(scene));
    picture.start(ready.scene, {0, 0, scene.width, scene.height}, 0, {});
    while (!picture.reached({.spp = 4})) picture.run_pass(ready.engine, {.spp = 4}, false);
    picture.estimate_now(ready.engine, false);
    CHECK(picture.error() == estimate_error(ready.scene, ready.kernels, picture.film()).relative_error);
    CHECK(picture.error() != estimate_error(picture.film()).relative_error);  // some were asked for
  }
}

TEST_CASE("progression: the error is estimated when it is due, not after each pass") {
  const Ready ready(smoke(), 1);
  const auto estimated_at = [&](const EstimateTimes& times) {
    Progression picture;
    picture.start(ready.scene, {0, 0, 37, 23}, 0, {.estimates = times});
    std::vector<std::uint32_t> found;
    while (!picture.reached({.spp = 32})) {
      picture.run_pass(ready.engine, {.spp = 32}, false);
      if (picture.estimate_is_new()) found.push_back(picture.taken());
    }
    return found;
  };
  using Counts = std::vector<std::uint32_t>;
  CHECK(estimated_at({}) == Counts{});
  CHECK(estimated_at({.seconds = 1e6}) == Counts{32});  // only when the wanted number of samples is reached
  CHECK(estimated_at({.seconds = 1e6, .growth = 0, .each_below = 9}) == Counts{2, 4, 8, 32});
  CHECK(estimated_at({.seconds = 0}) == Counts{2, 4, 8, 16, 32});
}

TEST_CASE("pass length: doubles or adds a part, within the time and the most samples") {
  constexpr std::size_t full_hd = 1920 * 1080;
  const PassLength doubling{.growth = 1, .maximum = 64, .seconds = 0.15};
  CHECK(pass_samples(doubling, 0, full_hd, 0) == 1);
  CHECK(pass_samples(doubling, 1, full_hd, 1e12) == 1);
  CHECK(pass_samples(doubling, 2, full_hd, 1e12) == 2);
  CHECK(pass_samples(doubling, 40, full_hd, 1e12) == 40);
  CHECK(pass_samples(doubling, 1000, full_hd, 1e12) == 64);
  CHECK(pass_samples({.growth = 1, .maximum = 64, .seconds = 0.5}, 1000, full_hd, 10.0 * full_hd) == 5);
  CHECK(pass_samples(doubling, 1000, full_hd, 1.0 * full_hd) == 1);
  CHECK(pass_samples(doubling, 1000, full_hd, 0) == 1);  // one, while the speed is not known
  CHECK(pass_samples(doubling, 3, 0, 1e6) == 3);
  const PassLength few{.growth = 1, .maximum = 32, .min_seconds = 0.1};
  CHECK(pass_samples(few, 0, full_hd, 0) == 1);
  CHECK(pass_samples(few, 1, full_hd, 70.0 * full_hd) == 7);
  CHECK(pass_samples(few, 12, full_hd, 70.0 * full_hd) == 12);
  CHECK(pass_samples(few, 1, full_hd, 7e5 * full_hd) == 32);
  const PassLength quarter{.growth = 0.25, .maximum = 32};
  CHECK(pass_samples(quarter, 1, full_hd, 0) == 1);
  CHECK(pass_samples(quarter, 15, full_hd, 0) == 3);
  CHECK(pass_samples(quarter, 1000, full_hd, 0) == 32);
}

}  // namespace tyndall::test::progression_test
