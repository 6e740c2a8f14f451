#pragma once
#include "core/base/error_sum.h"
#include "core/base/thread_pool.h"
#include "core/film/film.h"

#include <cstdint>
#include <limits>
#include <vector>

/// The likely error of a film against the truth, estimated from its two halves A and B alone.
///
/// The squared relative error of a pixel's channel is n / (g² + 0.01), where n = ((A-B)/2)² estimates the variance of
/// the mean m = (A+B)/2 without bias, and g stands for the true level. It must not be m itself: a pixel that a rare
/// bright path has met has a large m and a large n, so that n / m² is at most 1 and hides how wrong the pixel is.
/// g is the pixel's level freed of its own noise: it is drawn towards the mean of the pixels around it, the more, the
/// more of the differences between them is noise.
///
///     g = max(mu + w (m - mu), min(A, B)),  w = max(s / (s + max(n, nu)), clip(1 - 4 n / m², 0, 1))
///
/// mu, nu: the means of m and n over the 5 x 5 pixels around, without the pixel itself and without those that have an
/// empty half; s = max(0, mean of A B - mu²): how much the true levels around differ, as A B estimates the square of a
/// level without bias. The first part of w is Wiener's weight of a level of variance s that is seen with a noise of n
/// (or nu, if that is more: n itself comes from two numbers). The second, and min(A, B), keep a pixel that both halves
/// show to differ from those around it, such as a small light. Without any pixel around, g = m.
///
/// Two cases remain: a light smaller than a pixel that only one half has met looks like a rare path, and a rare path
/// beside a light looks like that light. If the scene is at hand, extra samples can give the levels of the few pixels
/// that decide the estimate: see ask_levels().
namespace tyndall {

struct ErrorEstimate {
  /// sqrt(mean over pixels and channels of n / (g² + 0.01)). Its square estimates relMSE. Infinite while a half of any
  /// pixel is empty.
  double relative_error = std::numeric_limits<double>::infinity();
  /// Whether a few pixels make up so much of the error that it means little: these have met rare bright paths, and
  /// others not yet; or they hold lights smaller than a pixel. True where the standard deviation of the mean of the
  /// pixels' squared errors is more than 0.35 of it, which in large pictures means that it rests on about 8 pixels.
  /// Already above 0.22 (about 20 pixels) if the error also depends much on the levels: if its square would be below
  /// 0.36 of its value with the pixels' own means for g. Also true for a black film of a scene with lights: no light
  /// was found yet. False while a half of any pixel is empty.
  bool rests_on_few_pixels = false;
};

/// thread_pool: does the work; null: the caller's thread does. The result is the same for any number of threads.
/// levels_of: see ask_levels(); called on the calling thread; empty: g is computed from the film alone. rare: ascending
/// indices of pixels that are known, without looking at the film, to hold light which few of their samples meet. Their
/// halves often agree by chance, so their levels are looked up as well, and (m - level)² stands for n in
/// relative_error; whether a few pixels matter is judged with both. These pixels must not be chosen by the film's
/// content: pixels with a large error would be chosen more often.
ErrorEstimate estimate_error(const Film& film, ThreadPool* thread_pool = nullptr, const LevelsOf& levels_of = {},
                             const std::vector<std::size_t>& rare = {});

/// The mean over the channels of n / (g² + 0.01) of each pixel of the region, row by row; infinite where a half is
/// empty.
std::vector<double> squared_relative_errors(const Film& film, ThreadPool* thread_pool = nullptr);

/// The estimated relative error of each pixel of the region, from the 7 x 7 pixels around it. Pixels with an empty half
/// are left out; the result is infinite where all have one.
std::vector<float> pixel_relative_error(const Film& film, ThreadPool* thread_pool = nullptr);

inline constexpr std::uint32_t min_rare_spp = 2;

/// Whether a picture is not converged, whatever its estimated error: few pixels, or none yet, have met light that only
/// rare paths carry. estimate: of the film; spp: samples that every pixel has; chance: see
/// PreparedScene::caustic_chance. False below min_rare_spp, when there is no estimate.
bool has_rare_bright_paths(const ErrorEstimate& estimate, std::uint32_t spp, double chance);

/// The warning for users in that case.
inline constexpr const char* rare_bright_paths = "not converged: rare bright paths";

}  // namespace tyndall
