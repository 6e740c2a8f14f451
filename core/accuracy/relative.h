#pragma once
#include <vector>

/// Formulas that the estimated and the true relative error have in common.
namespace tyndall {

inline constexpr double floor_of_square = 0.01;  ///< added to squared levels: keeps black pixels from dominating

/// For each pixel the root of the mean of these squares over the 7 x 7 pixels around it. Infinite squares are left out;
/// the result is infinite where all are infinite.
std::vector<float> root_window_means(const std::vector<double>& squares, int width, int height);

}  // namespace tyndall
