#include "core/render/sample_source.h"

#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>
#include <vector>

/// Pictures whose samples come from a caller's function: they are made like those of scenes.
namespace tyndall::test::sample_source_test {

namespace {

constexpr int width = 40, height = 30;

Scene empty_scene(int spp) {
  Scene scene;
  scene.width = width, scene.height = height;
  scene.render.spp = spp;
  return scene;
}

using Sample = std::function<Vec3f(double, double, std::uint64_t)>;

std::uint64_t show(WatchedRenderer& renderer, const Scene& scene, Sample sample) {
  RenderRequest request = renderer.wanted();
  request.scene = std::make_shared<const Scene>(scene);
  request.samples = std::make_shared<const SampleSource>(SampleSource{std::move(sample)});
  renderer.set(&RenderRequest::samples, request.samples);
  return renderer.set(&RenderRequest::scene, request.scene);
}

/// The column and row in red and green, the index of the sample in blue.
Vec3f place_and_index(double x, double y, std::uint64_t index) {
  return {static_cast<float>(std::floor(x)), static_cast<float>(std::floor(y)), static_cast<float>(index)};
}

}  // namespace

TEST_CASE("sample source: each pixel is the mean of its samples, each of which is asked for once") {
  for (const int threads : {1, 3}) {
    std::atomic<int> calls = 0;
    std::atomic<bool> outside = false;
    WatchedRenderer renderer(threads);
    const std::uint64_t edit = show(renderer, empty_scene(9), [&](double x, double y, std::uint64_t index) {
      ++calls;
      if (!(x >= 0 && x < width && y >= 0 && y < height && index < 9)) outside = true;
      return place_and_index(x, y, index);
    });
    const FramePointer last = renderer.wait_finished(edit);
    CHECK(last->spp == 9);
    CHECK(last->rejected == 0);
    int wrong = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float* rgb = &last->rgba[static_cast<std::size_t>(4 * (y * width + x))];
        wrong += rgb[0] != static_cast<float>(x) || rgb[1] != static_cast<float>(y) || rgb[2] != 4;
      }
    CHECK(wrong == 0);
    CHECK_FALSE(outside);
    CHECK(calls == 9 * width * height);
  }
}

TEST_CASE("sample source: points are spread over the pixel, and the halves tell the error") {
  WatchedRenderer renderer;
  const std::uint64_t edit = show(renderer, empty_scene(64), [](double x, double, std::uint64_t) {
    const auto part = static_cast<float>(x - std::floor(x));
    return Vec3f{part, 0.5f, 0.5f};
  });
  const FramePointer last = renderer.wait_finished(edit);
  double mean = 0;
  for (std::size_t i = 0; i < last->rgba.size(); i += 4) mean += static_cast<double>(last->rgba[i]);
  CHECK(mean / (width * height) == doctest::Approx(0.5).epsilon(0.01));
  CHECK(last->relative_error > 1e-4);
  CHECK(last->relative_error < 0.02);
}

TEST_CASE("sample source: values that are not finite are left out and counted") {
  WatchedRenderer renderer;
  const std::uint64_t edit = show(renderer, empty_scene(4), [](double x, double, std::uint64_t index) {
    return Vec3f{x < 1 && index == 2 ? std::nanf("") : 1.0f, 1, 1};
  });
  const FramePointer last = renderer.wait_finished(edit);
  CHECK(last->rejected == height);
  CHECK(last->rgba[0] == 1);
}

TEST_CASE("sample source: a restart asks again; without the source the scene itself is rendered") {
  std::atomic<int> value = 1;
  WatchedRenderer renderer;
  const std::uint64_t edit = show(renderer, empty_scene(1), [&](double, double, std::uint64_t) {
    const auto grey = static_cast<float>(value.load());
    return Vec3f{grey, grey, grey};
  });
  CHECK(renderer.wait_finished(edit)->rgba[0] == 1);
  value = 2;
  CHECK(renderer.restart() == edit);
  renderer.wait_for([](const Frame& frame) { return frame.finished && frame.rgba.back() == 1 && frame.rgba[0] == 2; });
  const Scene scene = small_scene("cornell-box", width, height, 4);
  renderer.set(&RenderRequest::samples, nullptr);
  const FramePointer last = renderer.wait_finished(renderer.submit(scene));
  CHECK(rgb_of(*last) == reference_picture(scene));
}

TEST_CASE("sample source: a slow one shows ever finer pictures, and each of its samples once") {
  std::atomic<int> calls = 0;
  WatchedRenderer renderer(2);
  const std::uint64_t edit = show(renderer, empty_scene(2), [&](double x, double y, std::uint64_t index) {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return place_and_index(x, y, index);
  });
  const FramePointer last = renderer.wait_finished(edit);
  CHECK(calls == 2 * width * height);
  std::set<int> steps;
  int before = 1000;
  for (const FramePointer& frame : renderer.frames()) {
    CHECK(frame->step <= before);
    before = frame->step;
    if (frame->spp == 0) steps.insert(frame->step);
  }
  CHECK(steps.contains(64));
  CHECK(steps.contains(8));
  CHECK(last->rgba[4 * (width + 1)] == 1);
  CHECK(last->rgba[4 * (width + 1) + 2] == 0.5f);
}

TEST_CASE("sample source: shows what a long pass has so far, and gives it as a film") {
  Scene scene = empty_scene(2);
  scene.width = scene.height = 12;
  WatchedRenderer renderer(1);
  const std::uint64_t edit = show(renderer, scene, [&](double, double, std::uint64_t index) {
    std::this_thread::sleep_for(std::chrono::milliseconds(index > 0 ? 12 : 3));  // the second pass takes 1.7 seconds
    return Vec3f{static_cast<float>(index), 0, 0};
  });
  const auto has_some = [&](const Frame& frame) { return frame.spp == 1 && frame.rgba[0] == 0.5f; };
  const FramePointer within = renderer.wait_for(has_some);
  CHECK(within->rgba[within->rgba.size() - 4] == 0);
  CHECK(totals(renderer->film()).samples > 144);
  CHECK(totals(renderer->film()).samples < 288);
  CHECK(renderer.wait_finished(edit)->spp == 2);
}

TEST_CASE("sample source: shows the first samples of pixels as they come") {
  Scene scene = empty_scene(1);
  scene.width = scene.height = 16;
  WatchedRenderer renderer(1);
  std::atomic<int> calls = 0;
  const std::uint64_t edit = show(renderer, scene, [&](double x, double, std::uint64_t) {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the last three quarters take a second
    return Vec3f{std::floor(x) == 1 ? 2.0f : 1.0f, 0, 0};
  });
  const auto fills = [&](const Frame& frame) {
    return frame.spp == 0 && frame.grid.columns == 16 && frame.rgba.size() == 4 * 256;
  };
  const FramePointer within = renderer.wait_for(fills);
  CHECK(within->rgba[0] == 1);
  CHECK(within->rgba[4] == 2);                         // has its own sample
  CHECK(within->rgba[within->rgba.size() - 60] == 1);  // shows its neighbour's
  CHECK(renderer.wait_finished(edit)->rgba[within->rgba.size() - 60] == 2);
  CHECK(calls == 256);
}

TEST_CASE("sample source: one that becomes slow comes to its end, though no tile job does within the pauses") {
  Scene scene = empty_scene(2);
  scene.width = scene.height = 12;
  WatchedRenderer renderer(1);
  const std::uint64_t edit = show(renderer, scene, [&](double, double, std::uint64_t index) {
    if (index > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));  // one tile job of 0.7 seconds
    return Vec3f{1, 1, 1};
  });
  CHECK(renderer.wait_finished(edit)->spp == 2);
}

TEST_CASE("sample source: is left after the present sample, and unfinished tiles are not added") {
  std::atomic<int> calls = 0;
  int before = 0;
  {
    WatchedRenderer renderer(1);
    show(renderer, empty_scene(1), [&](double, double, std::uint64_t) {
      ++calls;
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      return Vec3f{};
    });
    while (calls < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    before = calls;
  }
  CHECK(calls <= before + 2);

  const std::atomic<bool> yes = true, no = false;
  const std::shared_ptr<const PreparedScene> scene = prepare(empty_scene(1));
  std::vector<FilmPixel> pixels(64);
  const SampleSource grey{[](double, double, std::uint64_t) { return Vec3f{1, 1, 1}; }};
  const TileJob job{.tile = {0, 0, 8, 8}, .first = 0, .last = 1};
  CHECK_FALSE(sample_tile(grey, scene->view(), job, 1, pixels.data(), &yes));
  CHECK(pixels[0].taken == 0);
  CHECK(sample_tile(grey, scene->view(), job, 1, pixels.data(), &no));
  CHECK(pixels[63].taken == 1);
}

TEST_CASE("sample source: all points of a tile job are announced before they are sampled, in their order") {
  const std::shared_ptr<const PreparedScene> scene = prepare(empty_scene(1));
  std::vector<FilmPixel> pixels(64);
  std::vector<Pair<double>> told;
  std::size_t next = 0;
  const auto sample = [&](double x, double y, std::uint64_t) {
    REQUIRE(next < told.size());
    CHECK(told[next].x == x);
    CHECK(told[next++].y == y);
    return Vec3f{};
  };
  const SampleSource source{sample, [&](const std::vector<Pair<double>>& points) { told = points; }};
  const TileJob job{.tile = {0, 0, 8, 8}, .step = 2, .first = 1, .last = 4};
  CHECK(sample_tile(source, scene->view(), job, 1, pixels.data(), nullptr));
  CHECK(told.size() == 48);
  CHECK(next == 48);
}

TEST_CASE("sample source: bright and dark samples are kept, in a blocking render as well") {
  const Scene scene = empty_scene(16);
  RenderOptions options{.spp = 16};
  options.samples = std::make_shared<const SampleSource>(SampleSource{[](double x, double, std::uint64_t) {
    return x < 1 ? Vec3f{1e10f, 1, 1e-9f} : Vec3f{-1, 0.1f, 0.25f};
  }});
  for (const int threads : {1, 3}) {
    options.threads = threads;
    const RenderResult result = render(*prepare(scene), options);
    CHECK(totals(result.film).rejected == 0);
    const std::vector<float> rgb = resolve(result.film);
    CHECK(rgb[0] == 1e10f);
    CHECK(rgb[2] == doctest::Approx(1e-9).epsilon(1e-4));
    CHECK(rgb[3] == -1);
    CHECK(rgb[4] == 0.1f);
  }
}

TEST_CASE("sample source: tiles and first steps follow the speed") {
  CHECK(source_paths_per_tile(0, 1) == 16);
  CHECK(source_paths_per_tile(1e9, 1) == 2048);
  CHECK(source_paths_per_tile(1e5, 1) == doctest::Approx(200));
  CHECK(source_paths_per_tile(1e5, 2) == doctest::Approx(100));
  CHECK(source_paths_per_tile(1, 1) == 1);
  CHECK(source_coarse_step(1 << 20, 0, 0.1) == 64);
  CHECK(source_coarse_step(1 << 20, 1e9, 0.1) == 1);
  CHECK(source_coarse_step(1 << 20, 1 << 20, 0.25) == 2);
  CHECK(is_slow_source(1 << 20, 1 << 20));
  CHECK_FALSE(is_slow_source(1 << 20, 1 << 22));
}

}  // namespace tyndall::test::sample_source_test
