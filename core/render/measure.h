#pragma once
#include "core/accuracy/error.h"
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

/// Most seeds and samples that one measurement takes.
inline constexpr std::uint32_t most_rounds = 16;
inline constexpr double most_samples_measured = 4e9;

/// The mean over a picture's pixels and channels. Pilots find out how many samples its standard error takes; as many
/// others, of another seed, are the measurement: samples that decide when to stop are not unbiased. Takes the scene's
/// seed and those that follow. Gives up at most_samples_measured: look at value.error.
Measured measure_mean(RenderScene scene, const MeasureOptions& options, const ProgressCallback& progress = {});

/// Standard errors below this share of a value drown in the rounding of single precision.
inline constexpr double rounding_share = 1e-6;

/// Deviation from a known answer in standard errors, the share for rounding included; from 0: 0 or infinite if the
/// standard error is 0.
double z_score(const FilmMean& measured, double expected);

struct SquareBand {
  double low = 0, high = 0;
};
/// Where the mean square of `count` z-scores lies if their standard errors are honest: about 1, within 4 standard
/// deviations of its cube root. Too small is as wrong as too large. E. Wilson, M. Hilferty, The Distribution of
/// Chi-Square, Proceedings of the National Academy of Sciences 17 (1931).
SquareBand mean_square_band(int count);

}  // namespace tyndall
