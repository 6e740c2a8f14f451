#pragma once
#include "core/base/vec.h"

#include <cstddef>
#include <functional>
#include <vector>

/// Sums of pixels' squared errors.
namespace tyndall {

/// The squared error of one pixel, given by its index in the film.
struct PixelError {
  std::size_t pixel = 0;
  double error = 0;
};

/// A sum of squared errors and of their squares, in which the largest errors are kept apart, so that they can later be
/// replaced by better ones. The others keep their precision even if the largest exceed them by many magnitudes. The
/// same numbers added in the same order give the same bits. A NaN makes the sum a NaN and is never among the largest.
class ErrorSum {
 public:
  static constexpr std::size_t max_apart = 32;

  void add(PixelError one) {
    if (one.error > min_)
      set_apart(one);
    else  // also what is not a number, which has no place in an order
      sum_ += one.error, squares_ += one.error * one.error;
  }
  void add(const ErrorSum& other);
  double sum() const;
  double squares() const;

  /// The largest errors, at most max_apart, the largest first.
  std::vector<PixelError> largest() const;
  /// Replaces errors that largest() has returned.
  void replace(const std::vector<PixelError>& better);

 private:
  void set_apart(PixelError one);
  void trim();

  double sum_ = 0, squares_ = 0;   ///< of those that are not apart
  double min_ = 0;                 ///< no error up to this can be among the largest
  std::vector<PixelError> apart_;  ///< up to 2 · max_apart, among them the largest
};

/// Returns the levels (mean radiances) of some pixels, given by their indices in the film, from samples that are not
/// the film's; empty if levels are not available now. The function chooses the number of samples.
using LevelsOf = std::function<std::vector<Vec3f>(const std::vector<std::size_t>& pixels)>;

/// Replaces the errors of the pixels that decide a sum over `pixels` pixels by error_at(pixel, level), with levels from
/// levels_of. Reason: errors are relative to levels, which a film alone cannot tell of bright pixels, because a light
/// smaller than a pixel looks like a rare path.
///
/// A pixel decides if its error is at least 1 % of the sum and 16 times the mean. As the sum shrinks, further pixels
/// may come to decide: the function repeats until no new pixel does, or max_apart pixels are known.
void ask_levels(const LevelsOf& levels_of, std::size_t pixels,
                const std::function<double(std::size_t pixel, Vec3f level)>& error_at, ErrorSum& sum);

}  // namespace tyndall
