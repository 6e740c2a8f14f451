#pragma once
#include "core/clean/cells.h"

/// Block regression. Within each block of 16 x 16 pixels a half of the picture is approximated by a linear function of
/// the place and of the first-seen features; blocks overlap by half. Noisy features count less (a ridge of their own
/// noise). Every product of two columns is summed once for each cell of 8 x 8 pixels, and a block adds up the sums of
/// its four cells. Each lane solves another block.
///
/// The regression on noisy features is from Bitterli et al., Nonlinearly Weighted First-order Regression for Denoising
/// Monte Carlo Renderings, Computer Graphics Forum 35 (2016); the blocks with shared sums are from He, Sun, Tang,
/// Guided Image Filtering, TPAMI 35 (2013).
namespace tyndall::filter {

/// The index of row i, column j <= i, of a triangular matrix that is stored row by row.
TYNDALL_INLINE constexpr int triangle(int i, int j) { return i * (i + 1) / 2 + j; }

// The sums of a cell: first the triangle of the products of the plain terms, and each output channel times each of
// them; then, for each half, the half's emission terms times the plain ones, their own triangle, and each channel of
// the half times each of them.

/// The index of the product of the terms i >= j for a half.
TYNDALL_INLINE int product_sum(int half, int i, int j) {
  if (i < plain_terms) return triangle(i, j);
  const int first = plain_sums + half * emission_sums, k = i - plain_terms;
  if (j < plain_terms) return first + k * plain_terms + j;
  return first + emission_terms * plain_terms + triangle(k, j - plain_terms);
}
/// The index of the product of a channel and the term i. output: 0 to 2 are the channels of the first half, 3 to 5
/// those of the second one.
TYNDALL_INLINE int channel_sum(int output, int i) {
  if (i < plain_terms) return plain_products + output * plain_terms + i;
  const int half = output / 3, channel = output % 3;
  return plain_sums + half * emission_sums + emission_terms * plain_terms + emission_products +
         channel * emission_terms + i - plain_terms;
}

/// The sums of the four cells of a block, for a group of blocks that follow each other in x.
template <class F>
struct BlockCells {
  const float* part[4];  ///< first sums of the first block's cells: upper left, upper right, lower left, lower right
  std::ptrdiff_t stride;

  TYNDALL_INLINE F at(int k, int s) const { return load<F>(part[k] + s * stride); }
  TYNDALL_INLINE F sum(int s) const { return (at(0, s) + at(1, s)) + (at(2, s) + at(3, s)); }
  /// Moves the sum of a product with x from the middles of the cells to the middle of the block, a quarter of a block
  /// away: adds a quarter of the right cells' sums minus the left cells'. down(): the same for y.
  TYNDALL_INLINE F across(int s) const { return F(0.25f) * ((at(1, s) - at(0, s)) + (at(3, s) - at(2, s))); }
  TYNDALL_INLINE F down(int s) const { return F(0.25f) * ((at(2, s) - at(0, s)) + (at(3, s) - at(1, s))); }
  /// The same for the product of x and y.
  TYNDALL_INLINE F across_down(int s) const { return F(0.0625f) * ((at(0, s) - at(1, s)) + (at(3, s) - at(2, s))); }
};

/// The sums of products of a block, whose x and y are counted from its own middle.
template <class F>
TYNDALL_INLINE F block_product(const BlockCells<F>& cells, int half, int i, int j) {
  const F own = cells.sum(product_sum(half, i, j));
  if (i == 1 && j == 0) return own + cells.across(0);
  if (i == 2 && j == 0) return own + cells.down(0);
  if (i == 1) return own + F(2.0f) * cells.across(product_sum(half, 1, 0)) + F(0.0625f) * cells.sum(0);
  if (i == 2 && j == 2) return own + F(2.0f) * cells.down(product_sum(half, 2, 0)) + F(0.0625f) * cells.sum(0);
  if (i == 2)
    return own + cells.down(product_sum(half, 1, 0)) + cells.across(product_sum(half, 2, 0)) + cells.across_down(0);
  if (j == 1) return own + cells.across(product_sum(half, i, 0));
  if (j == 2) return own + cells.down(product_sum(half, i, 0));
  return own;
}
/// The same for the product of a channel and the term i.
template <class F>
TYNDALL_INLINE F block_channel(const BlockCells<F>& cells, int output, int i) {
  const F own = cells.sum(channel_sum(output, i));
  if (i == 1) return own + cells.across(channel_sum(output, 0));
  if (i == 2) return own + cells.down(channel_sum(output, 0));
  return own;
}

/// The normal equations of all terms but the first, for a group of blocks: the factor L of their matrix G = L Lᵀ
/// (Cholesky). Its diagonal is stored as 1 / L[i][i].
template <class F>
struct Normal {
  int size;       ///< number of terms, without the first
  F pixels;       ///< number of pixels in the block, at least 1
  F mean[terms];  ///< mean of each term
  F factor[terms * (terms + 1) / 2];
};

/// Differences of a term below this value count as its noise: of the place (terms 1 and 2), the albedo (3 to 5), the
/// normal (6 to 8), the depth (9) and the emission (10 to 12).
TYNDALL_INLINE float feature_floor(int term) {
  return term < 3 ? 0.05f : term < 6 ? 0.02f : term < 9 ? 0.03f : term < 10 ? 0.01f : 0.02f;
}

template <class F>
TYNDALL_INLINE void set_up(const BlockCells<F>& cells, int half, int size, Normal<F>& n) {
  n.size = size;
  n.pixels = max(cells.sum(0), F(1.0f));
  const F per_pixel = F(1.0f) / n.pixels;
  for (int i = 0; i < size; ++i) n.mean[i] = block_product(cells, half, i + 1, 0) * per_pixel;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j)
      n.factor[triangle(i, j)] = neg_mul_add(n.pixels * n.mean[i], n.mean[j], block_product(cells, half, i + 1, j + 1));
  for (int i = 0; i < size; ++i) {
    const float floor = feature_floor(i + 1);
    F& g = n.factor[triangle(i, i)];
    g = mul_add(g, F(1.001f), mul_add(n.pixels, F(0.1f * floor * floor), F(1e-9f)));
    if (i + 1 < plain_terms) continue;
    const int k = i + 1 - plain_terms;  // for emission, the ridge also holds the variance between the halves
    const F both = cells.sum(product_sum(0, i + 1, i + 1)) + cells.sum(product_sum(1, i + 1, i + 1));
    g = g + max(neg_mul_add(F(1.0f), cells.sum(emission_cross + k), F(0.5f) * both), F(0.0f));
  }
}

template <class F>
TYNDALL_INLINE void factorise(Normal<F>& n) {
  for (int i = 0; i < n.size; ++i)
    for (int j = 0; j <= i; ++j) {
      F s = n.factor[triangle(i, j)];
      for (int q = 0; q < j; ++q) s = neg_mul_add(n.factor[triangle(i, q)], n.factor[triangle(j, q)], s);
      n.factor[triangle(i, j)] = i == j ? F(1.0f) / sqrt(max(s, F(1e-12f))) : s * n.factor[triangle(j, j)];
    }
}

/// The coefficients of one channel, `stride` apart.
template <class F>
TYNDALL_INLINE void solve_channel(const BlockCells<F>& cells, const Normal<F>& n, int output, float* to,
                                  std::ptrdiff_t stride) {
  const F mean = block_channel(cells, output, 0) * (F(1.0f) / n.pixels);
  F r[terms];
  for (int i = 0; i < n.size; ++i) r[i] = neg_mul_add(n.pixels * mean, n.mean[i], block_channel(cells, output, i + 1));
  for (int i = 0; i < n.size; ++i) {
    for (int q = 0; q < i; ++q) r[i] = neg_mul_add(n.factor[triangle(i, q)], r[q], r[i]);
    r[i] = r[i] * n.factor[triangle(i, i)];
  }
  F first = mean;
  for (int i = n.size - 1; i >= 0; --i) {
    for (int q = i + 1; q < n.size; ++q) r[i] = neg_mul_add(n.factor[triangle(q, i)], r[q], r[i]);
    r[i] = r[i] * n.factor[triangle(i, i)];
    first = neg_mul_add(r[i], n.mean[i], first);
    store(to + (i + 1) * stride, r[i]);
  }
  store(to, first);
  for (int i = n.size + 1; i < terms; ++i) store(to + i * stride, F(0.0f));
}

template <class F>
TYNDALL_INLINE void fit_blocks_of(const FilterView& v, int block_row) {
  const int blocks = (v.width + cell_edge - 1) / cell_edge + 1;
  const float* above = v.sums + std::ptrdiff_t{block_row} * all_sums * v.cell_stride;
  const float* below = above + all_sums * v.cell_stride;
  const std::uint8_t* shines = v.shines + block_row * v.cell_stride;
  float* row = v.coefficients + std::ptrdiff_t{block_row} * outputs * terms * v.cell_stride;
  Normal<F> normal;
  for (int b = 0; b < blocks; b += lanes_of<F>) {
    const BlockCells<F> cells{{above + b, above + b + 1, below + b, below + b + 1}, v.cell_stride};
    bool lit = false;
    for (int i = 0; i <= lanes_of<F>; ++i) lit |= shines[b + i] || shines[b + i + v.cell_stride];
    const int systems = lit ? 2 : 1;  // without emission both halves have the same equations
    for (int system = 0; system < systems; ++system) {
      set_up(cells, system, (lit ? terms : plain_terms) - 1, normal);
      factorise(normal);
      const int first = system * 3, last = lit ? first + 3 : outputs;
      for (int output = first; output < last; ++output)
        solve_channel(cells, normal, output, row + std::ptrdiff_t{output} * terms * v.cell_stride + b, v.cell_stride);
    }
  }
}

}  // namespace tyndall::filter
