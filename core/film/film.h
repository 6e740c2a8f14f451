#pragma once
#include "core/base/vec.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What a render gathers: exact sums of each pixel's samples, and their counts; and how the films of several machines
/// or runs become one. The sums are equal to the last bit whatever the order of their numbers, so that threads, tiles,
/// pauses and machines cannot change a picture.
namespace tyndall {

/// A sum in fixed point, held as two integers: `high` counts 2^-29 of the film's `quantum`, `low` counts 2^-61 of it.
/// Smaller bits of each number are cut off before it is added. 2^24 numbers below 2^30 quanta fit if their sum is below
/// 2^34 quanta. The samples of a pixel meet this: their mean is at most one quantum, so that a sample of 2^30 quanta
/// has a probability of at most 2^-30, and 16 of them among 2^24 samples one of 2^-140.
struct ExactSum {
  std::int64_t high = 0, low = 0;

  /// x: the number divided by the film's quantum, |x| < 2^30.
  TYNDALL_INLINE void add(double x) {
    const double scaled = x * 0x1p29;
    const auto whole = static_cast<std::int64_t>(scaled);
    high += whole;
    low += static_cast<std::int64_t>((scaled - static_cast<double>(whole)) * 0x1p32);
  }
  TYNDALL_INLINE void add(const ExactSum& other) {
    high += other.high;
    low += other.low;
  }
  /// The sum divided by the film's quantum, rounded to double.
  double value() const { return static_cast<double>(high) * 0x1p-29 + static_cast<double>(low) * 0x1p-61; }
  bool operator==(const ExactSum&) const = default;
};

// Four numbers side by side: the compiler computes with all of them at once if the CPU can.
using FourDoubles [[gnu::vector_size(32)]] = double;
using FourIntegers [[gnu::vector_size(32)]] = std::int64_t;
using TwoIntegers [[gnu::vector_size(16)]] = std::int64_t;

/// Adds a number to each of three sums, as ExactSum::add() does.
TYNDALL_INLINE void add_each(ExactSum (&to)[3], double x, double y, double z) {
  const FourDoubles scaled = FourDoubles{x, y, z, 0} * 0x1p29;
  const auto whole = __builtin_convertvector(scaled, FourIntegers);
  const FourDoubles rest = (scaled - __builtin_convertvector(whole, FourDoubles)) * 0x1p32;
  const auto low = __builtin_convertvector(rest, FourIntegers);
  void *const of_xy = &to[0], *const of_z = &to[2];
  FourIntegers xy;
  TwoIntegers z_alone;
  __builtin_memcpy(&xy, of_xy, sizeof xy), __builtin_memcpy(&z_alone, of_z, sizeof z_alone);
  xy += __builtin_shufflevector(whole, low, 0, 4, 1, 5);
  z_alone += __builtin_shufflevector(whole, low, 2, 6);
  __builtin_memcpy(of_xy, &xy, sizeof xy), __builtin_memcpy(of_z, &z_alone, sizeof z_alone);
}

/// Pixels x0 <= x < x1, y0 <= y < y1 of the full image, y down.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const Region&) const = default;
};

/// The sums of a pixel: the exact sum of each channel, separately for even and odd sample indices. These two halves are
/// independently random, so that their difference shows the error. 112 bytes.
struct FilmPixel {
  ExactSum sum[2][3];
  std::uint32_t taken = 0;             ///< both halves, rejected samples included: indices first … first + taken - 1
  std::uint32_t rejected[2] = {0, 0};  ///< samples that were not finite or out of range: in neither sum nor count
  std::uint32_t truncated = 0;         ///< paths cut off at max_depth
  bool operator==(const FilmPixel&) const = default;
};
static_assert(sizeof(FilmPixel) == 112);

/// The part of a pixel's sums that came straight from lights and sky, by paths that met only smooth glass and mirrors
/// before. It shows filters where lights are seen. The sums count 2^-29 of the film's quantum; smaller bits of each
/// sample are cut off, as in the high part of an ExactSum, so that as many samples fit.
struct EmissionSums {
  std::int64_t sum[2][3] = {};
  bool operator==(const EmissionSums&) const = default;
};

/// The plan of a round of adaptive sampling for a cell of pixels.
struct PlannedSamples {
  std::uint32_t from = 0;  ///< samples taken at its start
  std::uint32_t to = 0;    ///< samples taken at its end
  bool operator==(const PlannedSamples&) const = default;
};

/// Samples gathered for the pixels of a region. Adding films of disjoint sample ranges gives, bit for bit, the film of
/// all these samples.
struct Film {
  int width = 0, height = 0;           ///< of the full image
  Region region;                       ///< the part of the image that the film holds
  std::uint32_t first_sample = 0;      ///< index of every pixel's first sample
  double quantum = 1;                  ///< sums are divided by it: a power of two not below the brightest emitter
  ExactSum cut_throughput;             ///< sum over paths that max_depth cut off: their throughput's brightest channel
  std::vector<FilmPixel> pixels;       ///< of the region, row by row
  std::vector<EmissionSums> emission;  ///< likewise; empty: not recorded (no lights, or a film of an older version)
  /// For each cell of 4 x 4 pixels the current or last round of adaptive sampling (see plan.h); empty: none yet.
  std::vector<PlannedSamples> planned;

  FilmPixel& at(int x, int y) { return pixels[index(x, y)]; }
  const FilmPixel& at(int x, int y) const { return pixels[index(x, y)]; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - region.y0) * static_cast<std::size_t>(region.width()) +
           static_cast<std::size_t>(x - region.x0);
  }
  bool operator==(const Film&) const = default;
};

/// An empty film. quantum: see Film; emission: whether to record it.
Film make_film(int width, int height, Region region, std::uint32_t first_sample, double quantum, bool emission = false);

/// Bytes of memory that a film takes for each pixel.
inline std::size_t bytes_per_pixel(bool emission) { return sizeof(FilmPixel) + (emission ? sizeof(EmissionSums) : 0); }

/// A power of two not below `brightest` (>= 0); 1 for a scene without light.
double film_quantum(double brightest);

/// Number of samples that count in one half (0 or 1) of a pixel.
inline std::uint32_t counted(const Film& film, const FilmPixel& pixel, int half) {
  const bool first_is_odd = film.first_sample % 2 != 0;
  const bool starts_here = first_is_odd == (half == 1);
  const std::uint32_t taken = pixel.taken / 2 + (starts_here ? pixel.taken % 2 : 0);
  return taken - pixel.rejected[half];
}

/// Mean radiance of a pixel or of one of its halves; black before the first sample.
Vec3f mean(const Film& film, const FilmPixel& pixel);
Vec3f half_mean(const Film& film, const FilmPixel& pixel, int half);
/// Mean emission of a half of the pixel with that index; black if emission is not recorded.
Vec3f half_emission(const Film& film, std::size_t pixel, int half);

/// A sample must be below this many quanta of its film to be added: see ExactSum. Only integrator nee comes near the
/// limit, in media with g above 0.9998, whose phase functions have a high peak.
inline constexpr double sample_limit = 0x1p30;

/// A sample in quanta of its film, and whether a film accepts it.
struct ScaledSample {
  double x, y, z;
  TYNDALL_INLINE bool fits() const {
    const auto fits = [](double v) { return __builtin_fabs(v) < sample_limit; };
    return fits(x) && fits(y) && fits(z);
  }
};
TYNDALL_INLINE ScaledSample scaled(Vec3f radiance, double per_quantum) {
  return {static_cast<double>(radiance.x) * per_quantum, static_cast<double>(radiance.y) * per_quantum,
          static_cast<double>(radiance.z) * per_quantum};
}

/// Adds one sample of a pixel. half: the sample's index & 1. A sample that is not finite, or not below sample_limit
/// quanta, is counted as rejected instead. Does not change `taken`.
TYNDALL_INLINE void add_sample(FilmPixel& pixel, std::uint32_t half, Vec3f radiance, double per_quantum) {
  const ScaledSample sample = scaled(radiance, per_quantum);
  if (!sample.fits()) {
    ++pixel.rejected[half];
    return;
  }
  add_each(pixel.sum[half], sample.x, sample.y, sample.z);
}
/// Adds a sample to the sums of emission, unless add_sample() rejects it.
TYNDALL_INLINE void add_emission(EmissionSums& to, std::uint32_t half, Vec3f radiance, double per_quantum) {
  const ScaledSample sample = scaled(radiance, per_quantum);
  if (!sample.fits()) return;
  to.sum[half][0] += static_cast<std::int64_t>(sample.x * 0x1p29);
  to.sum[half][1] += static_cast<std::int64_t>(sample.y * 0x1p29);
  to.sum[half][2] += static_cast<std::int64_t>(sample.z * 0x1p29);
}

/// Adds the sums and counts that another buffer holds for the same pixel.
void add_pixel(FilmPixel& to, const FilmPixel& from);
void add_emission(EmissionSums& to, const EmissionSums& from);

/// Means of the region, 3 floats a pixel, top row first.
std::vector<float> resolve(const Film& film);

/// 64-bit FNV-1a over width, height (32-bit little endian) and the float32 RGB means, top row first, −0 as +0.
std::uint64_t image_hash(int width, int height, const std::vector<float>& rgb);

struct FilmTotals {
  std::uint64_t samples = 0, rejected = 0, truncated = 0;
  double cut_throughput = 0;                   ///< Film::cut_throughput over the number of samples, at most 1
  std::uint32_t min_taken = 0, max_taken = 0;  ///< of any pixel
};
FilmTotals totals(const Film& film);

/// A checksum of size, region, first sample, quantum, sums, counts and planned rounds, and of the text that goes with
/// them. Films or texts that differ in a single bit always get different ones, others almost always. Not safe against
/// films made by an adversary.
std::uint64_t film_checksum(const Film& film, std::string_view text);

/// Edge, in pixels, of the cells that have an entry in Film::planned. They are cut from the upper left corner of the
/// film's region, row by row; cells at the right and lower edge may be smaller.
inline constexpr int planned_cell_edge = 4;

/// Number of cells of a region: in a row, and in all.
inline std::size_t planned_columns(const Region& region) {
  return static_cast<std::size_t>((region.width() + planned_cell_edge - 1) / planned_cell_edge);
}
inline std::size_t planned_cells(const Region& region) {
  return planned_columns(region) *
         static_cast<std::size_t>((region.height() + planned_cell_edge - 1) / planned_cell_edge);
}

/// A film and its name in messages (its file).
struct FilmPart {
  std::string name;
  Film film;
};

/// The parts do not make one picture. what() is one line: "NAME: found X, expected Y".
struct MergeError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// The film of all samples of all parts, which may come in any order: bit for bit the film that one run would have
/// gathered. The parts must have the same image, region and quantum, and their sample ranges must follow each other
/// without overlap or gap; an empty part (no samples) adds nothing. Emission is kept if all parts that are not empty
/// have it. frames: at least one part; each film without its pixels and emission. read(index): returns the whole film
/// of that part; called once for each, in the order of their samples, with at most two of these films in memory at a
/// time. Throws MergeError.
Film merge(const std::vector<FilmPart>& frames, const std::function<Film(std::size_t index)>& read);

}  // namespace tyndall
