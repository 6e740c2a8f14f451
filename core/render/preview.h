#pragma once
#include <cstdint>

/// How coarse the first picture after an edit is, so that it comes in time. Pure functions, so that they can be tested.
namespace tyndall {

/// Seconds that the first picture of an edit should take. A camera that moves has to look fluent: it gets the time of
/// one frame of a 60 Hz display, so that even on a busy machine its picture is there after two. A slider that is
/// dragged gets the time of two frames. A single change may take longer, because the user looks at the result. since:
/// seconds from the edit before; below 0.3 both count as one movement.
double picture_budget(bool only_camera, double since);

/// The step of a first picture, 1 to 8: it samples every step-th pixel in x and y, so that `pixels / step²` paths take
/// about `budget` seconds at `paths_per_second` (<= 0: unknown). before: the last answer, 0: none. It is kept while it
/// is at most 1.1 times too fine, and until a step that is 1.25 times coarser than the ideal one is finer; otherwise
/// the sharpness would flicker while something is dragged.
int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before);

/// The finest step with which a picture of so many pixels samples at most one of them for each pixel that is shown.
/// shown: <= 0: unknown, all are.
int step_of_shown(std::int64_t pixels, std::int64_t shown);

/// Every how many pixels, at most 8, a coarse clean view has one, so that it takes about a tenth of a second. 1:
/// none is needed, as a whole one takes at most 40 ms. paths_per_second: <= 0: unknown; filter_seconds: a pixel takes.
int coarse_clean_step(std::int64_t pixels, double paths_per_second, double filter_seconds);

/// What the renderer has learnt from the first pictures of earlier edits, and what follows for the next edit.
class FirstPictures {
 public:
  /// Every how many pixels the first picture of an edit samples. budget: see picture_budget; shown: see step_of_shown.
  int step_for(std::int64_t pixels, double budget, std::int64_t shown = 0);
  /// A pass of one sample a pixel had that speed. Such passes are slower than longer ones, so only they tell how long
  /// the next edit's first pass takes.
  void note_pass(double paths_per_second);
  /// It took that long to make a picture from the film.
  void note_drawing(double seconds) { drawing_seconds_ = seconds; }
  /// A first picture was on the screen so long after it had been made. The whole time from the edit to the screen is
  /// kept to 1.6 times the budget.
  void note_showing(double seconds);
  /// By the passes noted; 0: unknown.
  double paths_per_second() const { return paths_per_second_; }

 private:
  double paths_per_second_ = 0;  ///< 0: unknown
  double drawing_seconds_ = 0, showing_seconds_ = 0;
  int step_ = 0;
};

}  // namespace tyndall
