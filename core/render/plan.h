#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"

#include <cstdint>
#include <vector>

/// Adaptive sampling: how many samples the parts of a picture get. Pure functions of the film, so that threads, tiles
/// and pauses change nothing.
///
/// A film starts with warm_up samples of every pixel. Then come rounds that double the mean. A round gives cells of
/// 4 x 4 pixels more samples the larger the relative error around them is: so many that relMSE gets least if error
/// falls as 1/count², as with Sobol' points where a picture is smooth. Where it falls as 1/count that is less for hard
/// cells than a number of samples would want, but not less than a time would: their paths take longer. Counts are
/// powers of two, where Sobol' points are most even; at least a quarter of the mean, so that rare bright paths are
/// looked for everywhere, and at most 16 times the mean. They stay even as long as less than a tenth of the error is to
/// be gained: the hard cells' time would eat that up.
///
/// Samples that say when to stop are not unbiased: a pixel that missed the light would be left dark. So a cell's own
/// pixels have no say in its count; it follows from the 5 x 5 cells around it less itself. What is left is that a cell
/// has a say in the counts of its neighbours, and they in its own a round later, and that all share one mean. Measured
/// in the showroom at 64 samples, the mean over the picture is off by -0.6 % if pixels decide on themselves, by -0.12 %
/// if cells do, and by less than 0.01 % so.
namespace tyndall {

inline constexpr int cell_edge = 4;            ///< pixels
inline constexpr std::uint32_t warm_up = 16;   ///< samples that every pixel gets before the first round
inline constexpr int window_reach = 2;         ///< cells to each side that decide on a cell
inline constexpr double least_of_mean = 0.25;  ///< of the mean count, what a cell gets at least
inline constexpr double most_of_mean = 16;     ///< and at most
inline constexpr double least_gain = 1.1;      ///< of error, for counts to become uneven

/// Begins a round: film.planned for a mean of twice what the film has (made a power of two). Every pixel of a cell must
/// have the same count. crew: shares the work, null: the caller's thread does it; the answer is the same.
void plan_round(Film& film, Crew* crew = nullptr);

/// The mean at the end of the planned round; 0 if there is none.
std::uint32_t planned_mean(const Film& film);

/// Where the pass after a mean of `taken` samples has to end at the latest: at warm_up, then where the round ends,
/// which is planned if it is due.
std::uint32_t end_of_round(Film& film, std::uint32_t taken, Crew* crew = nullptr);

/// Whether the planned round, if there is one, treats some cells otherwise than others.
bool planned_unevenly(const Film& film);

/// Samples that each pixel is to have, on the way through the planned round, at a mean of `spp`: as many as fit into
/// spp times the pixels. Never fewer for a higher spp.
std::vector<std::uint32_t> counts_at(const Film& film, std::uint32_t spp);

/// What a picture is labelled with: the samples that every pixel has; after rounds their mean, to the nearest number.
std::uint32_t labelled_spp(const Film& film);
/// The same where the film's totals are known already.
std::uint32_t labelled_spp(const Film& film, const FilmTotals& totals);

}  // namespace tyndall
