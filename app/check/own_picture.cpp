#include "app/check/check.h"
#include "core/base/seconds.h"

#include <fmt/core.h>

#include <chrono>

namespace tyndall {
namespace {

constexpr int max_columns = 64, block_edge = 4;  // of the small picture; of a block in pixels
constexpr double seconds_of_program = 0.5;
constexpr int fewest_samples = 4, most_samples = 200;  // a pixel
constexpr float brightest_sample = 2;                  // of what a sample counts for: few of them would decide else
constexpr double noise_allowed = 5, part_allowed = 0.03, darkest_level = 0.01, blocks_allowed = 0.02;

/// The samples of each cell, by themselves. brightest: what a sample counts for at most.
std::vector<Pairs> sums_of(const std::vector<BookSample>& samples, const Regions& regions, float brightest) {
  std::vector<Pairs> sums(regions.cells());
  const std::size_t count = samples.size() / regions.of_pixel.size();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    std::size_t cell = regions.cell_of(3 * (k / count));
    for (const float Vec3f::*channel : each_channel) {
      const float own = samples[k].light.*channel;
      const auto value = static_cast<double>(std::isfinite(own) ? std::clamp(own, 0.0f, brightest) : 0);
      sums[cell++].add(value, value);
    }
  }
  return sums;
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

/// As many samples of each pixel as the program computes in its time: those of a pixel follow each other.
std::vector<BookSample> own_samples(const ProgramScene& program, const Lattice& lattice) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::vector<double>> all;
  while (all.size() < fewest_samples || (all.size() < most_samples && seconds_since(begin) < seconds_of_program))
    all.push_back(ask_once(*program.own, lattice, static_cast<int>(all.size())));
  std::vector<BookSample> samples;
  for (std::size_t pixel = 0; pixel < lattice.pixels(); ++pixel)
    for (const std::vector<double>& one : all)
      samples.push_back({to_float({one[3 * pixel], one[3 * pixel + 1], one[3 * pixel + 2]})});
  return samples;
}

}  // namespace

std::string differs_from_own(const Scene& scene, const ProgramScene& program) {
  if (program.has_noise || program.has_images) return "";
  const Lattice lattice{scene.width, scene.height, std::max(1, scene.width / max_columns)};
  const Regions regions = blocks_of(lattice, block_edge);
  // Samples that are drawn in another way have other bright ones, and the same mean. Rare bright ones decide more
  // blocks there.
  const float brightest = program.draws_by_pdf ? 1e9f : brightest_sample;
  const double allowed = program.draws_by_pdf ? 5 * blocks_allowed : blocks_allowed;
  const std::vector<BookSample> samples = own_samples(program, lattice);
  const int count = static_cast<int>(samples.size() / lattice.pixels());
  const BookRules rules{.diffuse = program.matt_in_sphere ? DiffuseRule::filled_sphere : DiffuseRule::cosine,
                        .fuzz = program.fuzz_on_sphere ? FuzzRule::sphere : FuzzRule::filled_sphere,
                        .schlick = true,
                        .short_frame = program.short_frame};
  const std::vector<Pairs> own = sums_of(samples, regions, brightest),
                           ours = sums_of(book_samples({scene, rules}, lattice, count), regions, brightest);
  const auto apart = [&](std::size_t cell) {
    const double a = own[cell].mean(), b = ours[cell].mean(), difference = std::abs(a - b);
    return difference > noise_allowed * std::sqrt(own[cell].variance_of_mean() + ours[cell].variance_of_mean()) &&
           difference > part_allowed * std::max({a, b, darkest_level});
  };
  int different = 0, first = regions.count;
  for (std::size_t cell = 0; cell < regions.cells(); cell += 3)
    if (apart(cell) || apart(cell + 1) || apart(cell + 2))
      ++different, first = std::min(first, static_cast<int>(cell / 3));
  if (different <= std::max(1.0, allowed * regions.count)) return "";
  const int columns = (lattice.columns() + block_edge - 1) / block_edge, size = block_edge * lattice.step;
  return fmt::format("what it computes differs from its scene in {} of {} blocks, first at pixel ({}, {})", different,
                     regions.count, first % columns * size, first / columns * size);
}

}  // namespace tyndall
