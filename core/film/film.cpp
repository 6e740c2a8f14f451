#include "core/film/film.h"

#include "core/base/fnv1a.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace tyndall {
namespace {

/// The means of three channels, from their sums.
Vec3f means_of(const ExactSum (&sums)[3], double quantum, std::uint64_t count) {
  if (count == 0) return {};
  const auto of = [&](const ExactSum& sum) {
    return static_cast<float>(sum.value() * quantum / static_cast<double>(count));
  };
  return {of(sums[0]), of(sums[1]), of(sums[2])};
}

/// Hashes 4 bytes, lowest first.
std::uint64_t hash_of(std::uint32_t word, std::uint64_t before) {
  char bytes[4];
  for (int k = 0; k < 4; ++k) bytes[k] = static_cast<char>(word >> 8 * k & 0xffu);
  return fnv1a({bytes, 4}, before);
}

}  // namespace

Film make_film(int width, int height, Region region, std::uint32_t first_sample, double quantum, bool emission) {
  assert(0 <= region.x0 && region.x0 < region.x1 && region.x1 <= width);
  assert(0 <= region.y0 && region.y0 < region.y1 && region.y1 <= height);
  assert(quantum > 0);
  Film film;
  film.width = width, film.height = height, film.region = region;
  film.first_sample = first_sample, film.quantum = quantum;
  film.pixels.resize(static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height()));
  if (emission) film.emission.resize(film.pixels.size());
  return film;
}

double film_quantum(double brightest) {
  assert(brightest >= 0 && std::isfinite(brightest));
  if (brightest == 0) return 1;
  int exponent = 0;
  const double fraction = std::frexp(brightest, &exponent);  // in [1/2, 1)
  if (fraction == 0.5) --exponent;
  return std::ldexp(1.0, std::max(exponent, -126));  // 1 / quantum stays finite
}

Vec3f mean(const Film& film, const FilmPixel& pixel) {
  ExactSum both[3] = {pixel.sum[0][0], pixel.sum[0][1], pixel.sum[0][2]};
  for (std::size_t channel = 0; channel < 3; ++channel) both[channel].add(pixel.sum[1][channel]);
  return means_of(both, film.quantum, std::uint64_t{counted(film, pixel, 0)} + counted(film, pixel, 1));
}

Vec3f half_mean(const Film& film, const FilmPixel& pixel, int half) {
  return means_of(pixel.sum[half], film.quantum, counted(film, pixel, half));
}

Vec3f half_emission(const Film& film, std::size_t pixel, int half) {
  const std::uint32_t count = counted(film, film.pixels[pixel], half);
  if (count == 0 || film.emission.empty()) return {};
  const double per = film.quantum * 0x1p-29 / count;
  const std::int64_t* sum = film.emission[pixel].sum[half];
  return {static_cast<float>(static_cast<double>(sum[0]) * per), static_cast<float>(static_cast<double>(sum[1]) * per),
          static_cast<float>(static_cast<double>(sum[2]) * per)};
}

void add_pixel(FilmPixel& to, const FilmPixel& from) {
  for (int half = 0; half < 2; ++half) {
    for (int channel = 0; channel < 3; ++channel) to.sum[half][channel].add(from.sum[half][channel]);
    to.rejected[half] += from.rejected[half];
  }
  to.taken += from.taken;
  to.truncated += from.truncated;
}

void add_emission(EmissionSums& to, const EmissionSums& from) {
  for (int half = 0; half < 2; ++half)
    for (int channel = 0; channel < 3; ++channel) to.sum[half][channel] += from.sum[half][channel];
}

std::vector<float> resolve(const Film& film) {
  std::vector<float> rgb;
  rgb.reserve(film.pixels.size() * 3);
  for (const FilmPixel& pixel : film.pixels) {
    const Vec3f value = mean(film, pixel);
    rgb.insert(rgb.end(), {value.x, value.y, value.z});
  }
  return rgb;
}

std::uint64_t image_hash(int width, int height, const std::vector<float>& rgb) {
  std::uint64_t hash = fnv1a("");
  hash = hash_of(static_cast<std::uint32_t>(width), hash);
  hash = hash_of(static_cast<std::uint32_t>(height), hash);
  for (const float value : rgb) hash = hash_of(value == 0 ? 0u : std::bit_cast<std::uint32_t>(value), hash);
  return hash;
}

FilmTotals totals(const Film& film) {
  FilmTotals sum;
  if (film.pixels.empty()) return sum;
  sum.min_taken = film.pixels[0].taken;
  for (const FilmPixel& pixel : film.pixels) {
    sum.samples += pixel.taken;
    sum.rejected += std::uint64_t{pixel.rejected[0]} + pixel.rejected[1];
    sum.truncated += pixel.truncated;
    sum.min_taken = std::min(sum.min_taken, pixel.taken);
    sum.max_taken = std::max(sum.max_taken, pixel.taken);
  }
  if (sum.samples > 0) sum.cut_throughput = film.cut_throughput.value() / static_cast<double>(sum.samples);
  return sum;
}

std::uint64_t film_checksum(const Film& film, std::string_view text) {
  Checksum sum;
  const Region& r = film.region;
  for (const int number : {film.width, film.height, r.x0, r.y0, r.x1, r.y1}) sum.add_number(number);
  sum.add_number(film.first_sample);
  sum.add_number(std::bit_cast<std::uint64_t>(film.quantum));
  sum.add_number(film.cut_throughput.high);
  sum.add_number(film.cut_throughput.low);
  sum.add_number(film.emission.size());
  sum.add_number(film.planned.size());
  sum.add_number(text.size());
  sum.add(film.pixels.data(), film.pixels.size() * sizeof(FilmPixel));
  sum.add(film.emission.data(), film.emission.size() * sizeof(EmissionSums));
  sum.add(film.planned.data(), film.planned.size() * sizeof(PlannedSamples));
  sum.add(text.data(), text.size());
  return sum.value();
}

}  // namespace tyndall
