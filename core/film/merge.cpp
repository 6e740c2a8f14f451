#include "core/film/merge.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tyndall {

namespace {

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
  if (a.width != b.width || a.height != b.height) {
    refuse(part, "an image of " + size_text(b), size_text(a) + like);
  }
  if (a.region != b.region) refuse(part, "the region " + region_text(b.region), region_text(a.region) + like);
  if (a.unit != b.unit) refuse(part, "another brightest light", "the same scene" + like);
}

/// Adds a part whose samples follow those of the film. Compared pixel by pixel, because the samples of an interrupted
/// run end at different indices in different pixels.
void append(Film& film, const FilmPart& part) {
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    const std::uint64_t end = std::uint64_t{film.first_sample} + film.pixels[i].taken;
    const std::uint64_t start = part.film.first_sample;
    if (part.film.pixels[i].taken > 0 && start != end) {
      refuse(part, "samples from " + std::to_string(start),
             "from " + std::to_string(end) + (start < end ? " (they overlap another part)" : " (some are missing)"));
    }
    add_pixel(film.pixels[i], part.film.pixels[i]);
  }
  if (totals(part.film).samples == 0) return;
  if (part.film.emission.empty()) film.emission.clear();
  for (std::size_t i = 0; i < film.emission.size(); ++i) add_emission(film.emission[i], part.film.emission[i]);
  film.cut_throughput.add(part.film.cut_throughput);
}

}  // namespace

Film merge(std::vector<FilmPart> parts) {
  assert(!parts.empty());
  const auto earlier = [](const FilmPart& a, const FilmPart& b) { return a.film.first_sample < b.film.first_sample; };
  for (const FilmPart& part : parts) check_same_picture(parts.front(), part);
  std::stable_sort(parts.begin(), parts.end(), earlier);
  const auto empty = [](const FilmPart& part) { return totals(part.film).most_taken == 0; };
  const auto first = std::find_if_not(parts.begin(), parts.end(), empty);
  if (first == parts.end()) return std::move(parts.front().film);
  Film film = std::move(first->film);
  for (auto part = first + 1; part != parts.end(); ++part) append(film, *part);
  return film;
}

}  // namespace tyndall
