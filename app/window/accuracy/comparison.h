#pragma once
#include "app/window/accuracy/reference.h"

#include <memory>
#include <optional>
#include <vector>

/// Measures how far one picture is from another, as numbers and as a picture of the differences.
namespace tyndall {

/// The halves of a split view: on the right `current`, the scene as it is edited; on the left `kept`, the same scene
/// with the render settings that it had when the view was split. Without a split view all is `current`.
enum class Half { current, kept };

/// Pictures of differences, beside the views of the renderer.
enum class ErrorView { none, error, flip };

/// Two pictures of one size: a frame and what it is measured against.
struct ComparisonOrder {
  std::shared_ptr<const Frame> frame;
  std::shared_ptr<const Frame> kept;  ///< the left half of a split view; null: the frame is compared with the reference
  std::shared_ptr<const Reference> reference;
  ErrorView map = ErrorView::none;
  bool flip = false;        ///< also FLIP
  bool clean = false;       ///< also the frame's clean view
  bool independent = true;  ///< of the reference's random numbers: its own noise is taken off, where that is known
};

struct ComparisonResult {
  double rel_mse = 0;                   ///< <= 0: less than the reference's own noise
  std::optional<double> clean_rel_mse;  ///< of the clean view, if that was asked for
  std::optional<double> flip;           ///< mean over the pixels, as `tyndall compare` prints it
  std::vector<float> map;               ///< 4 floats a pixel; empty: none was asked for
  double cpu_seconds = 0;               ///< what this took
};

/// Whether both pictures are there and have one size.
bool can_compare(const ComparisonOrder& order);

/// Takes milliseconds, with FLIP a second. The error map is grey: 1 is 100 % and more, as in the noise view; the FLIP
/// map has the colours of `tyndall compare --heatmap`.
ComparisonResult compare(const ComparisonOrder& order);

/// Limits work that comes again and again to a fraction of the processors' time: the more it took, the later it is due
/// again. Times are seconds of one clock.
class ProcessorBudget {
 public:
  explicit ProcessorBudget(double fraction) : fraction_(fraction) {}
  bool due(double now) const { return now >= next_; }
  /// Work that began at the time `start` took `cpu_seconds` of one of `processors`.
  void spent(double start, double cpu_seconds, int processors) {
    next_ = start + cpu_seconds / (fraction_ * processors);
  }
  /// Makes the work due at once, because the user waits for it.
  void renew() { next_ = 0; }

 private:
  double fraction_, next_ = 0;
};

}  // namespace tyndall
