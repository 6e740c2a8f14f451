#pragma once
#include "core/film/film.h"

/// Tests whether two ways of rendering agree in the mean.
namespace tyndall {

/// Whether two pictures differ by more than their noise. They are compared block by block, because a bias too small to
/// be seen in one pixel shows in the mean of many. z of a block: the difference between the mean grey values, divided
/// by its standard error, which follows from the halves of both films.
struct BlockScores {
  int blocks = 0;          ///< number of compared blocks; blocks that are equal and without noise are left out
  double mean_square = 0;  ///< of z; about 1 if the pictures differ by noise alone
  double maximum = 0;      ///< largest mean_square that noise explains: 4 standard deviations above its expected value
  double worst = 0;        ///< largest |z|; infinite if a block without noise differs
  bool noise() const { return mean_square <= maximum && worst < 1e300; }
};

/// Both films must have the same region, and samples in both halves of every pixel; otherwise there are no blocks.
/// edge: of a block, in pixels; a multiple of 16 keeps groups whole (film/groups.h).
BlockScores block_scores(const Film& a, const Film& b, int edge = 16);

}  // namespace tyndall
