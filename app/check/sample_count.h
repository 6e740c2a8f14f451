#pragma once
#include "app/check/statistics.h"

#include <vector>

/// How many samples a pixel a picture has, as its noise tells.
namespace tyndall {

/// The numbers of samples a pixel that a picture's noise may stand for if a program with these samples, `count` of each
/// pixel, has made it, the likeliest first; 0: not known. White makes few samples show as little noise as many, so that
/// there may be several. picture: with the picture without noise as what is expected, and the variance of that.
std::vector<double> likely_counts(const ComparedPixels& picture, const std::vector<BookSample>& samples, int count,
                                  const Regions& regions, double white);

}  // namespace tyndall
