#pragma once
#include "core/film/film.h"

#include <cstddef>
#include <vector>

/// Groups of pixels whose samples are computed together in scenes that reuse second vertices (reuse/reuse.h). Their
/// noise is correlated, so standard errors of means over pixels are computed from the sums over groups.
namespace tyndall {

/// The pixels of a group lie group_spacing apart, because correlated noise of adjacent pixels would look like
/// splotches. The groups of a block are interleaved and fill the block. Blocks start at the picture's upper left
/// corner.
inline constexpr int group_columns = 4, group_rows = 2, group_size = group_columns * group_rows, group_spacing = 4;
inline constexpr int block_width = group_columns * group_spacing, block_height = group_rows * group_spacing;

/// For each group that has pixels in the region, the sum of value(pixel) over these pixels; perhaps also zeros for a
/// few groups that have none. region: within that of the film.
std::vector<double> group_sums(const Film& film, const Region& region, auto value) {
  const int first_column = region.x0 / block_width, first_row = region.y0 / block_height;
  const int columns = (region.x1 - 1) / block_width - first_column + 1;
  const int rows = (region.y1 - 1) / block_height - first_row + 1;
  constexpr std::size_t spacing = group_spacing, groups = spacing * spacing;  // in a block
  std::vector<double> sums(groups * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const auto row = static_cast<std::size_t>(y / block_height - first_row);
      const std::size_t block =
          row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / block_width - first_column);
      const std::size_t group = static_cast<std::size_t>(y) % spacing * spacing + static_cast<std::size_t>(x) % spacing;
      sums[groups * block + group] += value(film.at(x, y));
    }
  return sums;
}

}  // namespace tyndall
