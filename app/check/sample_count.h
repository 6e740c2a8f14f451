#pragma once
#include "app/check/reading.h"
#include "app/check/statistics.h"

#include <vector>

/// How many samples a pixel a picture has, as its noise tells.
namespace tyndall {

struct PictureNoise {
  std::vector<double> variance;  ///< of a pixel, of each region and channel; negative: there are too few pixels
  double black = 0;              ///< fraction of the numbers that are black
};

/// From neighbours in a row, so that what changes slowly from pixel to pixel counts little; what is brighter than white
/// counts nothing. reference, its variance: of the picture without noise, 3 floats a pixel.
PictureNoise noise_of(const ReadPixels& picture, const std::vector<float>& reference,
                      const std::vector<float>& reference_variance, const Regions& regions, double white);

/// The numbers of samples a pixel that a picture's noise may stand for if a program with these samples, `count` of each
/// pixel, has made it, the likeliest first; 0: not known. White makes few samples show as little noise as many, so that
/// there may be several.
std::vector<double> likely_counts(const PictureNoise& noise, const std::vector<BookSample>& samples, int count,
                                  const Regions& regions, double white);

}  // namespace tyndall
