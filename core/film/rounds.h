#pragma once
#include "core/film/film.h"

/// How a film stores the rounds of adaptive sampling (see core/render/plan.h).
namespace tyndall {

/// Edge, in pixels, of the cells that have an entry in Film::planned. They are cut from the upper left corner of the
/// film's region, row by row; cells at the right and lower edge may be smaller.
inline constexpr int planned_cell_edge = 4;

/// Number of cells of a region: in a row, and in all.
inline std::size_t planned_columns(const Region& region) {
  return static_cast<std::size_t>((region.width() + planned_cell_edge - 1) / planned_cell_edge);
}
inline std::size_t planned_cells(const Region& region) {
  return planned_columns(region) *
         static_cast<std::size_t>((region.height() + planned_cell_edge - 1) / planned_cell_edge);
}

}  // namespace tyndall
