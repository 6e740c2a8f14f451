#include "core/render/plan.h"

#include "core/accuracy/estimate.h"
#include "core/base/elementary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tyndall {
namespace {

/// The cells that a film's region is cut into, from its upper left corner.
struct Cells {
  Region region;
  int columns, rows;

  explicit Cells(const Region& r)
      : region(r), columns((r.width() + cell_edge - 1) / cell_edge), rows((r.height() + cell_edge - 1) / cell_edge) {}

  std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  Region pixels(int column, int row) const {
    const int x = region.x0 + column * cell_edge, y = region.y0 + row * cell_edge;
    return {x, y, std::min(x + cell_edge, region.x1), std::min(y + cell_edge, region.y1)};
  }
  Region pixels(std::size_t i) const {
    const auto width = static_cast<std::size_t>(columns);
    return pixels(static_cast<int>(i % width), static_cast<int>(i / width));
  }
  /// The number of pixels of each cell: fewer than 16 at the right and lower edge.
  std::vector<std::uint64_t> areas() const {
    std::vector<std::uint64_t> found;
    for (std::size_t i = 0; i < count(); ++i) {
      const Region r = pixels(i);
      found.push_back(static_cast<std::uint64_t>(r.width()) * static_cast<std::uint64_t>(r.height()));
    }
    return found;
  }
};

constexpr double max_taken = 1 << 24;  // more samples would overflow a film's sums

/// The noise of some pixels, as sums over those with samples in both halves.
struct Variance {
  double sum = 0;  ///< sum of squared relative error times count²
  int pixels = 0;
};

/// errors: squared_relative_errors of the film.
Variance variance_in(const Film& film, const std::vector<double>& errors, const Region& where) {
  Variance found;
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x) {
      const double error = errors[film.index(x, y)], taken = film.at(x, y).taken;
      if (!std::isfinite(error)) continue;
      found.sum += error * taken * taken;
      ++found.pixels;
    }
  return found;
}

/// Cube root of the mean over the window around a cell, without the cell itself. If squared error falls with the square
/// of the count, counts in proportion to this number minimise the sum of squared errors.
double demand_of(const std::vector<Variance>& variances, const Cells& cells, int column, int row) {
  Variance around;
  for (int v = std::max(row - window_reach, 0); v <= std::min(row + window_reach, cells.rows - 1); ++v)
    for (int u = std::max(column - window_reach, 0); u <= std::min(column + window_reach, cells.columns - 1); ++u) {
      if (u == column && v == row) continue;
      const Variance& one = variances[cells.index(u, v)];
      around.sum += one.sum;
      around.pixels += one.pixels;
    }
  return around.pixels > 0 ? to_the_power(around.sum / around.pixels, 1.0 / 3) : 0;
}

/// The demand of each cell, relative to the mean over all cells; above 0, so that a round can reach its mean.
std::vector<double> demands_of(const Film& film, const Cells& cells, ThreadPool& thread_pool) {
  const std::vector<double> errors = squared_relative_errors(film, &thread_pool);
  std::vector<Variance> variances(cells.count());
  thread_pool.for_each(cells.rows, [&](int row) {
    for (int column = 0; column < cells.columns; ++column)
      variances[cells.index(column, row)] = variance_in(film, errors, cells.pixels(column, row));
  });
  std::vector<double> demands(cells.count());
  thread_pool.for_each(cells.rows, [&](int row) {
    for (int column = 0; column < cells.columns; ++column)
      demands[cells.index(column, row)] = demand_of(variances, cells, column, row);
  });
  const double mean = std::accumulate(demands.begin(), demands.end(), 0.0) / static_cast<double>(demands.size());
  for (double& demand : demands) demand = mean > 0 ? std::max(demand / mean, 1e-3) : 1;
  return demands;
}

/// A number in [0, 2^16) for each cell, by multiples of the golden ratio, which spreads the numbers of neighbours in
/// the list evenly. It orders cells with equal counts: they get their next samples one after the other during the
/// round.
std::uint64_t dither(std::size_t cell) { return (cell * 40503) & 0xffff; }

/// The nearest power of two, because Sobol' points are spread most evenly then. Counts in between would raise the error
/// by up to a third in smooth parts of a picture.
std::uint32_t rounded(double count) { return std::bit_floor(static_cast<std::uint32_t>(std::numbers::sqrt2 * count)); }

/// Gives each cell a count in proportion to its demand: a demand of 1 gets `scale` samples. Also sums the counts over
/// all pixels.
struct SampleAllocation {
  std::vector<std::uint64_t> areas;
  const std::vector<double>& demands;
  const std::vector<PlannedSamples>& planned;
  double mean;

  double wish(std::size_t cell, double scale) const {
    return std::min(std::clamp(scale * demands[cell], min_of_mean * mean, max_of_mean * mean), max_taken);
  }
  std::uint32_t of(std::size_t cell, double scale) const {
    return std::max(rounded(wish(cell, scale)), planned[cell].from);
  }
  double total(double scale) const {
    double sum = 0;
    for (std::size_t i = 0; i < demands.size(); ++i) sum += static_cast<double>(of(i, scale) * areas[i]);
    return sum;
  }
};

/// The highest scale whose total is at most `budget`.
double find_scale(const SampleAllocation& allocation, double budget) {
  double low = 0, high = allocation.mean;
  while (allocation.total(high) <= budget && high < 1e6 * allocation.mean) low = high, high *= 2;
  for (int halving = 0; halving < 16; ++halving) {
    const double middle = 0.5 * (low + high);
    (allocation.total(middle) <= budget ? low : high) = middle;
  }
  return low;
}

/// Rounding leaves a part of the budget. This spends it on cells that were rounded down, so that the mean of the counts
/// becomes the number of samples that the picture is labelled with.
void spend(double left, const SampleAllocation& allocation, double scale, std::vector<PlannedSamples>& planned) {
  for (std::size_t i = 0; i < planned.size(); ++i) {
    if (allocation.wish(i, scale) <= planned[i].to) continue;
    const double more =
        std::min<double>(planned[i].to, 2 * std::floor(left / static_cast<double>(2 * allocation.areas[i])));
    planned[i].to += static_cast<std::uint32_t>(more);
    left -= more * static_cast<double>(allocation.areas[i]);
  }
}

/// Factor by which the best counts would lower the squared error, compared with even counts, if it falls as 1/count.
/// The best counts are in proportion to the root of the variance.
double best_gain(const std::vector<double>& demands) {
  double variances = 0, roots = 0;
  for (const double demand : demands) variances += demand * demand * demand, roots += demand * std::sqrt(demand);
  return variances * static_cast<double>(demands.size()) / (roots * roots);
}

/// The same factor for the counts of a plan.
double expected_gain(const std::vector<double>& demands, const std::vector<PlannedSamples>& planned, double mean) {
  double even = 0, as_planned = 0;
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const double variance = demands[i] * demands[i] * demands[i];
    even += variance / mean, as_planned += variance / planned[i].to;
  }
  return even / as_planned;
}

/// The mean that a round was to reach: the mean of the counts, rounded up to a power of two.
std::uint32_t round_mean(const Film& film, std::uint32_t PlannedSamples::*count) {
  const std::vector<std::uint64_t> areas = Cells(film.region).areas();
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < film.planned.size(); ++i) sum += film.planned[i].*count * areas[i];
  return static_cast<std::uint32_t>(std::bit_ceil((sum + film.pixels.size() - 1) / film.pixels.size()));
}

}  // namespace

void plan_round(Film& film, ThreadPool& thread_pool) {
  const Cells cells(film.region);
  std::vector<PlannedSamples> planned(cells.count());
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const Region where = cells.pixels(i);
    planned[i].from = planned[i].to = film.at(where.x0, where.y0).taken;
  }
  film.planned = std::move(planned);
  const double mean = 2.0 * round_mean(film, &PlannedSamples::from);
  const std::vector<double> demands = demands_of(film, cells, thread_pool);
  const bool still_even = !planned_unevenly(film);
  const auto stay_even = [&] {
    for (PlannedSamples& p : film.planned) p.to = static_cast<std::uint32_t>(mean);
  };
  if (still_even && best_gain(demands) < min_gain) return stay_even();  // not even the best counts would gain enough
  const SampleAllocation allocation{cells.areas(), demands, film.planned, mean};
  const double budget = mean * static_cast<double>(film.pixels.size()), scale = find_scale(allocation, budget);
  const double left = budget - allocation.total(scale);
  for (std::size_t i = 0; i < demands.size(); ++i) film.planned[i].to = allocation.of(i, scale);
  spend(left, allocation, scale, film.planned);
  if (still_even && expected_gain(demands, film.planned, mean) < min_gain) stay_even();
}

std::uint32_t planned_mean(const Film& film) {
  return film.planned.empty() ? 0 : round_mean(film, &PlannedSamples::to);
}

std::uint32_t end_of_round(Film& film, std::uint32_t taken, ThreadPool& thread_pool) {
  if (taken < warm_up) return warm_up;
  if (taken >= planned_mean(film)) plan_round(film, thread_pool);
  return planned_mean(film);
}

bool planned_unevenly(const Film& film) {
  const auto differs = [&film](const PlannedSamples& planned) { return planned != film.planned.front(); };
  return std::any_of(film.planned.begin(), film.planned.end(), differs);
}

std::vector<std::uint32_t> counts_at(const Film& film, std::uint32_t spp) {
  const Cells cells(film.region);
  const std::vector<std::uint64_t> areas = cells.areas();
  const auto count = [&film](std::size_t cell, std::uint64_t part) {
    const auto [from, to] = film.planned[cell];
    return from + static_cast<std::uint32_t>(((to - from) * part + dither(cell)) >> 16);
  };
  const auto fits = [&](std::uint64_t part) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < film.planned.size(); ++i) sum += count(i, part) * areas[i];
    return sum <= spp * film.pixels.size();
  };
  std::uint64_t part = 0;  // progress of the round, in 65536ths
  for (std::uint64_t step = 0x10000; step > 0; step /= 2)
    if (part + step <= 0x10000 && fits(part + step)) part += step;
  std::vector<std::uint32_t> counts(film.pixels.size());
  for (std::size_t i = 0; i < film.planned.size(); ++i) {
    const Region where = cells.pixels(i);
    for (int y = where.y0; y < where.y1; ++y)
      for (int x = where.x0; x < where.x1; ++x) counts[film.index(x, y)] = count(i, part);
  }
  return counts;
}

std::uint32_t labelled_spp(const Film& film) { return labelled_spp(film, totals(film)); }

std::uint32_t labelled_spp(const Film& film, const FilmTotals& sum) {
  if (film.planned.empty()) return sum.min_taken;
  return static_cast<std::uint32_t>(
      std::llround(static_cast<double>(sum.samples) / static_cast<double>(film.pixels.size())));
}

}  // namespace tyndall
