#pragma once
#include "core/base/thread_pool.h"
#include "core/film/film.h"

#include <cstdint>
#include <vector>

/// Adaptive sampling: how many samples the parts of a picture get. Pure functions of the film, so that threads, tiles
/// and pauses change nothing.
///
/// A film starts with warm_up samples of every pixel. Then come rounds, each of which doubles the mean number of
/// samples. In a round each cell of 4 x 4 pixels gets a count that follows from the relative error around it: the
/// counts that make relMSE smallest if squared error falls as 1/count², as it does with Sobol' points where a picture
/// is smooth. (Where it only falls as 1/count, the least error for a given number of samples would need still more in
/// hard cells. But paths in hard cells take longer, so these counts come close to the least error for a given time.)
/// Counts are powers of two, because Sobol' points are spread most evenly then. They are at least a quarter of the
/// mean, so that rare bright paths are looked for everywhere, and at most 16 times the mean. All cells keep the same
/// count as long as uneven counts would gain less than a tenth of relMSE: the longer paths of the hard cells would
/// use it up.
///
/// A mean of samples that also decide how many are taken is biased: for example, a pixel whose first samples missed a
/// small light would get no more and stay dark. So the count of a cell does not depend on its own pixels, but on the
/// 5 x 5 cells around it without itself. Two weak dependences stay: a cell influences its neighbours' counts and, a
/// round later, they influence its own; and all cells share one mean. Measured in the showroom at 64 samples, the mean
/// over the picture is off by -0.6 % if each pixel decides on itself, by -0.12 % if each cell does, and by less than
/// 0.01 % in this way.
namespace tyndall {

inline constexpr int cell_edge = planned_cell_edge;
inline constexpr std::uint32_t warm_up = 16;  ///< samples that every pixel gets before the first round
inline constexpr int window_reach = 2;        ///< cells to each side whose errors decide on a cell
inline constexpr double min_of_mean = 0.25;   ///< least fraction of the mean count that a cell gets
inline constexpr double max_of_mean = 16;     ///< greatest multiple of the mean count that a cell gets
inline constexpr double min_gain = 1.1;       ///< factor by which uneven counts must promise to lower relMSE to be used

/// Starts a round: sets film.planned for a mean of twice the film's samples, made a power of two. All pixels of a cell
/// must have the same count.
void plan_round(Film& film, ThreadPool& thread_pool);

/// The mean number of samples at the end of the planned round; 0 if no round is planned.
std::uint32_t planned_mean(const Film& film);

/// The mean number of samples at which a pass that starts at a mean of `taken` must end at the latest: warm_up, later
/// the end of the round. Plans the next round if the last one is over.
std::uint32_t end_of_round(Film& film, std::uint32_t taken, ThreadPool& thread_pool);

/// Whether a round is planned in which cells get different counts.
bool planned_unevenly(const Film& film);

/// Number of samples that each pixel should have during the planned round, when the mean has become `spp`. Their sum is
/// at most spp times the number of pixels. A higher spp never lowers the count of a pixel.
std::vector<std::uint32_t> counts_at(const Film& film, std::uint32_t spp);

/// The number of samples to label a picture with: that of every pixel; after adaptive rounds the rounded mean.
std::uint32_t labelled_spp(const Film& film);
/// The same for totals that are known already.
std::uint32_t labelled_spp(const Film& film, const FilmTotals& totals);

}  // namespace tyndall
