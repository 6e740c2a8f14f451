#pragma once
#include "core/clean/regression.h"

/// Applies the regression: each pixel becomes the mean of the predictions of the four blocks around it, weighted
/// bilinearly.
namespace tyndall::filter {

/// Input of a prediction for one cell, pixel by pixel: the terms, and the emission of both halves.
struct CellTerms {
  alignas(64) float of[emission_column + 2 * emission_terms][cell_pixels];
  int rows;     ///< how many of its rows lie in the picture; those below repeat the last one
  bool shines;  ///< whether it has emission
};

/// Copies a row of a cell.
TYNDALL_INLINE void copy_row(const float* from, float* to) { __builtin_memcpy(to, from, cell_edge * sizeof(float)); }

/// Copies a cell's pixels from a plane. Pixels to the right of the picture get arbitrary values and are not used.
TYNDALL_INLINE void take_cell(const float* plane, std::ptrdiff_t stride, int rows, float* to) {
  for (int y = 0; y < cell_edge; ++y)
    copy_row(plane + minimum(y, rows - 1) * stride, to + std::ptrdiff_t{y} * cell_edge);
}

/// Fills the terms that are the same in each cell.
TYNDALL_INLINE void fill_places(CellTerms& cell) {
  for (int pixel = 0; pixel < cell_pixels; ++pixel) {
    cell.of[0][pixel] = 1;
    cell.of[1][pixel] = place_in_cell(pixel % cell_edge), cell.of[2][pixel] = place_in_cell(pixel / cell_edge);
  }
}

/// Fills the others.
TYNDALL_INLINE void fill_terms(const FilterView& v, int cell_x, int cell_y, CellTerms& cell) {
  const std::ptrdiff_t at = std::ptrdiff_t{cell_y} * cell_edge * v.stride + std::ptrdiff_t{cell_x} * cell_edge;
  cell.rows = minimum(cell_edge, v.height - cell_y * cell_edge);
  for (int k = 0; k < seen_features; ++k) take_cell(v.seen[k] + at, v.stride, cell.rows, cell.of[3 + k]);
  cell.shines = v.shines[(cell_y + 1) * v.cell_stride + cell_x + 1] != 0;
  for (int k = 0; cell.shines && k < 2 * emission_terms; ++k)
    take_cell(v.emission[k] + at, v.stride, cell.rows, cell.of[emission_column + k]);
}

/// The coefficients of the four blocks that a cell belongs to, for places counted from the middle of the cell.
struct CellBlocks {
  float of[4][outputs][terms];
};

TYNDALL_INLINE void take_blocks(const FilterView& v, int cell_x, int cell_row, CellBlocks& blocks) {
  const std::ptrdiff_t row = std::ptrdiff_t{outputs} * terms * v.cell_stride;
  for (int k = 0; k < 4; ++k) {
    const float* from = v.coefficients + (cell_row + k / 2) * row + cell_x + k % 2;
    const float x = k % 2 ? -0.25f : 0.25f, y = k < 2 ? 0.25f : -0.25f;
    for (int output = 0; output < outputs; ++output) {
      float* to = blocks.of[k][output];
      for (int i = 0; i < terms; ++i) to[i] = from[(output * terms + i) * v.cell_stride];
      to[0] += x * to[1] + y * to[2];
    }
  }
}

/// Fills in the bilinear weights with which each pixel of a cell mixes the predictions of its four blocks.
TYNDALL_INLINE void fill_tents(float (*tent)[cell_pixels]) {
  for (int y = 0; y < cell_edge; ++y)
    for (int x = 0; x < cell_edge; ++x) {
      const float right = static_cast<float>(x + 1) / (cell_edge + 1),
                  low = static_cast<float>(y + 1) / (cell_edge + 1);
      const int pixel = y * cell_edge + x;
      tent[0][pixel] = (1 - right) * (1 - low), tent[1][pixel] = right * (1 - low);
      tent[2][pixel] = (1 - right) * low, tent[3][pixel] = right * low;
    }
}

/// Computes the predictions of all outputs for a group of pixels from `pixel` on, followed by their mean. all_terms:
/// whether the cell has the terms of emission besides the plain ones.
template <class F, bool all_terms>
TYNDALL_INLINE void predict_pixels(const CellTerms& cell, const CellBlocks& blocks, const float (*tent)[cell_pixels],
                                   int pixel, float (*out)[cell_pixels]) {
  F term[plain_terms], weight[4], level = F(0.0f);
  for (int i = 1; i < plain_terms; ++i) term[i] = load<F>(cell.of[i] + pixel);
  for (int k = 0; k < 4; ++k) weight[k] = load<F>(tent[k] + pixel);
  for (int output = 0; output < outputs; ++output) {
    const float(*emission)[cell_pixels] = cell.of + emission_column + std::ptrdiff_t{output / 3} * emission_terms;
    F total = F(0.0f);
    for (int k = 0; k < 4; ++k) {
      const float* c = blocks.of[k][output];
      F sum = splat<F>(c[0]);
      for (int i = 1; i < plain_terms; ++i) sum = mul_add(splat<F>(c[i]), term[i], sum);
      for (int i = 0; all_terms && i < emission_terms; ++i)
        sum = mul_add(splat<F>(c[plain_terms + i]), load<F>(emission[i] + pixel), sum);
      total = mul_add(weight[k], sum, total);
    }
    if (all_terms) total = total + load<F>(cell.of[emission_column + output] + pixel);
    store(out[output] + pixel, total);
    level = level + total;
  }
  store(out[outputs] + pixel, F(1.0f / outputs) * level);
}

/// Whether all light of a half came straight from lights or the sky, in those of the 3 x 3 pixels around in which
/// nothing is seen.
TYNDALL_INLINE bool is_dark(const FilterView& v, int half, int x0, int y0) {
  for (int y = maximum(y0 - 1, 0); y <= minimum(y0 + 1, v.height - 1); ++y)
    for (int x = maximum(x0 - 1, 0); x <= minimum(x0 + 1, v.width - 1); ++x) {
      const std::ptrdiff_t at = y * v.stride + x;
      if (v.seen[seen_features - 1][at] > 0) continue;
      for (int output = 3 * half; output < 3 * half + 3; ++output) {
        if (v.half[output][at] > 1.00001f * v.emission[output][at]) return false;  // more than the rounding of both
      }
    }
  return true;
}

/// Leaves a half unfiltered where nothing is seen and the half is dark: otherwise neighbouring surfaces would glow into
/// the dark. Only where emission is recorded; without it such a glow cannot be told from the sky that is seen there.
TYNDALL_INLINE void keep_dark(const FilterView& v, const CellTerms& cell, int x0, int y0, float (*out)[cell_pixels]) {
  if (!v.has_emission()) return;
  float nearest = 1;
  for (int q = 0; q < cell_pixels; ++q)
    nearest = nearest < cell.of[depth_column][q] ? nearest : cell.of[depth_column][q];
  if (nearest > 0) return;
  alignas(64) float glow[cell_pixels];  // what is predicted beside the emission, but for the rounding of both
  for (int q = 0; q < cell_pixels; ++q) glow[q] = out[outputs][q];
  for (int k = 0; cell.shines && k < outputs; ++k)
    for (int q = 0; q < cell_pixels; ++q) glow[q] -= 1.0f / outputs * cell.of[emission_column + k][q];
  int glowing = 0;
  for (int q = 0; q < cell_pixels; ++q) {
    const bool seen = cell.of[depth_column][q] > 0;
    glow[q] = seen || abs(glow[q]) <= 1e-5f * abs(out[outputs][q]) ? 0.0f : 1.0f;
    glowing += glow[q] > 0 ? 1 : 0;
  }
  for (int q = 0; q < cell_pixels && glowing > 0; ++q) {
    const int x = x0 + q % cell_edge, y = y0 + q / cell_edge;
    if (glow[q] == 0 || x >= v.width || y >= v.height) continue;
    float level = 0;
    for (int half = 0; half < 2; ++half) {
      const bool dark = is_dark(v, half, x, y);
      for (int output = 3 * half; output < 3 * half + 3; ++output) {
        if (dark) out[output][q] = v.half[output][y * v.stride + x];
        level += out[output][q];
      }
    }
    out[outputs][q] = 1.0f / outputs * level;
  }
}

/// Writes the filtered pixels of a cell to the picture.
TYNDALL_INLINE void put_cell(const FilterView& v, int x0, int y0, int rows, const float (*out)[cell_pixels]) {
  const int columns = minimum(cell_edge, v.width - x0);
  for (int output = 0; output <= outputs; ++output) {
    float* to = (output < outputs ? v.filtered[output] : v.level) + y0 * v.stride + x0;
    for (int y = 0; y < rows; ++y)
      if (columns == cell_edge)
        copy_row(out[output] + std::ptrdiff_t{y} * cell_edge, to + y * v.stride);
      else
        for (int x = 0; x < columns; ++x) to[y * v.stride + x] = out[output][y * cell_edge + x];
  }
}

template <class F>
TYNDALL_INLINE void predict_of(const FilterView& v, int cell_row) {
  const int cells = (v.width + cell_edge - 1) / cell_edge;
  alignas(64) float tent[4][cell_pixels], out[outputs + 1][cell_pixels];
  fill_tents(tent);
  CellTerms cell;
  fill_places(cell);
  CellBlocks blocks;
  for (int cx = 0; cx < cells; ++cx) {
    fill_terms(v, cx, cell_row, cell);
    take_blocks(v, cx, cell_row, blocks);
    if (cell.shines)
      for (int q = 0; q < cell_pixels; q += lanes_of<F>) predict_pixels<F, true>(cell, blocks, tent, q, out);
    else
      for (int q = 0; q < cell_pixels; q += lanes_of<F>) predict_pixels<F, false>(cell, blocks, tent, q, out);
    keep_dark(v, cell, cx * cell_edge, cell_row * cell_edge, out);
    put_cell(v, cx * cell_edge, cell_row * cell_edge, cell.rows, out);
  }
}

}  // namespace tyndall::filter
