#include "app/files/open_scene.h"

#include "core/base/error.h"

#include <doctest/doctest.h>

namespace tyndall::test::open_scene_test {

TEST_CASE("options change the scene after overrides, and it is checked again") {
  SceneRequest request;
  request.what = "cornell-box";
  request.overrides = {{"/image/width", "100"}, {"/image/height", "90"}, {"/render/max_depth", "9"}};
  request.size = Size{64, 48};
  set(request.render, &RenderSettings::seed, 7);
  set(request.render, &RenderSettings::fresnel, FresnelKind::schlick);
  set(request.render, &RenderSettings::integrator, Integrator::nee);
  set(request.render, &RenderSettings::sampler, SamplerKind::random);
  set(request.display, &Display::exposure, 2);
  set(request.display, &Display::tone_map, ToneMap::aces);
  const Scene scene = open_scene(request).scene;
  CHECK(scene.width == 64);
  CHECK(scene.height == 48);
  CHECK(scene.render.max_depth == 9);
  CHECK(scene.render.seed == 7);
  CHECK(scene.display.exposure == 2);
  CHECK(scene.display.tone_map == ToneMap::aces);
  CHECK(scene.render.fresnel == FresnelKind::schlick);
  CHECK(scene.render.integrator == Integrator::nee);
  CHECK(scene.render.sampler == SamplerKind::random);
  request.size = Size{100000, 10};
  CHECK_THROWS_AS(open_scene(request), SceneError);
}

TEST_CASE("a program is compiled only where that is allowed") {
  SceneRequest request;
  request.what = "nowhere/main.cc";
  CHECK_THROWS_WITH(
      open_scene(request),
      "nowhere/main.cc: found a program, expected a scene file or an image; a program is compiled and run "
      "only where it is named on the command line");
  request.program.allowed = true;
  CHECK_THROWS_WITH(open_scene(request), "nowhere/main.cc: found no such file, expected a C++ source file");
}

}  // namespace tyndall::test::open_scene_test
