#pragma once
#include "tests/support/pictures.h"
#include "tests/support/random_glass.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Scenes of all kinds, whether threads and tiles change a bit of their pictures, and whether parts of pictures of
/// random scenes have the bits of the whole: regions, shards and continued films.
namespace tyndall::test::same_picture {

inline constexpr int width = 61, height = 43;  // neither is a multiple of a tile's edge

inline const std::vector<RenderScene>& scenes() {
  static const std::vector<RenderScene> all = [] {
    std::vector<RenderScene> list;
    for (const char* name : {"showroom", "cornell-smoke", "bouncing-spheres", "next-week", "stress-caustic-glass",
                             "stress-caustic-shell", "stress-mirror-wall", "stress-pane", "stress-two-balls"})
      list.push_back(compile(small_scene(name, width, height, 1)));
    for (const char* name : {"cornell-box", "cornell-smoke"}) list.push_back(compile(close_up(name, width, height)));
    list.push_back(compile(caustic_close_up(width, height)));
    const auto reuses_paths = [](const RenderScene& scene) { return SceneViewOf(scene).view().reuses_paths; };
    CHECK(std::count_if(list.begin(), list.end(), reuses_paths) == 4);
    return list;
  }();
  return all;
}

inline RenderOptions options_of(const Kernels& kernels, std::uint32_t spp) {
  return {.threads = 2, .isa = kernels.isa, .spp = spp};
}

/// Renders the scene on one thread, then with each of these numbers of threads and edges of tiles.
inline void check_threads_and_tiles(const std::vector<std::pair<int, int>>& threads_and_tiles) {
  for (const Kernels& kernels : available_kernels())
    for (const RenderScene& scene : scenes()) {
      CAPTURE(kernels.isa);
      RenderOptions options = options_of(kernels, 5);
      options.threads = 1;
      const Film reference = render(scene, options).film;
      CHECK(totals(reference).rejected == 0);
      for (const auto& [threads, tile] : threads_and_tiles) {
        options.threads = threads;
        options.tile = tile;
        const Film film = render(scene, options).film;
        REQUIRE(film == reference);
        REQUIRE(hash_of(film) == hash_of(reference));
      }
    }
}

struct CutPictures {
  int pairs = 0;      ///< how many parts were compared with the whole
  int differ = 0;     ///< of these, how many have other bits
  int chained = 0;    ///< scenes that have specular light paths to solve for
  unsigned last = 0;  ///< seed of the last scene that differs
};

/// Compares whole pictures of the scene of this seed with two regions, with two shards, and with a film that was gone
/// on with, by the given kernels.
inline void compare_cuts(unsigned seed, const Kernels& kernels, CutPictures& found) {
  std::mt19937 engine(seed);
  Scene source = RandomGlass(seed).scene(24, 20);
  if (engine() % 2) source.render.sampler = SamplerKind::random;
  const RenderScene scene = compile(source);
  found.chained += !scene.specular.sphere.empty() ? 1 : 0;
  RenderOptions options{.threads = 1, .isa = kernels.isa, .spp = 8};
  const Film whole = render(scene, options).film;
  const auto count = [&](bool same) {
    ++found.pairs;
    if (!same) ++found.differ, found.last = seed;
  };
  for (int round = 0; round < 2; ++round) {
    const auto below = [&](int end) { return static_cast<int>(engine() % static_cast<unsigned>(end)); };
    const int x = below(23), y = below(19);
    options.region = Region{x, y, x + 1 + below(24 - x), y + 1 + below(20 - y)};
    const Film part = render(scene, options).film;
    bool same = true;
    for (int row = options.region->y0; row < options.region->y1; ++row)
      for (int column = options.region->x0; column < options.region->x1; ++column)
        same = same && part.at(column, row) == whole.at(column, row);
    count(same);
  }
  options.region.reset();
  options.spp = 3;
  const Film first = render(scene, options).film;
  options.spp = 5, options.first_sample = 3;
  count(merged({{"first", first}, {"second", render(scene, options).film}}) == whole);
  options.spp = 8, options.first_sample = 0;
  count(render(scene, options, {}, first).film == whole);
}

/// Checks that the parts of `count` scenes, from seed `first` on, have the bits of the whole, with every instruction
/// set.
inline void check_cuts(unsigned first, int count) {
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(std::string(kernels.isa));
    CutPictures found;
    for (int i = 0; i < count; ++i) compare_cuts(first + static_cast<unsigned>(i), kernels, found);
    CAPTURE(found.last);
    CHECK(found.pairs == 4 * count);
    CHECK(found.differ == 0);
    CHECK(found.chained >= 3 * count / 4);
  }
}

}  // namespace tyndall::test::same_picture
