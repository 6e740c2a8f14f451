#include "core/film/film.h"

#include "core/base/fnv1a.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

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

[[noreturn]] void refuse(const FilmPart& part, const std::string& found, const std::string& expected) {
  throw MergeError(part.name + ": found " + found + ", expected " + expected);
}

std::string size_text(const Film& film) { return std::to_string(film.width) + "x" + std::to_string(film.height); }

std::string region_text(const Region& region) {
  return std::to_string(region.x0) + "," + std::to_string(region.y0) + "," + std::to_string(region.x1) + "," +
         std::to_string(region.y1);
}

void check_same_picture(const FilmPart& first, const FilmPart& part) {
  const Film &a = first.film, &b = part.film;
  const std::string like = " as in " + first.name;
  if (a.width != b.width || a.height != b.height) refuse(part, "an image of " + size_text(b), size_text(a) + like);
  if (a.region != b.region) refuse(part, "the region " + region_text(b.region), region_text(a.region) + like);
  if (a.quantum != b.quantum) refuse(part, "another brightest light", "the same scene" + like);
}

std::string range_text(std::uint64_t from, std::uint64_t to) { return std::to_string(from) + ":" + std::to_string(to); }

/// Refuses a part whose samples should follow those of the part called `before`, which end at `end`, but do not.
[[noreturn]] void refuse_range(const FilmPart& part, std::uint32_t taken, const std::string& before,
                               std::uint64_t end) {
  const std::uint64_t from = part.film.first_sample, to = from + taken;
  const std::string why = from < end ? " (they overlap in " + range_text(from, std::min(to, end)) + ")"
                                     : " (" + range_text(end, from) + " are missing)";
  refuse(part, "samples " + range_text(from, to),
         "them to begin at " + std::to_string(end) + ", where those of " + before + " end" + why);
}

/// Adds a part whose samples follow those of the film. Pixels are compared one by one, because the samples of an
/// interrupted run end at different indices in different pixels. before: name of the part that was added last.
void append(Film& film, const FilmPart& part, const std::string& before) {
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const std::uint64_t end = std::uint64_t{film.first_sample} + film.pixels[i].taken;
    const std::uint32_t taken = part.film.pixels[i].taken;
    if (taken > 0 && part.film.first_sample != end) refuse_range(part, taken, before, end);
    add_pixel(film.pixels[i], part.film.pixels[i]);
  }
  if (part.film.emission.empty()) film.emission.clear();
  for (std::size_t i = 0; i < film.emission.size(); ++i) add_emission(film.emission[i], part.film.emission[i]);
  film.cut_throughput.add(part.film.cut_throughput);
}

/// Reads the whole film of a frame, and checks that it was not replaced since the frame was read.
FilmPart read_part(const FilmPart& frame, Film film) {
  const Film& before = frame.film;
  if (film.first_sample != before.first_sample) refuse(frame, "other samples than a moment ago", "a file that stays");
  FilmPart part{frame.name, std::move(film)};
  check_same_picture(frame, part);
  return part;
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

Film merge(const std::vector<FilmPart>& frames, const std::function<Film(std::size_t)>& read) {
  assert(!frames.empty());
  for (const FilmPart& frame : frames) check_same_picture(frames.front(), frame);
  std::vector<std::size_t> order(frames.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return frames[a].film.first_sample < frames[b].film.first_sample;
  });
  FilmPart sum = read_part(frames[order[0]], read(order[0]));
  bool empty = totals(sum.film).samples == 0;
  for (auto index = order.begin() + 1; index != order.end(); ++index) {
    FilmPart part = read_part(frames[*index], read(*index));
    if (totals(part.film).samples == 0) continue;
    if (empty)
      sum.film = std::move(part.film);
    else
      append(sum.film, part, sum.name);
    empty = false;
    sum.name = part.name;
  }
  return std::move(sum.film);
}

}  // namespace tyndall
