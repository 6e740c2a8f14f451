#pragma once
#include "core/film/film.h"

#include <vector>

/// Merging of films that are in memory.
namespace tyndall::test {

inline Film merged(const std::vector<FilmPart>& parts) {
  std::vector<FilmPart> frames = parts;
  for (FilmPart& frame : frames) frame.film.pixels.clear(), frame.film.emission.clear();
  return merge(frames, [&](std::size_t index) { return parts[index].film; });
}

}  // namespace tyndall::test
