#pragma once
#include "core/clean/regression.h"

/// What the regression makes of a picture: each pixel takes what the four blocks around predict of it.
namespace tyndall::filter {

/// The coefficients of the four blocks that a cell belongs to, for places counted from the cell's own middle.
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

/// The weights with which each pixel of a cell mixes the predictions of the four blocks that it is in: bilinear tents.
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

/// The prediction of an output for a group of pixels from `pixel` on.
template <class F>
TYNDALL_INLINE F predict_pixels(const CellColumns& cell, const CellBlocks& blocks, const float (*tent)[cell_pixels],
                                int output, int pixel) {
  F total = F(0.0f);
  for (int k = 0; k < 4; ++k) {
    const float* c = blocks.of[k][output];
    F sum = splat<F>(c[0]);
    for (int i = 1; i < plain_terms; ++i) sum = mul_add(splat<F>(c[i]), load<F>(cell.of[i] + pixel), sum);
    if (cell.shines)
      for (int i = 0; i < emission_terms; ++i)
        sum = mul_add(splat<F>(c[plain_terms + i]),
                      load<F>(cell.of[emission_column + output / 3 * emission_terms + i] + pixel), sum);
    total = mul_add(load<F>(tent[k] + pixel), sum, total);
  }
  return cell.shines ? total + load<F>(cell.of[emission_column + output] + pixel) : total;
}

/// Whether a half shows no light but what came straight from lamps or the sky, in those of the 3 x 3 pixels around
/// where nothing is seen.
TYNDALL_INLINE bool is_dark(const FilterView& v, int half, int x0, int y0) {
  for (int y = most(y0 - 1, 0); y <= least(y0 + 1, v.height - 1); ++y)
    for (int x = most(x0 - 1, 0); x <= least(x0 + 1, v.width - 1); ++x) {
      const std::ptrdiff_t at = y * v.stride + x;
      if (v.seen[seen_features - 1][at] > 0) continue;
      for (int output = 3 * half; output < 3 * half + 3; ++output) {
        if (v.half[output][at] > 1.00001f * v.emission[output][at]) return false;  // more than the rounding of both
      }
    }
  return true;
}

/// Leaves a half as it is where nothing is seen and it is dark: what is seen next to there would glow into the dark.
/// Only where emission is recorded, as else the sky, which is seen there, cannot be told from such a glow.
TYNDALL_INLINE void keep_dark(const FilterView& v, const CellColumns& cell, int x0, int y0, float (*out)[cell_pixels]) {
  if (!v.has_emission()) return;
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

template <class F>
TYNDALL_INLINE void predict_of(const FilterView& v, int cell_row) {
  const int cells = (v.width + cell_edge - 1) / cell_edge;
  const int inside_y = least(cell_edge, v.height - cell_row * cell_edge);
  alignas(64) float tent[4][cell_pixels], out[outputs + 1][cell_pixels];
  fill_tents(tent);
  CellColumns cell;
  CellBlocks blocks;
  for (int cx = 0; cx < cells; ++cx) {
    fill_columns(v, cx, cell_row, false, cell);
    take_blocks(v, cx, cell_row, blocks);
    for (int pixel = 0; pixel < cell_pixels; pixel += lanes_of<F>) {
      F level = F(0.0f);
      for (int output = 0; output < outputs; ++output) {
        const F value = predict_pixels<F>(cell, blocks, tent, output, pixel);
        store(out[output] + pixel, value);
        level = level + value;
      }
      store(out[outputs] + pixel, F(1.0f / outputs) * level);
    }
    keep_dark(v, cell, cx * cell_edge, cell_row * cell_edge, out);
    const int inside_x = least(cell_edge, v.width - cx * cell_edge);
    for (int output = 0; output <= outputs; ++output) {
      float* to = (output < outputs ? v.filtered[output] : v.level) + std::ptrdiff_t{cell_row} * cell_edge * v.stride +
                  std::ptrdiff_t{cx} * cell_edge;
      for (int y = 0; y < inside_y; ++y)
        for (int x = 0; x < inside_x; ++x) to[y * v.stride + x] = out[output][y * cell_edge + x];
    }
  }
}

}  // namespace tyndall::filter
