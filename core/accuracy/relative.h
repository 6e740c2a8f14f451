#pragma once
#include <vector>

/// What the estimated and the true relative error share.
namespace tyndall {

inline constexpr double floor_of_square = 0.01;  ///< added to squared levels: keeps black pixels from dominating

/// For each pixel the root of the mean of these squares over the 7 x 7 pixels around it. Squares that are infinite are
/// left out; the result is infinite where all are.
std::vector<float> root_window_means(const std::vector<double>& squares, int width, int height);

}  // namespace tyndall
