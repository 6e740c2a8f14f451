#include "core/render/clean_film.h"

#include "core/accuracy/error.h"
#include "core/render/views.h"
#include "tests/support/hard_for_filters.h"
#include "tests/support/thorough.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::clean_film_test {

namespace {

RenderResult rendered(const Scene& scene, std::uint32_t spp, bool clean = false, int threads = 2) {
  return render(compile(scene), {.threads = threads, .spp = spp, .clean = clean});
}

Vec3f emission(const Film& film, int x, int y) {
  return half_emission(film, film.index(x, y), 0) + half_emission(film, film.index(x, y), 1);
}

}  // namespace

TEST_CASE("emission: is all that is seen of a light, also in a mirror, and nothing of what it shines on") {
  Scene scene = small_scene("cornell-box", 96, 96, 8);
  const Film box = rendered(scene, 8).film;
  CHECK(emission(box, 48, 14).x > 20);  // the light, in both halves
  CHECK(half_emission(box, box.index(48, 14), 0) == half_mean(box, box.at(48, 14), 0));
  CHECK(emission(box, 48, 90) == Vec3f{});
  CHECK(mean(box, box.at(48, 90)).x > 0);
  double shining = 0;
  for (std::size_t i = 0; i < box.emission.size(); ++i) shining += half_emission(box, i, 1).x > 0 ? 1 : 0;
  CHECK(shining < 150);
  for (Material& material : scene.materials)
    if (std::holds_alternative<Lambertian<>>(material.kind)) material.kind = Metal<>{0};
  const Film mirrors = rendered(scene, 8).film;
  for (std::size_t i = 0; i < mirrors.emission.size(); ++i)
    for (int half = 0; half < 2; ++half)
      REQUIRE(std::abs(half_emission(mirrors, i, half).y - half_mean(mirrors, mirrors.pixels[i], half).y) < 1e-5f);
}

TEST_CASE("emission: costs no memory where there is no light") {
  CHECK(rendered(small_scene("metal-spheres", 16, 9, 2), 2).film.emission.empty());
}

TEST_CASE("clean view: nearer to the truth than the picture, with an error that it knows, and the film is the same") {
  constexpr const char* names[] = {"cornell-smoke", "showroom", "cornell-box", "metal-spheres"};
  for (const char* name : tried(names, 2)) {
    CAPTURE(name);
    const Scene scene = small_scene(name, 96, 96, 8);
    const RenderResult raw = rendered(scene, 8), result = rendered(scene, 8, true);
    CHECK(result.film == raw.film);
    REQUIRE(result.clean);
    Scene other = scene;
    other.render.seed = 99;
    const std::vector<float> truth = resolve(rendered(other, 512).film);
    const double before = relative_mse(resolve(raw.film), truth), after = relative_mse(result.clean->rgb, truth);
    CHECK(after < 0.5 * before);
    CHECK(result.clean->relative_error > 0.5 * std::sqrt(after));
    CHECK(result.clean->relative_error < 2 * std::sqrt(after));
  }
}

TEST_CASE("clean view: lights smaller than a pixel do not make it worse than raw, whatever samples meet them") {
  for (const auto& [name, scene] : scenes_hard_for_filters()) {
    if (name != "lamps of one pixel") continue;
    Scene other = scene;
    other.render.seed = 99;
    const std::vector<float> truth = resolve(rendered(other, 512).film);
    for (const std::uint32_t seed : {0u, 1u, 2u, 3u})
      for (const std::uint32_t spp : {2u, 8u, 32u}) {
        CAPTURE(seed);
        CAPTURE(spp);
        other.render.seed = seed;
        const RenderResult result = rendered(other, spp, true);
        CHECK(relative_mse(result.clean->rgb, truth) < 1.03 * relative_mse(resolve(result.film), truth));
      }
  }
}

TEST_CASE("clean view: of regions, and the same for any number of threads and after an interruption") {
  const Scene scene = small_scene("cornell-box", 40, 30, 4);
  const RenderScene compiled = compile(scene);
  const RenderResult one = rendered(scene, 4, true, 1), two = rendered(scene, 4, true, 3);
  CHECK(one.clean->rgb == two.clean->rgb);
  RenderOptions options{.region = Region{7, 3, 8, 20}, .spp = 4, .clean = true};
  CHECK(render(compiled, options).clean->rgb.size() == 3 * 17);
  options.region.reset();
  options.spp = 2;
  RenderResult half = render(compiled, options);
  options.spp = 4;
  CHECK(render(compiled, options, {}, std::move(half.film)).clean->rgb == one.clean->rgb);
}

TEST_CASE("clean view: its error ends a render that asks for that, and one sample a pixel has none") {
  Scene scene = small_scene("cornell-box", 48, 48, 1);
  scene.render.spp.reset();
  const RenderResult result = render(compile(scene), {.target_error = 0.12, .clean = true});
  REQUIRE(result.clean);
  CHECK(result.clean->relative_error <= 0.12);
  CHECK(result.seconds_clean > 0);
  CHECK_FALSE(rendered(scene, 1, true).clean);
}

TEST_CASE("coarse clean view: what the picture shows, with fewer pixels, for any number of threads, and in no film") {
  for (const char* name : {"cornell-box", "metal-spheres"}) {
    CAPTURE(name);
    constexpr int step = 3;
    const Scene scene = small_scene(name, 119, 80, 256);
    std::vector<CleanPicture> made;
    for (const int threads : {1, 3}) {
      const Ready ready(compile(scene), threads);
      FilmCleaner cleaner(ready.kernels);
      CHECK_FALSE(cleaner.run_coarse(step, ready.engine, ready.scene.film_quantum, true, made.emplace_back()));
      REQUIRE(cleaner.run_coarse(step, ready.engine, ready.scene.film_quantum, false, made.back()));
    }
    REQUIRE(made[0].width == 40);
    REQUIRE(made[0].height == 27);
    CHECK(made[0].rgb == made[1].rgb);
    const Film whole = rendered(scene, 256).film;
    // Against the mean over the pixels around every third one, moved by so many pixels each way.
    const auto off_by = [&](int direction) {
      std::vector<float> truth;
      for (int i = 0; i < 40 * 27; ++i) {
        Vec3f sum{};
        for (int part = 0; part < step * step; ++part) {
          const int x = std::clamp(step * (i % 40) + part % step - 1 + direction, 0, 118);
          const int y = std::clamp(step * (i / 40) + part / step - 1 + direction, 0, 79);
          sum = sum + 1.0f / (step * step) * mean(whole, whole.at(x, y));
        }
        truth.insert(truth.end(), {sum.x, sum.y, sum.z});
      }
      return relative_mse(made[0].rgb, truth);
    };
    CHECK(off_by(0) < 0.04);
    CHECK(off_by(0) < off_by(-1));
    CHECK(off_by(0) < off_by(1));
  }
}

TEST_CASE("coarse clean view: the first one after an edit where a whole one takes long, until that is there") {
  WatchedRenderer renderer;
  renderer.set(&RenderRequest::clean, true);
  const Scene scene = small_scene("cornell-box", 1000, 1000, 2);
  const FramePointer whole = renderer.wait_finished(renderer.submit(scene));
  REQUIRE(whole->clean);
  CHECK(whole->clean->spp == 2);
  CHECK(whole->clean->grid.columns == 1000);
  FramePointer coarse;
  for (const FramePointer& frame : renderer.frames())
    if (!coarse && frame->clean) coarse = frame;
  REQUIRE(coarse);
  CHECK(coarse->clean->spp == 0);
  CHECK(coarse->spp <= 1);
  CHECK(std::isinf(coarse->clean->relative_error));
  const PictureGrid grid = coarse->clean->grid;
  CHECK(grid.spacing >= 2);
  CHECK(grid.columns == (999 + static_cast<int>(grid.spacing)) / static_cast<int>(grid.spacing));
  CHECK(coarse->clean->rgba.size() == 4 * static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
}

TEST_CASE("frames: their memory is used again, but not that of a film of another size") {
  FrameMemory memory;
  memory.take(100)->rgba.resize(400);
  CHECK(memory.take(100)->rgba.capacity() == 400);
  CHECK(memory.take(25)->rgba.capacity() == 0);
}

TEST_CASE("clean view: comes with frames when it is wanted, of the newest scene, and goes with the wish") {
  WatchedRenderer renderer;
  Scene scene = small_scene("cornell-box", 64, 64, 8);
  CHECK_FALSE(renderer.wait_finished(renderer.submit(scene))->clean);
  renderer.set(&RenderRequest::clean, true);
  const FramePointer clean = renderer.wait_for([](const Frame& f) { return f.clean && f.finished; });
  CHECK(clean->clean->spp == 8);
  CHECK(clean->clean->rgba.size() == clean->rgba.size());
  CHECK(clean->clean->relative_error < clean->relative_error);
  const RenderResult blocking = rendered(scene, 8, true);
  CHECK(clean->clean->rgba[4 * 1000] == blocking.clean->rgb[3 * 1000]);
  CHECK(clean->clean->relative_error == blocking.clean->relative_error);

  scene.camera.vfov = 30;
  const std::size_t before = renderer.frames().size();
  const FramePointer next = renderer.wait_finished(renderer.submit(scene), before);
  REQUIRE(next->clean);
  CHECK(next->clean->spp == 8);
  for (const FramePointer& frame : renderer.frames())
    if (frame->edit == next->edit && frame->clean) CHECK(frame->clean->rgba != clean->clean->rgba);
  renderer.set(&RenderRequest::clean, false);
  renderer.catch_up();
  CHECK_FALSE(renderer->latest()->clean);
  CHECK(renderer->latest()->spp == 8);
}

}  // namespace tyndall::test::clean_film_test
