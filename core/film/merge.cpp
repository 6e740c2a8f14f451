#include "core/film/merge.h"

#include <algorithm>
#include <cassert>
#include <numeric>
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
