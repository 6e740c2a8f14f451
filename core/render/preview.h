#pragma once
#include <cstdint>

/// How coarse the first picture after an edit is, so that it comes in time. Pure functions, so that they can be tested.
namespace tyndall {

/// Seconds that the first picture of an edit should take. A camera that moves has to look fluent: it gets the time of
/// one frame of a 60 Hz display, so that even on a busy machine its picture is there after two. A slider that is
/// dragged gets the time of two frames. A single change may take longer, because the user looks at the result. since:
/// seconds from the edit before; below 0.3 both count as one movement.
double picture_budget(bool only_camera, double since);

/// The step of a first picture, 8, 4, 2 or 1: it samples every step-th pixel in x and y, so that `pixels / step²` paths
/// take about `budget` seconds at `paths_per_second` (<= 0: unknown). before: the last answer. It is kept as long as
/// the ideal step is at most 1.1 times coarser or 1.4 times finer; otherwise the sharpness would flicker while
/// something is dragged.
int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before);

/// What the renderer has learnt from the first pictures of earlier edits, and what follows for the next edit.
class FirstPictures {
 public:
  /// Every how many pixels the first picture of an edit samples. budget: see picture_budget.
  int step_for(std::int64_t pixels, double budget);
  /// A pass of one sample a pixel had that speed. Such passes are slower than longer ones, so only they tell how long
  /// the next edit's first pass takes.
  void note_pass(double paths_per_second);
  /// It took that long to make a picture from the film.
  void note_drawing(double seconds) { drawing_seconds_ = seconds; }

 private:
  double paths_per_second_ = 0;  ///< 0: unknown
  double drawing_seconds_ = 0;
  int step_ = 1;
};

}  // namespace tyndall
