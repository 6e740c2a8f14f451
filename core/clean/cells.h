#pragma once
#include "core/base/lanes.h"
#include "core/clean/filter_view.h"

/// The picture is cut into cells. This file collects the columns of numbers by which the regression describes a cell's
/// pixels, and sums the products of each two columns.
namespace tyndall::filter {

/// The columns of one cell, pixel by pixel; 0 outside of the picture.
struct CellColumns {
  alignas(64) float of[cell_columns][cell_pixels];
  bool shines;
};

TYNDALL_INLINE int least(int a, int b) { return a < b ? a : b; }
TYNDALL_INLINE int most(int a, int b) { return a > b ? a : b; }

/// Copies a cell's pixels from a plane. inside_x, inside_y: how many of its columns and rows lie in the picture; the
/// others become 0.
TYNDALL_INLINE void take_cell(const float* plane, std::ptrdiff_t stride, int inside_x, int inside_y, float* to) {
  for (int y = 0; y < cell_edge; ++y, to += cell_edge) {
    const float* from = plane + (y < inside_y ? y : 0) * stride;
    for (int x = 0; x < cell_edge; ++x) to[x] = x < inside_x && y < inside_y ? from[x] : 0.0f;
  }
}

/// Fills the columns of a cell. halves: also those of the halves, which a fit needs and a prediction does not.
/// Where lamps are seen, their emission is taken off the halves, because the regression would smear it over the pixels
/// around; it is added again to what the regression predicts. It also stays one of the terms, because in a pixel that a
/// lamp covers in part, it hides the rest in part.
TYNDALL_INLINE void fill_columns(const FilterView& v, int cell_x, int cell_y, bool halves, CellColumns& cell) {
  const int x0 = cell_x * cell_edge, y0 = cell_y * cell_edge;
  const int inside_x = least(cell_edge, v.width - x0), inside_y = least(cell_edge, v.height - y0);
  const std::ptrdiff_t at = y0 * v.stride + x0;
  for (int y = 0; y < cell_edge; ++y)
    for (int x = 0; x < cell_edge; ++x) {
      const int pixel = y * cell_edge + x;
      const float one = x < inside_x && y < inside_y ? 1.0f : 0.0f;
      constexpr float middle = 0.5f * (cell_edge - 1), per_block = 1.0f / (2 * cell_edge);
      cell.of[0][pixel] = one;
      cell.of[1][pixel] = one * (static_cast<float>(x) - middle) * per_block;
      cell.of[2][pixel] = one * (static_cast<float>(y) - middle) * per_block;
    }
  for (int k = 0; k < seen_features; ++k) take_cell(v.seen[k] + at, v.stride, inside_x, inside_y, cell.of[3 + k]);
  cell.shines = v.has_emission() && (halves || v.shines[(cell_y + 1) * v.cell_stride + cell_x + 1]);
  if (cell.shines)
    for (int k = 0; k < 2 * emission_terms; ++k)
      take_cell(v.emission[k] + at, v.stride, inside_x, inside_y, cell.of[emission_column + k]);
  if (!halves) return;
  for (int k = 0; k < outputs; ++k) {
    float* column = cell.of[half_column + k];
    take_cell(v.half[k] + at, v.stride, inside_x, inside_y, column);
    for (int q = 0; cell.shines && q < cell_pixels; ++q) column[q] -= cell.of[emission_column + k][q];
  }
}

TYNDALL_INLINE bool any_emission(const CellColumns& cell) {
  float sum = 0;
  for (int k = 0; k < 2 * emission_terms; ++k)
    for (int q = 0; q < cell_pixels; ++q) sum += abs(cell.of[emission_column + k][q]);
  return sum > 0;
}

/// The sum of the products of two columns.
template <class F>
TYNDALL_INLINE float column_product(const float* a, const float* b) {
  F sum = load<F>(a) * load<F>(b);
  for (int q = lanes_of<F>; q < cell_pixels; q += lanes_of<F>) sum = mul_add(load<F>(a + q), load<F>(b + q), sum);
  alignas(64) float lane[lanes_of<F>];
  store(lane, sum);
  for (int step = lanes_of<F> / 2; step > 0; step /= 2)
    for (int i = 0; i < step; ++i) lane[i] += lane[i + step];
  return lane[0];
}

template <class F>
TYNDALL_INLINE void sum_cells_of(const FilterView& v, int cell_row) {
  const int cells = (v.width + cell_edge - 1) / cell_edge;
  float* row = v.sums + std::ptrdiff_t{cell_row + 1} * all_sums * v.cell_stride;
  CellColumns cell;
  for (int cx = 0; cx < cells; ++cx) {
    fill_columns(v, cx, cell_row, true, cell);
    const bool shines = cell.shines && any_emission(cell);
    v.shines[(cell_row + 1) * v.cell_stride + cx + 1] = shines;
    const int count = shines ? all_sums : plain_sums;
    for (int s = 0; s < count; ++s)
      row[s * v.cell_stride + cx + 1] = column_product<F>(cell.of[v.pairs[s].i], cell.of[v.pairs[s].j]);
    if (v.has_emission())
      for (int s = count; s < all_sums; ++s) row[s * v.cell_stride + cx + 1] = 0;
  }
}

}  // namespace tyndall::filter
