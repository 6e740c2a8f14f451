#pragma once
#include "app/check/reading.h"
#include "app/check/statistics.h"
#include "core/base/thread_pool.h"

#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace tyndall {

struct CheckOptions {
  double seconds = 20;  ///< for all of it, but for what is needed for any answer
  int samples = 0;      ///< that are taken of each pixel for a program; 0: as many as the time allows
};

/// A picture rendered to measure another one against.
struct Reference {
  LinearImage image;
  std::vector<float> variance;  ///< of each number of the image, from two halves of the samples
};

/// Renders the scene until the noise is small against the difference from `picture`, which has the scene's size, or
/// a limit is reached, which the first samples may exceed. go_on: asked now and then; false ends it. Pixels share no
/// paths, so that their errors are independent.
Reference render_reference(Scene scene, const LinearImage& picture, double seconds, std::uint32_t spp,
                           const std::function<bool()>& go_on);

/// What samples of a program tell of its picture: 3 floats a pixel of the lattice.
struct BookModel {
  std::vector<float> expected;
  std::vector<float> noise;  ///< variance of a pixel of a picture with the number of samples of the user's
  double samples = 0;        ///< that number; 0: not known
};

/// The pictures that are expected of programs, and how the user's picture differs from them.
///
/// The mean of a picture is not that of its light: white cuts off what is brighter, which lowers the mean of noisy
/// pixels. So what is expected of a program is what its samples show of means of as many as the picture has, cut at
/// white; and what those of the scene itself, of the same random numbers, happened to miss of the scene, rendered well,
/// as far as it gets through the cut. How far that is, their covariance tells (J. M. Hammersley, D. C. Handscomb, Monte
/// Carlo Methods, 5.5: control variates).
class Expectation {
 public:
  Expectation(const PictureNumbers& picture, const Scene& scene, const Reference& reference,
              const CheckOptions& options, const std::function<bool()>& go_on);

  /// The program that renders the scene as it is.
  const BookProgram& start() const { return start_; }
  const SeenObjects& seen() const { return seen_; }
  int block_edge() const { return edge_ * lattice_.step; }  ///< of a small block, in pixels
  /// The numbers that the picture's noise may stand for if a program's samples are those of the picture's program, the
  /// likeliest first; 0: not known. White makes few samples show as little noise as many.
  std::vector<double> likely_samples(const std::vector<BookSample>& of_program, const Reading& reading) const;
  /// Fraction of the small blocks in which the samples show about as much light as there is. The others are left out.
  double comparable() const { return comparable_; }
  /// Whether so much of the samples is brighter than white that their number decides what the picture looks like.
  bool white_matters() const;

  /// Of the scene as it is.
  const std::vector<BookSample>& start_samples() const { return samples_; }
  /// Renders a program; empty: there is no time left; in_time: whether that matters.
  std::vector<BookSample> samples_of(const BookProgram& program, bool in_time);
  /// What is expected of a program with these samples if the picture has `count` samples a pixel; 0: not known.
  std::shared_ptr<const BookModel> model_of(const std::vector<BookSample>& samples, double count) const;
  RegionDifferences differences(const BookModel& model, const Reading& reading);

 private:
  void take_samples(const CheckOptions& options);
  const ReadPixels& read(const Reading& reading);
  Regions without_rare_light(Regions regions) const;
  double white() const { return picture_.coded ? 1 : std::numeric_limits<double>::infinity(); }

  const PictureNumbers& picture_;
  BookProgram start_;
  Lattice lattice_;
  int edge_;                                           ///< of a small block, in pixels of the lattice
  std::vector<float> reference_, reference_variance_;  ///< on the lattice
  ThreadPool threads_;
  const std::function<bool()>& go_on_;
  SeenObjects seen_;
  Regions small_, large_, objects_, whole_;
  int count_ = 0;  ///< samples that were taken of each pixel
  double comparable_ = 1;
  std::vector<BookSample> samples_;
  std::vector<float> mean_;       ///< of these
  std::vector<double> variance_;  ///< of one of them, of each large region and channel
  std::deque<std::pair<Reading, ReadPixels>> read_;
  ReadPixels newest_read_;
};

/// How a picture differs from the scene as a few samples of each pixel show it: enough to tell whether it is a picture
/// of this scene at all.
Misfit rough_misfit(const PictureNumbers& picture, const Scene& scene);

}  // namespace tyndall
