#pragma once
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

/// Scenes of all kinds, and whether threads and tiles change a bit of their pictures.
namespace tyndall::test {

namespace same_picture {

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

}  // namespace same_picture

}  // namespace tyndall::test
