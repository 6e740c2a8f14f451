#include "app/check/check.h"
#include "app/check/statistics.h"
#include "core/base/seconds.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

namespace tyndall {
namespace {

constexpr int max_columns = 64, block_edge = 4;  // of the small picture; of a block in pixels
constexpr double seconds_of_program = 0.5;
constexpr int fewest_samples = 4, most_samples = 200;  // a pixel
constexpr double brightest_sample = 2;                 // of what a sample counts for: few of them would decide else
constexpr double noise_allowed = 5, part_allowed = 0.03, darkest_level = 0.01, blocks_allowed = 0.02;

/// BlockLight of a block's samples, for the three channels.
struct BlockLight {
  std::array<double, 3> sum{}, squares{};
  int count = 0;
  void add(const std::array<double, 3>& light, double brightest) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = std::isfinite(light[k]) ? std::clamp(light[k], 0.0, brightest) : 0;
      sum[k] += value, squares[k] += value * value;
    }
    ++count;
  }
  double mean(std::size_t k) const { return sum[k] / count; }
  /// Of the mean.
  double variance(std::size_t k) const {
    return std::max(squares[k] / count - mean(k) * mean(k), 0.0) / std::max(count - 1, 1);
  }
};

bool apart(const BlockLight& a, const BlockLight& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double difference = std::fabs(a.mean(k) - b.mean(k)), level = std::max({a.mean(k), b.mean(k), darkest_level});
    if (difference > noise_allowed * std::sqrt(a.variance(k) + b.variance(k)) && difference > part_allowed * level)
      return true;
  }
  return false;
}

/// The sums of the blocks, from left to right, the upper ones first. add_pixel(pixel of the lattice, sums): adds its
/// samples to those of its block.
template <class AddPixel>
std::vector<BlockLight> sums_of(const Lattice& lattice, const AddPixel& add_pixel) {
  const Regions regions = blocks_of(lattice, block_edge);
  std::vector<BlockLight> blocks(static_cast<std::size_t>(regions.count));
  for (std::size_t pixel = 0; pixel < lattice.pixels(); ++pixel)
    add_pixel(pixel, blocks[static_cast<std::size_t>(regions.of_pixel[pixel])]);
  return blocks;
}

/// One sample of each pixel of the lattice.
std::vector<double> ask_once(OwnProgram& program, const Lattice& lattice, int sample) {
  std::vector<double> places;
  const double across = std::fmod(0.5 + 0.7548776662466927 * sample, 1),
               down = std::fmod(0.5 + 0.5698402909980532 * sample, 1);
  for (int y = 0; y < lattice.rows(); ++y)
    for (int x = 0; x < lattice.columns(); ++x)
      places.insert(places.end(), {x * lattice.step + across, y * lattice.step + down});
  return program.samples(places);
}

/// What a sample counts for at most. Samples that are drawn in another way have other bright ones, and the same mean.
double brightest_of(const ProgramScene& program) { return program.draws_by_pdf ? 1e9 : brightest_sample; }

std::vector<BlockLight> own_blocks(const ProgramScene& program, const Lattice& lattice, int& count) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::vector<double>> all;
  while (all.size() < fewest_samples || (all.size() < most_samples && seconds_since(begin) < seconds_of_program))
    all.push_back(ask_once(*program.own, lattice, static_cast<int>(all.size())));
  count = static_cast<int>(all.size());
  return sums_of(lattice, [&](std::size_t pixel, BlockLight& sums) {
    for (const std::vector<double>& one : all)
      sums.add({one[3 * pixel], one[3 * pixel + 1], one[3 * pixel + 2]}, brightest_of(program));
  });
}

std::vector<BlockLight> our_blocks(const Scene& scene, const ProgramScene& program, const Lattice& lattice, int count) {
  BookProgram ours{scene, {}};
  BookRules& rules = ours.rules;
  rules.schlick = true;
  rules.short_frame = program.short_frame;
  if (program.matt_in_sphere) rules.diffuse = DiffuseRule::filled_sphere;
  if (program.fuzz_on_sphere) rules.fuzz = FuzzRule::sphere;
  ThreadPool pool(0);
  const std::vector<BookSample> samples = book_samples(ours, lattice, count, pool, [] { return true; });
  return sums_of(lattice, [&](std::size_t pixel, BlockLight& sums) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const Vec3f& light = samples[pixel * static_cast<std::size_t>(count) + k].light;
      sums.add({light.x, light.y, light.z}, brightest_of(program));
    }
  });
}

}  // namespace

std::string differs_from_own(const Scene& scene, const ProgramScene& program) {
  if (program.has_noise || program.has_images) return "";
  const Lattice lattice{scene.width, scene.height, std::max(1, scene.width / max_columns)};
  int count = 0;
  const std::vector<BlockLight> own = own_blocks(program, lattice, count),
                                ours = our_blocks(scene, program, lattice, count);
  // Rare bright samples decide more blocks where the two draw in different ways.
  const double allowed = program.draws_by_pdf ? 5 * blocks_allowed : blocks_allowed;
  std::size_t different = 0, first = own.size();
  for (std::size_t k = 0; k < own.size(); ++k)
    if (apart(own[k], ours[k])) ++different, first = std::min(first, k);
  if (static_cast<double>(different) <= std::max(1.0, allowed * static_cast<double>(own.size()))) return "";
  const int columns = (lattice.columns() + block_edge - 1) / block_edge, size = block_edge * lattice.step;
  return fmt::format("what it computes differs from its scene in {} of {} blocks, first at pixel ({}, {})", different,
                     own.size(), static_cast<int>(first) % columns * size, static_cast<int>(first) / columns * size);
}

}  // namespace tyndall
