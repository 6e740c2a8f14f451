#pragma once
#include "core/film/film.h"

/// How a film keeps the rounds of adaptive sampling (see core/render/plan.h).
namespace tyndall {

/// Edge in pixels of the cells that Film::planned has an entry for. They are cut from the upper left corner of the
/// film's region, row by row; those at the right and lower edge may be smaller.
inline constexpr int planned_cell_edge = 4;

/// How many cells a region has side by side, and in all.
inline std::size_t planned_columns(const Region& region) {
  return static_cast<std::size_t>((region.width() + planned_cell_edge - 1) / planned_cell_edge);
}
inline std::size_t planned_cells(const Region& region) {
  return planned_columns(region) *
         static_cast<std::size_t>((region.height() + planned_cell_edge - 1) / planned_cell_edge);
}

}  // namespace tyndall
