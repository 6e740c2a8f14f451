#pragma once
#include "core/base/error_sum.h"
#include "core/base/target.h"
#include "core/base/thread_pool.h"
#include "core/film/film.h"

#include <atomic>
#include <cstdint>
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

/// What is seen first through a pixel, free of noise; the mean of what its parts see, those that see nothing as zeros.
struct FirstSeen {
  Vec3f albedo, normal;
  float nearness = 0;  ///< 1 / (1 + depth over its harmonic mean in the picture), in [0, 1); 0: nothing is seen
  bool sharp = true;   ///< lights and sky are not seen by chance there, as they are in glass and in brushed metal
};

/// Zeros at first, and at a multiple of 64 bytes, as a group of lanes is. They take memory once they are written to, by
/// the thread that does so, and in large pages where the system has them: a picture's planes would else spend as much
/// time on getting memory as on being filtered.
class ZeroedFloats {
 public:
  /// Throws std::bad_alloc.
  void resize(std::size_t count);
  float* data() { return first_; }
  const float* data() const { return first_; }

 private:
  struct Free {
    void operator()(float* floats) const;
  };
  std::unique_ptr<float, Free> memory_;
  float* first_ = nullptr;
};

/// Planes of numbers, all of one size. Rows have room to the left and right, so that whole groups of lanes can be read
/// everywhere.
class Planes {
 public:
  static constexpr int margin = 16;

  /// Zeros. Keeps its memory where the size is the same, with whatever it holds within the rows, and returns false.
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

/// A picture to be filtered: both halves, as means over samples, and the light that came straight from lights and sky.
struct CleanInput {
  int width = 0, height = 0;
  float scale = 1;                      ///< a power of two: radiance is that times the numbers in the planes
  double spp = 0;                       ///< samples a pixel, on average
  bool grouped = false;                 ///< groups of pixels share second vertices, and so their noise: film/groups.h
  Planes halves;                        ///< 6: red, green, blue of A and B
  Planes emission;                      ///< likewise, or none
  std::vector<std::uint8_t> dark_rows;  ///< 1: the row's emission is 0; empty: not known of any
  Planes seen;                          ///< 8: albedo, normal, nearness, 1 where sharp
};

/// Fills all but `seen` with a film's region. Where one half of a pixel is empty it gets what the other has.
/// Returns false if `give_up` was set before the end; the planes are then of no use.
bool read_film(const Film& film, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanInput& input);
/// Makes room in `seen`.
void resize_first_seen(int width, int height, CleanInput& input);
/// Sets what a pixel sees first.
void put_first_seen(const FirstSeen& pixel, int x, int y, CleanInput& input);

/// The filtered picture.
struct CleanPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;  ///< 3 floats a pixel, linear, top row first; never negative
  /// Estimated relative error: its square estimates the picture's relMSE.
  double relative_error = std::numeric_limits<double>::infinity();
  /// Whether the estimate means little, because few pixels make up most of it: see ErrorEstimate::rests_on_few_pixels.
  bool rests_on_few_pixels = false;
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
  /// which takes less than 1 ms. levels_of: tells the levels of the pixels that decide the error (see ask_levels()),
  /// and has to notice `give_up` itself; empty: they are found from the picture alone. The same bits for any number of
  /// threads. Throws std::bad_alloc.
  bool run(const CleanInput& input, ThreadPool& thread_pool, const std::atomic<bool>& give_up, CleanPicture& out,
           const LevelsOf& levels_of = {});

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace tyndall
