#pragma once
#include "core/film/film.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

/// Puts together what several machines or runs have rendered of one picture.
namespace tyndall {

/// A film and the name that messages call it by (its file).
struct FilmPart {
  std::string name;
  Film film;
};

/// The parts do not make one picture. what() is one line: "NAME: found X, expected Y".
struct MergeError : std::runtime_error {
  using runtime_error::runtime_error;
};

/// The film of all samples of all parts, which may come in any order: bit for bit the film that one run would have
/// gathered. They must have the same image, region and unit, and the sample ranges must follow each other without
/// overlap or hole; an empty part (no samples) adds nothing. Emission is kept if all parts but empty ones have it.
/// frames: at least one part; of each film all but pixels and emission. read: gives the whole film of the part with
/// that index in `frames`; it is called once for each, in the order of their samples, and no more than two of these
/// films are in memory at a time. Throws MergeError.
Film merge(const std::vector<FilmPart>& frames, const std::function<Film(std::size_t index)>& read);

}  // namespace tyndall
