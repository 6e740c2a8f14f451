#include "core/accuracy/error.h"
#include "core/accuracy/estimate.h"
#include "core/scene/load.h"
#include "tests/support/hard_for_filters.h"
#include "tests/support/prepared.h"
#include "tests/support/references.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

/// The clean view against the truth: how much better it is, whether anything gets worse, and whether it knows its
/// error.
namespace tyndall::test::clean_slow_test {

namespace {

constexpr double pixels = 320 * 180;
constexpr double rounding = 1e-12;  ///< of floats: pictures of one colour have no other relMSE
constexpr std::array<std::uint32_t, 6> counts{2, 4, 16, 64, 256, 1024};

/// Errors of one picture, without the noise of the reference.
struct Errors {
  double rel_mse = 0, flip = 0, mean = 0;  ///< mean: relative to the reference's, less 1
  std::vector<double> blocks;              ///< sums of squared relative errors
};

struct Row {
  std::string name;
  std::uint32_t spp;
  Errors raw, clean;
  double estimated = 0;   ///< over the true squared relative error
  double worse = 0;       ///< fraction of blocks that are worse than raw
  double excess = 0;      ///< by how much together, of raw's whole error
  bool doubtful = false;  ///< users are warned that the estimate cannot be trusted
};

Errors errors_of(const std::vector<float>& image, const Reference& reference, int width, int height) {
  constexpr int edge = 32;
  Errors e;
  const int columns = (width + edge - 1) / edge, rows = (height + edge - 1) / edge;
  e.blocks.resize(static_cast<std::size_t>(columns * rows));
  double sum = 0, own = 0, truth = 0;
  std::vector<float> both;
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double x = static_cast<double>(image[i]), a = static_cast<double>(reference.half[0][i]),
                 b = static_cast<double>(reference.half[1][i]), level = (a + b) / 2;
    const double square = (x - a) * (x - b) / (level * level + floor_of_square);
    const int pixel = static_cast<int>(i / 3);
    e.blocks[static_cast<std::size_t>(pixel / width / edge * columns + pixel % width / edge)] += square;
    sum += square, own += x, truth += level;
    both.push_back(static_cast<float>(level));
  }
  e.rel_mse = sum / static_cast<double>(image.size());
  e.mean = own / truth - 1;
  const std::vector<float> flip = flip_map(image, both, width, height);
  e.flip = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
  return e;
}

Row measured(const std::string& name, const Film& film, const CleanPicture& clean, std::uint32_t spp,
             const Reference& reference, double chance) {
  const int width = film.region.width(), height = film.region.height();
  Row row{name, spp, errors_of(resolve(film), reference, width, height),
          errors_of(clean.rgb, reference, width, height)};
  row.estimated = (clean.relative_error * clean.relative_error + rounding) / (row.clean.rel_mse + rounding);
  double all = 0;
  for (std::size_t i = 0; i < row.raw.blocks.size(); ++i) {
    const double before = std::max(row.raw.blocks[i], 0.0), after = std::max(row.clean.blocks[i], 0.0);
    row.worse += after > 1.02 * before + 1e-3 ? 1.0 / static_cast<double>(row.raw.blocks.size()) : 0;
    row.excess += std::max(after - before, 0.0), all += before;
  }
  row.excess /= std::max(all, rounding * static_cast<double>(clean.rgb.size()));
  row.doubtful = is_doubtful(clean, spp) || has_rare_bright_paths(estimate_error(film), spp, chance);
  std::printf("%-32s %4u  %.2e %.2e %5.1f  %5.2f  %.3f %.3f  %+.4f  %4.1f %% %.2f %% %s\n", name.c_str(), spp,
              row.raw.rel_mse, row.clean.rel_mse, row.raw.rel_mse / row.clean.rel_mse, row.estimated, row.raw.flip,
              row.clean.flip, row.clean.mean, 100 * row.worse, 100 * row.excess, row.doubtful ? "!" : "");
  std::fflush(stdout);
  return row;
}

void measure(const std::string& name, Scene scene, std::uint32_t reference_spp, std::vector<Row>& rows) {
  const double aspect = static_cast<double>(scene.width) / scene.height;
  scene.height = static_cast<int>(std::lround(std::sqrt(pixels / aspect)));
  scene.width = static_cast<int>(std::lround(scene.height * aspect));
  scene.render.adaptive = false;
  const Reference reference = reference_of(scene, reference_spp);
  const RenderScene compiled = compile(scene);
  const double chance = chance_of_caustics(scene, compiled);
  RenderOptions options{.clean = true};
  Film film;
  for (const std::uint32_t spp : counts) {
    options.spp = spp;
    RenderResult result = render(compiled, options, {}, std::move(film));
    REQUIRE(result.clean);
    rows.push_back(measured(name, result.film, *result.clean, spp, reference, chance));
    film = std::move(result.film);
  }
}

void print_head() {
  std::printf("%-32s %4s  %8s %8s %5s  %5s  %5s %5s  %7s  %6s %6s\n", "scene", "spp", "raw", "clean", "times", "est.",
              "FLIP", "clean", "mean", "worse", "by");
}

/// Of the rows with so many samples that are good or (`or_doubtful`) are warned of, the share.
template <class Good>
double throughput_of(const std::vector<Row>& rows, std::uint32_t first, std::uint32_t last, bool or_doubtful,
                     const Good& good) {
  int all = 0, fit = 0;
  for (const Row& row : rows)
    if (row.spp >= first && row.spp <= last) ++all, fit += good(row) || (or_doubtful && row.doubtful) ? 1 : 0;
  return static_cast<double>(fit) / std::max(all, 1);
}

/// Whether the estimated error, of which row.estimated has the square, is within these limits times the true one.
bool knows_its_error(const Row& row, double low, double high) {
  return row.estimated >= low * low && row.estimated <= high * high;
}

}  // namespace

TEST_CASE("clean view: never worse than the raw picture in any built-in scene, and it knows its error") {
  std::vector<Row> rows;
  print_head();
  for (const BuiltIn& built_in : built_in_scenes()) measure(built_in.name, load_scene(built_in.name).scene, 2048, rows);
  const auto band = [](const Row& row) { return knows_its_error(row, 0.8, 1.25); };
  const auto wide_band = [](const Row& row) { return knows_its_error(row, 0.6, 1.4); };
  const auto few_worse = [](const Row& row) { return row.worse <= 0.034 && row.excess <= 0.005; };  // 2 of 60 blocks
  for (const Row& row : rows) {
    CAPTURE(row.name);
    CAPTURE(row.spp);
    CHECK(row.clean.rel_mse <= 1.005 * row.raw.rel_mse + 1e-7);
    if (!row.doubtful) CHECK(row.excess < 0.05);
  }
  const double known = throughput_of(rows, 16, 1024, false, band), told = throughput_of(rows, 16, 1024, true, band),
               at_4 = throughput_of(rows, 4, 4, false, wide_band),
               blocks = throughput_of(rows, 2, 1024, true, few_worse);
  MESSAGE("estimated over true error from 16 spp on within [0.8, 1.25]: "
          << 100 * known << " %, or warned of: " << 100 * told << " %; at 4 within [0.6, 1.4]: " << 100 * at_4
          << " %; few blocks worse: " << 100 * blocks << " %");
  CHECK(known >= 0.95);
  CHECK(told >= 0.95);
  CHECK(at_4 >= 0.9);
  CHECK(blocks >= 0.9);
}

TEST_CASE("clean view: scenes made to break filters") {
  std::vector<Row> rows;
  print_head();
  for (const auto& [name, scene] : scenes_hard_for_filters()) measure(name, scene, 2048, rows);
  for (const Row& row : rows) {
    CAPTURE(row.name);
    CAPTURE(row.spp);
    CHECK(row.clean.rel_mse <= 1.02 * row.raw.rel_mse + 1e-7);
    const bool specks = row.name == "lamps of one pixel";  // whose own noise, which stays, decides what the mean is
    CHECK(std::abs(row.clean.mean) < (specks ? 0.25 : row.spp < 64 ? 0.02 : 0.005));
  }
}

}  // namespace tyndall::test::clean_slow_test
