#pragma once
#include "core/film/film.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

/// Merges the films of several machines or runs into one picture.
namespace tyndall {

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
