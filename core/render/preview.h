#pragma once
#include <cstdint>

/// How the first pictures after an edit are paced. Pure decisions, so that they can be tested.
namespace tyndall {

/// Seconds that the first picture of an edit should take. A camera wants fluency and gets a frame of a 60 Hz display,
/// so that its picture is there in two of them on a busy machine too; a slider that is dragged gets two; a single
/// change is looked at. since: seconds from the edit before it; within 0.3 they are one movement.
double picture_budget(bool only_camera, double since);

/// Every how many pixels (8, 4, 2 or 1, in x and y) a first picture samples, so that `pixels / step²` paths take about
/// `budget` seconds at `paths_per_second` (<= 0: unknown). `before`: the last answer, kept while the ideal is at
/// most 1.1 times coarser or 1.4 times finer, or the picture's sharpness would flicker.
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
