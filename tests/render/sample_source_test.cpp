#include "core/render/sample_source.h"
#include "tests/support/watched_renderer.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

/// Pictures whose samples come from a caller's function: they are made like those of scenes.
using namespace tyndall;
using namespace tyndall::test;

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
