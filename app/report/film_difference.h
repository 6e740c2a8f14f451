#pragma once
#include "core/film/film.h"

#include <limits>

/// How far two pictures of one sweep are apart, and how much of that is noise.
namespace tyndall {

/// Each with an error found from the two halves of the difference itself. Pictures of one seed have most of their noise
/// in common: the errors of both pictures taken together would be several times too large.
struct FilmDifference {
  double mean = 0;                                              ///< of the pixels and channels of film - reference
  double mean_error = std::numeric_limits<double>::infinity();  ///< standard error of `mean`
  double rms = 0;  ///< root mean square over pixels and channels, freed of noise
  double rms_error = std::numeric_limits<double>::infinity();  ///< root mean square error of a pixel's difference
};

/// Both films have one region. The errors are infinite while a half of a pixel is empty.
///
/// With the halves a and b of the difference d, ((a - b) / 2)² estimates the variance of d and a b its true square,
/// both without bias.
FilmDifference film_difference(const Film& film, const Film& reference);

}  // namespace tyndall
