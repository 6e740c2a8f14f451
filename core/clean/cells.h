#pragma once
#include "core/base/lanes.h"
#include "core/clean/filter_view.h"

/// Collects, for each cell of the picture, the columns of numbers by which the regression describes the cell's pixels,
/// and sums the products of each two columns.
namespace tyndall::filter {

/// The sum of two numbers; base/lanes_simd.h has the version for groups of lanes.
TYNDALL_INLINE float pair_sums(float a, float b) { return a + b; }

TYNDALL_INLINE int minimum(int a, int b) { return a < b ? a : b; }
TYNDALL_INLINE int maximum(int a, int b) { return a > b ? a : b; }

/// A row of cells, one for each lane of F: a row of their pixels fills cell_edge groups of lanes.
template <class F>
struct Strip {
  static constexpr int cells = lanes_of<F>, width = cell_edge * cells;
  /// The columns of one group of lanes, row by row; 0 outside of the picture.
  alignas(64) float column[cell_columns][cell_edge * lanes_of<F>];
  /// For each product of two columns: its sums over the rows of each group.
  alignas(64) float part[all_sums][width];
  /// x of the pixels of a row, counted from the middle of each cell, over the width of a block.
  alignas(64) float across[width];
};

/// Adds up each cell_edge neighbours of a row: lane i is the sum of cell i of a strip.
template <class F>
TYNDALL_INLINE F fold(const float* row) {
  constexpr int n = lanes_of<F>;
  const auto pair = [&](int i) {
    return pair_sums(load<F>(row + std::ptrdiff_t{i} * n), load<F>(row + std::ptrdiff_t{i + 1} * n));
  };
  return pair_sums(pair_sums(pair(0), pair(2)), pair_sums(pair(4), pair(6)));
}

/// Copies the first `rows` rows of a group of lanes from a plane, and sets the rows below them to 0.
template <class F>
TYNDALL_INLINE void take_rows(const float* plane, std::ptrdiff_t stride, int rows, float* to) {
  for (int y = 0; y < rows; ++y) store(to + y * lanes_of<F>, load<F>(plane + y * stride));
  for (int y = rows; y < cell_edge; ++y) store(to + y * lanes_of<F>, F(0.0f));
}

/// Column or row of a pixel of a cell, counted from the middle of the cell, over the width of a block.
TYNDALL_INLINE float place_in_cell(int i) { return (static_cast<float>(i) - 0.5f * (cell_edge - 1)) / (2 * cell_edge); }

/// Fills the columns of the group of lanes from x on. rows: number of its rows inside the picture. Where a light is
/// seen, its emission is subtracted from the halves, because the regression would smear it over the pixels around, and
/// added again after the prediction. The emission also remains a term of the regression, because a light that covers a
/// part of a pixel hides that part of the rest.
template <class F>
TYNDALL_INLINE void fill_group(const FilterView& v, int x, int y0, int rows, bool shines, const float* across,
                               Strip<F>& strip) {
  constexpr int n = lanes_of<F>;
  const std::ptrdiff_t at = y0 * v.stride + x;
  alignas(64) float one[n];
  for (int i = 0; i < n; ++i) one[i] = x + i < v.width ? 1.0f : 0.0f;
  for (int y = 0; y < cell_edge; ++y) {
    const F inside = y < rows ? load<F>(one) : F(0.0f);
    store(strip.column[0] + y * n, inside);
    store(strip.column[1] + y * n, inside * load<F>(across));
    store(strip.column[2] + y * n, inside * splat<F>(place_in_cell(y)));
  }
  for (int k = 0; k < seen_features; ++k) take_rows<F>(v.seen[k] + at, v.stride, rows, strip.column[3 + k]);
  for (int k = 0; shines && k < 2 * emission_terms; ++k)
    take_rows<F>(v.emission[k] + at, v.stride, rows, strip.column[emission_column + k]);
  for (int k = 0; k < outputs; ++k) {
    float* column = strip.column[half_column + k];
    take_rows<F>(v.half[k] + at, v.stride, rows, column);
    for (int q = 0; shines && q < cell_edge * n; q += n)
      store(column + q, load<F>(column + q) - load<F>(strip.column[emission_column + k] + q));
  }
}

/// Sums the products of the columns of a group of lanes over its rows.
template <class F>
TYNDALL_INLINE void sum_rows(const FilterView& v, int sums, int group, Strip<F>& strip) {
  constexpr int n = lanes_of<F>;
  F own[cell_edge];
  int held = -1;
  for (int s = 0; s < sums; ++s) {
    if (v.pairs[s].i != held) {
      held = v.pairs[s].i;
      for (int y = 0; y < cell_edge; ++y) own[y] = load<F>(strip.column[held] + std::ptrdiff_t{y} * n);
    }
    const float* other = strip.column[v.pairs[s].j];
    F sum = own[0] * load<F>(other);
    for (int y = 1; y < cell_edge; ++y) sum = mul_add(own[y], load<F>(other + std::ptrdiff_t{y} * n), sum);
    store(strip.part[s] + group * n, sum);
  }
}

/// Finds which cells of a strip have emission, and returns whether any has.
template <class F>
TYNDALL_INLINE bool find_emission(const FilterView& v, int x0, int y0, int rows, std::uint8_t* shines) {
  constexpr int n = lanes_of<F>;
  alignas(64) float bright[Strip<F>::width], cell[n];
  for (int group = 0; group < cell_edge; ++group) {
    F sum = F(0.0f);
    const int x = x0 + group * n;
    for (int k = 0; k < 2 * emission_terms && x < v.width; ++k)
      for (int y = 0; y < rows; ++y) sum = sum + abs(load<F>(v.emission[k] + (y0 + y) * v.stride + x));
    store(bright + group * n, sum);
  }
  store(cell, fold<F>(bright));
  bool any = false;
  for (int i = 0; i < n; ++i) any |= (shines[i] = cell[i] > 0) != 0;
  return any;
}

template <class F>
TYNDALL_INLINE void sum_cells_of(const FilterView& v, int cell_row) {
  constexpr int n = lanes_of<F>;
  const int y0 = cell_row * cell_edge, rows = minimum(cell_edge, v.height - y0);
  float* row = v.sums + std::ptrdiff_t{cell_row + 1} * all_sums * v.cell_stride;
  bool dark = !v.has_emission() || v.dark_rows;
  for (int y = y0; v.has_emission() && dark && y < y0 + rows; ++y) dark = v.dark_rows[y] != 0;
  Strip<F> strip;
  for (int x = 0; x < Strip<F>::width; ++x) strip.across[x] = place_in_cell(x % cell_edge);
  for (int x0 = 0; x0 < v.width; x0 += Strip<F>::width) {
    const std::ptrdiff_t first = x0 / cell_edge + 1;
    std::uint8_t* cell = v.shines + (cell_row + 1) * v.cell_stride + first;
    for (int i = 0; i < Strip<F>::cells; ++i) cell[i] = 0;
    const bool shines = !dark && find_emission<F>(v, x0, y0, rows, cell);
    const int sums = shines ? all_sums : plain_sums;
    for (int group = 0; group < cell_edge; ++group) {
      const int x = x0 + group * n;
      fill_group<F>(v, x, y0, x < v.width ? rows : 0, shines, strip.across + std::ptrdiff_t{group} * n, strip);
      sum_rows<F>(v, sums, group, strip);
    }
    for (int s = 0; s < sums; ++s) store(row + s * v.cell_stride + first, fold<F>(strip.part[s]));
    for (int s = sums; v.has_emission() && s < all_sums; ++s) store(row + s * v.cell_stride + first, F(0.0f));
  }
}

}  // namespace tyndall::filter
