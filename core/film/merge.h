#pragma once
#include "core/film/film.h"

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
/// overlap or hole; an empty part (no samples) adds nothing. Emission is kept if all parts but empty ones have it. At
/// least one part. Throws MergeError.
Film merge(std::vector<FilmPart> parts);

}  // namespace tyndall
