#pragma once
#include "tests/support/merged.h"
#include "tests/support/pictures.h"
#include "tests/support/random_glass.h"

#include <doctest/doctest.h>

#include <random>
#include <string>

/// Whether parts of pictures of random scenes have the bits of the whole: regions, shards and continued films.
namespace tyndall::test {

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

}  // namespace tyndall::test
