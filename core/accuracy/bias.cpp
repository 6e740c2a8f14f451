#include "core/accuracy/bias.h"

#include "core/film/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

double grey(Vec3f v) { return (static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z)) / 3; }

struct RegionSum {
  double value = 0, variance = 0;
  bool whole = true;  ///< both halves of every pixel have samples

  RegionSum(const Film& film, const Region& region) {
    const auto deviation = [&](const FilmPixel& pixel) {
      whole = whole && counted(film, pixel, 0) > 0 && counted(film, pixel, 1) > 0;
      value += grey(mean(film, pixel));
      return (grey(half_mean(film, pixel, 0)) - grey(half_mean(film, pixel, 1))) / 2;
    };
    for (const double group : group_sums(film, region, deviation)) variance += group * group;
  }
};

}  // namespace

BlockScores block_scores(const Film& a, const Film& b, int edge) {
  BlockScores scores;
  if (!(a.region == b.region)) return scores;
  const Region& r = a.region;
  double squares = 0;
  for (int y0 = r.y0; y0 < r.y1; y0 += edge)
    for (int x0 = r.x0; x0 < r.x1; x0 += edge) {
      const Region block{x0, y0, std::min(x0 + edge, r.x1), std::min(y0 + edge, r.y1)};
      const RegionSum of_a(a, block), of_b(b, block);
      if (!of_a.whole || !of_b.whole) return {};
      const double difference = of_a.value - of_b.value, variance = of_a.variance + of_b.variance;
      if (variance == 0 && difference == 0) continue;
      const double square = variance > 0 ? difference * difference / variance : std::numeric_limits<double>::infinity();
      scores.worst = std::max(scores.worst, std::sqrt(square));
      squares += square;
      ++scores.blocks;
    }
  if (scores.blocks == 0) return scores;
  scores.mean_square = squares / scores.blocks;
  // The standard errors are estimated, too, from one number for each group of both films: z follows Student's t
  // distribution, whose variance is freedom / (freedom - 2).
  const double freedom = 2.0 * edge * edge / group_size;
  scores.maximum = freedom / (freedom - 2) + 4 * std::sqrt(2.0 / scores.blocks);
  return scores;
}

}  // namespace tyndall
