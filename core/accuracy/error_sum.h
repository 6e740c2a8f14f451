#pragma once
#include <cstddef>
#include <vector>

/// Sums of pixels' squared errors.
namespace tyndall {

/// The squared error of the pixel with that place in a film.
struct PixelError {
  std::size_t pixel = 0;
  double error = 0;
};

/// A sum of squared errors, and of their squares, which holds the largest errors apart. So these can be replaced by
/// better ones later, even if they are so large that the others would be lost in the rounding of one sum. The same
/// numbers added in the same order give the same bits.
class ErrorSum {
 public:
  static constexpr std::size_t most_apart = 32;

  void add(PixelError one);
  void add(const ErrorSum& other);
  double sum() const;
  double squares() const;

  /// The largest errors, at most most_apart, the largest first.
  std::vector<PixelError> largest() const;
  /// Replaces errors that largest() has returned.
  void replace(const std::vector<PixelError>& better);

 private:
  void trim();

  double sum_ = 0, squares_ = 0;   ///< of those that are not apart
  double least_ = 0;               ///< no error up to this can be among the largest
  std::vector<PixelError> apart_;  ///< up to 2 · most_apart, among them the largest
};

}  // namespace tyndall
