#pragma once
#include "core/accuracy/error.h"
#include "core/render/render.h"

#include <cstdint>
#include <limits>

/// Measures the mean of a picture to a wanted standard error, to compare it with a known answer.
namespace tyndall {

struct MeasureOptions {
  int threads = 0;   ///< 0: see thread_count()
  std::string isa;   ///< "": the best
  double error = 0;  ///< standard error to reach, >= 0
  double expected =
      std::numeric_limits<double>::quiet_NaN();  ///< the known answer, if any: ends early if clearly missed
};

struct Measured {
  FilmMean value;
  FilmTotals totals;  ///< of the samples of `value`
  double seconds = 0;
  bool interrupted = false;  ///< the callback stopped the measurement: the other members mean nothing
};

/// Limits of one measurement: its rounds, each with a seed of its own, and the samples of each round.
inline constexpr std::uint32_t max_rounds = 16;
inline constexpr double max_samples_measured = 4e9;

/// Measures the mean over a picture's pixels and channels. Short renders (pilots) determine how many samples the wanted
/// standard error takes. Then as many samples with another seed are the measurement, because a mean of samples that
/// also decide when to stop is biased. Uses the scene's seed and the seeds after it. Stops at max_samples_measured even
/// if the error is larger than wanted: check value.error.
Measured measure_mean(Scene scene, const MeasureOptions& options, const ProgressCallback& progress = {});

/// Standard errors below this fraction of a value mean nothing, because the rounding of single precision is larger.
inline constexpr double rounding_fraction = 1e-6;

/// Distance of a mean from a known answer in standard errors; rounding_fraction of the answer counts as error, too. If
/// the answer is 0 without a standard error: 0 for a mean of 0, else infinite.
double z_score(const FilmMean& measured, double expected);

struct SquareBand {
  double low = 0, high = 0;
};
/// The range in which the mean square of `count` z-scores lies if their standard errors are right: around 1, within 4
/// standard deviations of its cube root. A value below the range is as wrong as one above. E. Wilson, M. Hilferty, The
/// Distribution of Chi-Square, Proceedings of the National Academy of Sciences 17 (1931).
SquareBand mean_square_band(int count);

}  // namespace tyndall
