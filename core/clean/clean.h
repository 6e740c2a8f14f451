#pragma once
#include "core/base/error_sum.h"
#include "core/base/thread_pool.h"
#include "core/clean/filter_view.h"
#include "core/film/film.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

/// The clean view: a filtered picture with an estimate of its error. Films and their hashes are never filtered.
///
/// The filter runs on the two independent halves of the samples, each by itself (regression.h). Where the halves
/// disagree, less of the filter's result is used: pixel by pixel the result is mixed from the filtered, a blurred and
/// the raw picture, and the disagreement is the error estimate (choice.h). With more samples more of the raw picture
/// shows, so that the error has no floor.
namespace tyndall {

/// A row of floats, aligned to 64 bytes as a group of lanes needs, initially zero. The memory is taken from the system
/// page by page when it is first written, by the thread that writes, and in large pages where possible: otherwise
/// getting the memory of a picture's planes would take as long as filtering it.
class ZeroedFloats {
 public:
  /// Throws std::bad_alloc.
  void resize(std::size_t count);
  float* data() { return first_; }
  const float* data() const { return first_; }

 private:
  std::unique_ptr<float, void (*)(void*)> memory_{nullptr, std::free};
  float* first_ = nullptr;
};

/// Planes of numbers, all of one size. Rows have room to the left and right, so that whole groups of lanes can be read
/// everywhere.
class Planes {
 public:
  static constexpr int margin = filter::row_margin;

  /// Makes all numbers zero. If the size is unchanged, the memory and the old numbers within the rows are kept, and
  /// false is returned.
  bool resize(int width, int height, int count);
  int width() const { return width_; }
  std::ptrdiff_t stride() const { return stride_; }
  int count() const { return count_; }
  /// The first number of the first row.
  float* plane(int i) { return data_.data() + margin + std::ptrdiff_t{i} * height_ * stride_; }
  const float* plane(int i) const { return data_.data() + margin + std::ptrdiff_t{i} * height_ * stride_; }

 private:
  int width_ = 0, height_ = 0, count_ = 0;
  std::ptrdiff_t stride_ = 0;
  ZeroedFloats data_;
};

/// A picture to be filtered: the means of both halves of its samples, and the part of them that came straight from
/// lights and sky.
struct CleanInput {
  int width = 0, height = 0;
  float scale = 1;                      ///< a power of two: radiance is that times the numbers in the planes
  double spp = 0;                       ///< samples a pixel, on average
  bool grouped = false;                 ///< groups of pixels share second vertices, and so their noise: film/groups.h
  Planes halves;                        ///< 6: red, green, blue of A and B
  Planes emission;                      ///< likewise, or none
  std::vector<std::uint8_t> dark_rows;  ///< 1: the row's emission is 0; empty: not known of any
  /// 8 of the surface seen first through each pixel, free of noise, means over the parts of the pixel: albedo; normal;
  /// nearness, 1 / (1 + depth over its harmonic mean in the picture); and whether it is sharp: 1 where lights and sky
  /// are not seen by chance, as they are in glass and in brushed metal. A part that sees nothing counts as zeros.
  Planes seen;
};

/// Fills all but `seen` from a film's region. If one half of a pixel has no samples, it gets the other half's mean.
/// Returns false if `give_up` was set before the end; the planes are then unusable.
bool read_film(const Film& film, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanInput& input);

/// The filtered picture.
struct CleanPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< 3 floats a pixel, linear, top row first; never negative
  /// Estimated relative error: its square estimates the picture's relMSE.
  double relative_error = std::numeric_limits<double>::infinity();
  /// Whether a few pixels make up most of the estimate, which then means little: see
  /// ErrorEstimate::rests_on_few_pixels.
  bool rests_on_few_pixels = false;
  /// Estimated relative error of each pixel, from the 13 x 13 pixels around it.
  std::vector<float> pixel_error;
};

/// Filters pictures one after the other, and keeps its memory (about 150 bytes a pixel) from one to the next.
class Cleaner {
 public:
  explicit Cleaner(Target target);
  /// Uses these steps in place of an instruction set's: for tests that count calls.
  explicit Cleaner(const filter::FilterSteps& steps);

  /// Filters a picture whose pixels all have samples in both halves. Returns false and leaves `out` unchanged if
  /// `give_up` is set before the end: each thread then finishes its row of pixels, or of 8 x 8 pixels, in less than 1
  /// ms. levels_of: returns the levels of the pixels that decide the error (see ask_levels()) and must itself stop at
  /// `give_up`; empty: levels are estimated from the picture alone. The result has the same bits for any number of
  /// threads. Throws std::bad_alloc.
  bool run(const CleanInput& input, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanPicture& out,
           const LevelsOf& levels_of = {});

 private:
  void resize(int width, int height, bool grouped);
  filter::FilterView view_of(const CleanInput& input);

  filter::FilterSteps steps_;
  std::vector<filter::ColumnPair> pairs_;
  Planes work_;  ///< filtered 6, level, gain, distance; of grouped pixels also gain_by_noise
  CleanPicture made_;
  ZeroedFloats sums_, coefficients_;
  std::vector<std::uint8_t> shines_;
  std::vector<double> row_noise_;  ///< for each row the sum of its pixels' relative variance
  int cells_x_ = 0, cells_y_ = 0;
  std::ptrdiff_t cell_stride_ = 0;
};

}  // namespace tyndall
