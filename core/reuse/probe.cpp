#include "core/reuse/probe.h"

#include "core/reuse/reuse_tile.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace tyndall {
namespace {

constexpr int across = 8;               // groups in each direction of the picture
constexpr double fewest_seconds = 0.2;  // fraction of the paths; below it reuse never pays
constexpr int deepest = 16;             // events of the probe's paths: enough to decide, and quick in white rooms

/// Fills in `samples` samples each of groups of pixels that are spread evenly over the picture.
void spread_groups(const SceneView& s, int samples, ReusedPaths& paths) {
  paths.clear();
  paths.groups = 0;
  const auto spread = [](int i, int size, int block, int offset) {
    const auto middle = static_cast<int>((2 * i + 1) * std::int64_t{size} / (2 * across));
    return std::min(middle / block * block + offset % group_spacing, size - 1);
  };
  for (int i = 0; i < samples * across * across; ++i) {
    const int place = i / samples, at = paths.groups++;
    paths.x[at] = spread(place % across, s.width, block_width, place);
    paths.y[at] = spread(place / across, s.height, block_height, place / group_spacing);
    paths.index[at] = static_cast<std::uint32_t>(i % samples);
    for (int k = 0; k < group_size; ++k) {
      const bool inside = paths.x[at] + k % group_columns * group_spacing < s.width &&
                          paths.y[at] + k / group_columns * group_spacing < s.height;
      paths.pixel[k * ReusedPaths::max_groups + at] = inside ? ReusedPaths::unwanted : ReusedPaths::outside;
    }
  }
}

/// The samples without what other paths of their groups contribute.
void add_own_leaving(const ReusedPaths& p, float (&own)[3][ReusedPaths::room]) {
  for (int c = 0; c < 3; ++c)
    for (int slot = 0; slot < ReusedPaths::room; ++slot) {
      own[c][slot] = p.own[c][slot];
      if (p.second.even[slot] >= 0) own[c][slot] += p.albedo[c][slot] * p.leaving[c][slot];
    }
}

/// Mean squared difference of the two samples of a pixel, relative to the mean over its group.
double variance(const ReusedPaths& p, const float (&own)[3][ReusedPaths::room]) {
  double sum = 0;
  for (int group = 0; group < p.groups; group += 2)
    for (int c = 0; c < 3; ++c) {
      double mean = 0, square = 0;
      for (int k = 0; k < group_size; ++k) {
        const int slot = k * ReusedPaths::max_groups + group;
        const double a = static_cast<double>(own[c][slot]), b = static_cast<double>(own[c][slot + 1]);
        mean += (a + b) / (2 * group_size), square += (a - b) * (a - b);
      }
      sum += square / (mean * mean + 0.01);
    }
  return sum;
}

/// Fraction of the paths whose first two vertices are diffuse.
double fraction_of_seconds(SceneView s, ReusedPaths& paths, TraceGroups trace) {
  s.max_depth = std::min(s.max_depth, 1);
  spread_groups(s, 1, paths);
  TileCounts counts;
  trace(s, paths, counts);
  const auto seconds =
      std::count_if(paths.second.even, paths.second.even + ReusedPaths::room, [](float even) { return even >= 0; });
  return static_cast<double>(seconds) / (across * across * group_size);
}

}  // namespace

ReuseGain probe_reuse(const SceneView& scene, TraceGroups trace) {
  SceneView s = scene;
  s.reuses_paths = true;
  s.splits_paths = false;  // branches have no second vertices
  s.seed = 0;
  const auto paths = std::make_unique<ReusedPaths>();
  if (fraction_of_seconds(s, *paths, trace) < fewest_seconds) return {};
  s.max_depth = std::min(s.max_depth, deepest);
  struct Samples {
    float own[3][ReusedPaths::room];
  };
  const auto alone = std::make_unique<Samples>();
  spread_groups(s, 2, *paths);
  TileCounts counts;
  trace(s, *paths, counts);
  const auto rays_alone = static_cast<double>(counts.rays);
  add_own_leaving(*paths, alone->own);
  reuse_second_vertices<float>(s, *paths, counts);
  const double without = variance(*paths, alone->own);
  const double between = static_cast<double>(counts.rays) - rays_alone;
  return {true, without > 0 ? variance(*paths, paths->own) / without : 1, 1 + between / rays_alone / 2};
}

}  // namespace tyndall
