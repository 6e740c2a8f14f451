#pragma once
#include "core/film/film.h"

namespace tyndall {

/// Whether two pictures differ by more than their noise, block by block: a bias too small for any pixel shows in the
/// mean of many. z of a block is the difference of its mean grey values over the standard error that both films' halves
/// tell.
struct BlockScores {
  int blocks = 0;          ///< with any noise
  double mean_square = 0;  ///< of z; about 1 if the difference is noise
  double most = 0;         ///< mean square up to which it may be noise: 4 standard deviations
  double worst = 0;        ///< largest |z|; infinite if a block without noise differs
  bool noise() const { return mean_square <= most && worst < 1e300; }
};

/// Both films of the same region, with samples in both halves of every pixel; `edge`: of a block in pixels. No blocks
/// where that does not hold.
BlockScores block_scores(const Film& a, const Film& b, int edge = 8);

}  // namespace tyndall
