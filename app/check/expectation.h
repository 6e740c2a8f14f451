#pragma once
#include "app/check/objects.h"
#include "app/check/reading.h"
#include "app/check/reference.h"
#include "app/check/rules.h"
#include "app/check/statistics.h"
#include "core/base/thread_pool.h"
#include "core/targets/kernels.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tyndall {

struct CheckOptions {
  double seconds = 20;  ///< for all of it, but for what is needed for any answer
  int threads = 0;      ///< 0: see thread_count()
  int samples = 0;      ///< that are taken of each pixel for a program; 0: as many as the time allows
};

/// What samples of a program tell of its picture: 3 floats a pixel of the lattice.
struct BookModel {
  std::vector<float> mean, excess;  ///< see SampleStatistics
};

/// How the means of a picture differ from what is expected, in small blocks, in large ones, and by object: three of
/// each region.
struct RegionDifferences {
  std::vector<BlockDifference> all;
  std::size_t small = 0, large = 0;  ///< how many of them are of small and of large blocks, which come first
  std::span<const BlockDifference> of_small() const { return {all.data(), small}; }
  std::span<const BlockDifference> of_large() const { return {all.data() + small, large}; }
  std::span<const BlockDifference> of_objects() const { return std::span(all).subspan(small + large); }
  double amount() const { return amount_of(all, all); }
};

/// The pictures that are expected of programs, and how the user's picture differs from them.
///
/// The mean of a picture is not that of its light: white cuts off what is brighter, which lowers the mean of noisy
/// pixels. So what is expected of a program is: the scene, rendered well, plus the difference that the program's rules
/// make, from samples with common random numbers, minus what white cuts off of means of as many samples as the picture
/// has.
class Expectation {
 public:
  Expectation(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
              const CheckOptions& options, const std::function<bool()>& go_on);

  /// The program that renders the scene as it is.
  const BookProgram& start() const { return start_; }
  const SeenObjects& seen() const { return seen_; }
  int block_edge() const { return grid_.edge * lattice_.step; }  ///< of a small block, in pixels
  /// Samples a pixel of the picture, as its noise tells; 0: not known.
  double samples() const { return samples_of_picture_; }
  /// Finds that out, or sets it. Models that were made before are of no use after that.
  void find_samples(const Reading& reading);
  void set_samples(double samples);
  /// Fraction of the small blocks in which the samples show about as much light as there is. The others are left out.
  double comparable() const { return comparable_; }
  /// Whether so much of the samples is brighter than white that their number decides what the picture looks like.
  bool white_matters() const;

  /// Fraction of the scene's light that is found after at most so many scattering events, from 0 on.
  std::vector<double> light_by_depth() const;
  /// Of the scene as it is; max_depth: light found after more scattering events is left out; negative: none is.
  BookModel start_model(int max_depth = -1) const;
  /// Renders a program; null: there is no time left; in_time: whether that matters. Valid until the next call.
  const BookModel* model_of(const BookProgram& program, bool in_time);
  RegionDifferences differences(const BookModel& model, const Reading& reading);

 private:
  void take_samples(const CheckOptions& options);
  const ReadPixels& read(const Reading& reading);
  Regions without_rare_light(Regions regions) const;
  BookModel model_of(const std::vector<BookSample>& samples, int max_depth) const;
  std::vector<float> expected_of(const BookModel& model) const;

  const PictureNumbers& picture_;
  BookProgram start_;
  Lattice lattice_;
  BlockGrid grid_;
  std::vector<float> reference_, reference_variance_;  ///< on the lattice
  Kernels kernels_;
  ThreadPool threads_;
  const std::function<bool()>& go_on_;
  SeenObjects seen_;
  Regions small_, large_, objects_;
  int count_ = 0;  ///< samples that were taken of each pixel
  int group_ = 0;  ///< samples of a pixel of the picture, as far as so many were taken
  double samples_of_picture_ = 0, comparable_ = 1;
  std::vector<BookSample> samples_;
  SampleStatistics base_;                                                ///< of the scene as it is
  std::vector<float> variance_;                                          ///< of a pixel of the picture
  std::vector<std::pair<BookRules, std::unique_ptr<BookModel>>> known_;  ///< of programs that only differ by rules
  std::unique_ptr<BookModel> newest_;                                    ///< of another one
  std::vector<std::pair<Reading, std::unique_ptr<ReadPixels>>> read_;
  std::unique_ptr<ReadPixels> newest_read_;
};

/// How a picture differs from the scene as a few samples of each pixel show it: enough to tell whether it is a picture
/// of this scene at all.
Misfit rough_misfit(const PictureNumbers& picture, const Scene& scene, int threads);

}  // namespace tyndall
