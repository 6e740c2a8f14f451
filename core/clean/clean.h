#pragma once
#include "core/base/crew.h"
#include "core/base/target.h"
#include "core/film/film.h"

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

/// The clean view: a filtered picture that knows its error. Films and their hashes are never filtered.
///
/// Each half of the film is filtered from itself alone (regression.h), then what the halves say of each other decides,
/// pixel by pixel, how much of the filtered, a blurred or the raw picture helps, and how wrong the result still is
/// (choice.h). So the more samples there are the more of the raw picture shows, and the error has no floor.
namespace tyndall {
namespace filter {
struct FilterSteps;
}

/// What is seen first through the middle of a pixel, free of noise.
struct FirstSeen {
  Vec3f albedo, normal;
  float depth = 0;    ///< > 0, in any unit; 0: nothing is seen
  bool sharp = true;  ///< lamps and sky are not seen by chance there, as they are in glass and in brushed metal
};

/// Planes of numbers, all of one size. Rows have room to the left and right, so that whole groups of lanes can be read
/// everywhere.
class Planes {
 public:
  static constexpr int margin = 16;

  /// Zeros. Keeps its memory where the size is the same, with whatever it holds within the rows.
  void resize(int width, int height, int count);
  int width() const { return width_; }
  std::ptrdiff_t stride() const { return stride_; }
  int count() const { return count_; }
  /// The first number of the first row.
  float* plane(int i) { return data_.data() + margin + std::ptrdiff_t{i} * height_ * stride_; }
  const float* plane(int i) const { return data_.data() + margin + std::ptrdiff_t{i} * height_ * stride_; }

 private:
  int width_ = 0, height_ = 0, count_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> data_;
};

/// A picture to be filtered: both halves, as means over samples, and the light that came straight from lamps and sky.
struct CleanInput {
  int width = 0, height = 0;
  float scale = 1;  ///< a power of two: radiance is that times the numbers in the planes
  Planes halves;    ///< 6: red, green, blue of A and B
  Planes emission;  ///< likewise, or none
  Planes seen;      ///< 8: albedo, normal, 1 / (1 + depth over its harmonic mean), 1 where sharp
};

/// Fills `halves` and `emission` with a film's region. Where one half of a pixel is empty it gets what the other has.
/// Returns false if `give_up` was set before the end; the planes are then of no use.
bool read_film(const Film& film, Crew& crew, const std::atomic<bool>& give_up, CleanInput& input);
/// Fills `seen` from one entry for each pixel, row by row. Returns false as read_film() does.
bool read_first_seen(const std::vector<FirstSeen>& pixels, int width, int height, Crew& crew,
                     const std::atomic<bool>& give_up, CleanInput& input);

/// The filtered picture.
struct CleanPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< 3 floats a pixel, linear, top row first
  /// Estimated relative error: its square estimates the picture's relMSE.
  double relative_error = std::numeric_limits<double>::infinity();
  /// The same of each pixel, from the 13 x 13 pixels around it.
  std::vector<float> pixel_error;
};

/// Filters pictures one after the other, and keeps its memory (about 150 bytes a pixel) from one to the next.
class Cleaner {
 public:
  explicit Cleaner(Target target);
  /// With these steps instead of an instruction set's: for tests that count them.
  explicit Cleaner(const filter::FilterSteps& steps);
  ~Cleaner();
  Cleaner(Cleaner&&) noexcept;
  Cleaner& operator=(Cleaner&&) noexcept;

  /// Filters a picture whose pixels all have samples in both halves. Returns false, and leaves `out` as it was, if
  /// `give_up` is set before the end: then each thread ends after the row of pixels, or of 8 x 8 pixels, that it is at,
  /// which takes less than 1 ms. The same bits for any number of threads. Throws std::bad_alloc.
  bool run(const CleanInput& input, Crew& crew, const std::atomic<bool>& give_up, CleanPicture& out);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tyndall
