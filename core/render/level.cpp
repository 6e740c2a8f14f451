#include "core/render/level.h"

#include <algorithm>
#include <array>

namespace tyndall {
namespace {

constexpr int most_run = 64;  // pixels of a unit

/// Neighbours in a row that lack the same samples.
struct Run {
  int x0 = 0, x1 = 0, y = 0;
  std::uint32_t taken = 0;
};

/// The run that begins at x.
Run run_at(const Film& film, int x, int y) {
  Run run{x, x, y, film.at(x, y).taken};
  const int end = std::min(x + most_run, film.region.x1);
  while (run.x1 < end && film.at(run.x1, y).taken == run.taken) ++run.x1;
  return run;
}

}  // namespace

void level(Crew& crew, const Kernels& kernels, const SceneView& scene, Film& film, const std::atomic<bool>& give_up,
           UnitCounts& counts, const std::function<void()>& poll) {
  const FilmTotals sum = totals(film);
  if (sum.least_taken == sum.most_taken) return;
  std::atomic<std::uint64_t> rays = 0, shadow_rays = 0;
  std::atomic<std::int64_t> cut_high = 0, cut_low = 0;
  const auto fill_row = [&](int row) {
    UnitCounts added;
    const int y = film.region.y0 + row;
    for (int x = film.region.x0; x < film.region.x1 && !give_up;) {
      const Run run = run_at(film, x, y);
      x = run.x1;
      if (run.taken == sum.most_taken) continue;
      std::array<FilmPixel, most_run> pixels{};
      const Unit unit{
          {run.x0, y, run.x1, y + 1}, 1, 0, film.first_sample + run.taken, film.first_sample + sum.most_taken};
      kernels.render_unit(scene, unit, film.unit, pixels.data(), added);
      for (int i = run.x0; i < run.x1; ++i) add_pixel(film.at(i, y), pixels[static_cast<std::size_t>(i - run.x0)]);
    }
    rays += added.rays;
    shadow_rays += added.shadow_rays;
    cut_high += added.cut_throughput.high;
    cut_low += added.cut_throughput.low;
  };
  crew.for_each(film.region.height(), fill_row, poll);
  counts.rays += rays;
  counts.shadow_rays += shadow_rays;
  film.cut_throughput.add(ExactSum{cut_high, cut_low});
}

}  // namespace tyndall
