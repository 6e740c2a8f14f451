#include "core/scene/load.h"
#include "tests/support/double_kernels.h"
#include "tests/support/prepared.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::double_test {

namespace {

std::vector<float> picture(const Kernels& kernels, const RenderScene& scene) {
  const SceneViewOf view(scene);
  Film film = make_film(scene.width, scene.height, {0, 0, scene.width, scene.height}, 0, scene.film_quantum);
  TileCounts counts;
  kernels.render_tile(view.view(), {film.region, 1, 0, 0, 4}, film.quantum, film.pixels.data(), counts);
  return resolve(film);
}

}  // namespace

TEST_CASE("double: the kernel over double follows the same paths, except where rounding changes a decision") {
  for (const char* name : {"cornell-box", "showroom", "cornell-smoke"}) {
    Scene loaded = load_scene(name).scene;
    loaded.width = loaded.height = 48;
    const RenderScene scene = compile(loaded);
    const std::vector<float> a = picture(scalar_kernels(), scene), b = picture(double_kernels(), scene);
    int different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) different += std::abs(a[i] - b[i]) > 1e-3f * (0.01f + b[i]) ? 1 : 0;
    CAPTURE(name);
    CHECK(different < 0.03 * static_cast<double>(a.size()));
    CHECK(a != b);  // or the kernel would not compute in double
  }
}

}  // namespace tyndall::test::double_test
