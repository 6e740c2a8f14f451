#pragma once
#include "core/film/error.h"
#include "core/render/render.h"

#include <cstdint>
#include <limits>

/// A number out of a picture, as accurate as asked for.
namespace tyndall {

struct MeasureOptions {
  int threads = 0;                                             ///< 0: all cores
  std::string isa;                                             ///< "": the best
  double error = 0;                                            ///< standard error to reach, >= 0
  double expected = std::numeric_limits<double>::quiet_NaN();  ///< what is far off from this needs no small error
};

struct Measured {
  FilmMean value;
  FilmTotals totals;  ///< of the samples behind the value alone
  double seconds = 0;
  bool interrupted = false;  ///< the callback said stop: the rest means nothing
};

/// The mean over the picture's pixels and channels. Pilots find out how many samples its standard error takes; then as
/// many others, of another seed, are the measurement: samples that decide when to stop would not be unbiased. Seeds
/// used: the scene's and the following, at most `most_rounds` in all. Gives up at most_samples_measured: look at
/// value.error.
inline constexpr std::uint32_t most_rounds = 16;
inline constexpr double most_samples_measured = 4e9;
Measured measure_mean(RenderScene scene, const MeasureOptions& options, const ProgressCallback& progress = {});

/// Measurements against known answers. Standard errors below this share of what is expected drown in the rounding of
/// single precision.
inline constexpr double rounding_share = 1e-6;

/// Deviation from what is expected in standard errors, the share for rounding included; of 0: 0 or infinite.
double z_score(const FilmMean& measured, double expected);

/// z-scores of honest standard errors have mean square 1. Says whether that of `count` of them is within 4 of its own
/// standard errors: what is too good is an error too. E. Wilson, M. Hilferty, The Distribution of Chi-Square,
/// Proceedings of the National Academy of Sciences 17 (1931).
struct SquareBand {
  double low = 0, high = 0;
};
SquareBand mean_square_band(int count);

}  // namespace tyndall
