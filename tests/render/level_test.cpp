#include "core/render/level.h"

#include "core/compile/compile.h"
#include "core/render/render.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

using namespace tyndall;

namespace {

RenderScene small_scene() {
  Scene scene = load_scene("cornell-smoke").scene;
  scene.width = 37;
  scene.height = 23;
  return compile(scene);
}

Film film_of(const RenderScene& scene, std::uint32_t first, std::uint32_t spp, Film film = {}) {
  RenderOptions options;
  options.threads = 2;
  options.first_sample = first;
  options.spp = spp;
  return render(scene, options, {}, std::move(film)).film;
}

/// Some pixels of one film, the others of another with more samples: what an interrupted pass leaves.
Film mixed(Film few, const Film& many) {
  for (std::size_t i = 0; i < few.pixels.size(); ++i)
    if (i * i % 7 < 3) few.pixels[i] = many.pixels[i];
  return few;
}

}  // namespace

TEST_CASE("an interrupted film that is continued is, bit for bit, the film of one render") {
  const RenderScene scene = small_scene();
  for (const std::uint32_t first : {0u, 3u}) {
    const Film few = film_of(scene, first, 2), some = film_of(scene, first, 9), many = film_of(scene, first, 12);
    const Film uneven = mixed(few, some);
    REQUIRE(totals(uneven).least_taken == 2);
    REQUIRE(totals(uneven).most_taken == 9);
    CHECK(film_of(scene, first, 12, uneven) == many);
    CHECK(film_of(scene, first, 9, uneven) == some);
    CHECK(film_of(scene, first, 4, uneven) == some);  // no sample is thrown away
  }
}

TEST_CASE("levelling that is given up leaves whole prefixes") {
  const RenderScene scene = small_scene();
  const Film few = film_of(scene, 0, 2), some = film_of(scene, 0, 9);
  Film film = mixed(few, some);
  const Film before = film;
  Crew crew(2);
  UnitCounts counts;
  const SceneViewOf view(scene);
  level(crew, *choose_kernels(""), view.view(), film, true, counts);
  CHECK(film == before);
  CHECK(counts.rays == 0);
  level(crew, *choose_kernels(""), view.view(), film, false, counts);
  CHECK(film == some);
  CHECK(counts.rays > 0);
}
