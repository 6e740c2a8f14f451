#pragma once
#include "core/base/lanes.h"
#include "core/base/target.h"

#include <cstddef>
#include <cstdint>

/// The filter's data as plain pointers: the only data that the code of the instruction sets reads. That code must not
/// call a container's member functions: the linker keeps one copy of each for all files, and a copy with wide
/// instructions would crash older CPUs.
namespace tyndall::filter {

/// Planes have room to the left and right of each row, so that whole groups of lanes can be read everywhere.
inline constexpr int row_margin = 16;

/// The picture is cut into cells of cell_edge x cell_edge pixels. A block is 2 x 2 cells: blocks overlap by half.
inline constexpr int cell_edge = 8, cell_pixels = cell_edge * cell_edge;

// The columns of a cell, one number a pixel: first 1, x, y and the first-seen features (albedo, normal, depth), which
// both halves share; then the emission of each half; then the halves themselves.
inline constexpr int seen_features = 7, plain_terms = 3 + seen_features, emission_terms = 3,
                     terms = plain_terms + emission_terms, outputs = 6;
inline constexpr int depth_column = plain_terms - 1;  ///< > 0 where anything is seen
inline constexpr int emission_column = plain_terms, half_column = emission_column + 2 * emission_terms,
                     cell_columns = half_column + outputs;

/// A product of two columns i >= j that is summed for each cell. A cell has plain_sums such products; a cell with
/// emission has all_sums.
struct ColumnPair {
  std::uint8_t i, j;
};
inline constexpr int plain_products = plain_terms * (plain_terms + 1) / 2;
inline constexpr int plain_sums = plain_products + outputs * plain_terms;
/// The further sums of each half in cells with emission: emission times the plain terms, times itself, and times the
/// half's channels.
inline constexpr int emission_products = emission_terms * (emission_terms + 1) / 2;
inline constexpr int emission_sums = emission_terms * plain_terms + emission_products + outputs / 2 * emission_terms;
inline constexpr int emission_cross = plain_sums + 2 * emission_sums;  ///< one half's emission times the other's
inline constexpr int all_sums = emission_cross + emission_terms;

/// A picture that is being filtered. Planes: width x height numbers, `stride` floats from row to row.
struct FilterView {
  int width = 0, height = 0;
  std::ptrdiff_t stride = 0;
  float floor = 0;          ///< what is added to squared levels, in squared units of the planes
  float trust_in_dark = 0;  ///< 1 with so many samples that a pixel is hardly dark by chance, else 0
  // For glows_into_dark(): with more samples fewer pixels are dark by chance, and smaller differences are enough.
  float by_far = 0;                           ///< how many times brighter than raw a picture that glows is, at least
  float quiet = 0;                            ///< largest relative variance of raw pixels that count as known
  bool grouped = false;                       ///< groups of pixels share their noise: see film/groups.h
  const float* half[outputs];                 ///< A and B: red, green, blue
  const float* emission[2 * emission_terms];  ///< likewise; null: not recorded
  const std::uint8_t* dark_rows;              ///< 1 where a row's emission is 0; null: not known
  const float* seen[seen_features];
  const float* sharp;        ///< 1 where lights and sky are seen without chance in between, else 0
  float* filtered[outputs];  ///< A and B
  float* level;              ///< mean of the six planes of `filtered`
  float *gain, *distance;    ///< by how much another picture would lower the error, and its squared distance
  float* gain_by_noise;      ///< the part of gain that is due to the halves' difference; only of grouped pixels
  const ColumnPair* pairs;   ///< all_sums of them
  // For each cell, in rows of cells and sum by sum, with a border of empty cells around the picture.
  float* sums;
  std::uint8_t* shines;            ///< whether the cell has emission
  std::ptrdiff_t cell_stride = 0;  ///< from a sum of a row of cells to the next
  float* coefficients;             ///< of each block, row by row: output by output, term by term
  float* error;                    ///< estimated squared relative error of each pixel, which may be negative by chance
  float* noise;                    ///< of that the relative variance; the rest is squared bias

  TYNDALL_INLINE bool has_emission() const { return emission[0] != nullptr; }
};

/// The pictures that may be mixed into the regression's result where they lower the error, in this order.
enum class Rival { blurred, raw };

/// The filter's steps. Each processes one row and reads only the results of earlier steps, so that any distribution of
/// rows over threads gives the same bits.
struct FilterSteps {
  void (*sum_cells)(const FilterView& view, int cell_row);          ///< rows of cells
  void (*fit_blocks)(const FilterView& view, int block_row);        ///< one more than rows of cells
  void (*predict)(const FilterView& view, int cell_row);            ///< writes filtered, level
  void (*compare)(const FilterView& view, Rival rival, int y);      ///< writes gain, distance
  void (*mix)(const FilterView& view, Rival rival, int y);          ///< changes filtered, level
  void (*judge)(const FilterView& view, int y);                     ///< writes error, noise; then filtered[0 .. 2]
                                                                    ///< are the picture, [3 .. 5] B of it
  void (*tell)(const FilterView& view, int y, float* pixel_error);  ///< fills a row of CleanPicture::pixel_error
};

/// Each is compiled with the flags of its instruction set. Call only what this build has and this CPU can run.
template <Target>
FilterSteps filter_for();
template <>
FilterSteps filter_for<Target::scalar>();
template <>
FilterSteps filter_for<Target::sse4>();
template <>
FilterSteps filter_for<Target::avx2>();
template <>
FilterSteps filter_for<Target::avx512>();
template <>
FilterSteps filter_for<Target::neon>();
template <>
FilterSteps filter_for<Target::wasm>();

}  // namespace tyndall::filter
