#pragma once
#include <cstdint>

/// How coarse the first picture after an edit is, so that it comes in time. Pure functions, so that they can be tested.
namespace tyndall {

/// Seconds that the first picture of an edit should take. A moving camera has to look fluent: it gets the time of one
/// frame of a 60 Hz display, so that even a busy machine shows the picture after two frames. A dragged slider gets the
/// time of two frames. A single change may take longer, because the user looks at the result. since: seconds since the
/// previous edit; below 0.3 both count as one movement.
double picture_budget(bool only_camera, double since);

/// The step of a first picture, 1 to 8: it samples every step-th pixel in x and y, so that `pixels / step²` paths take
/// about `budget` seconds at `paths_per_second` (<= 0: unknown). before: the previous result, 0: none. It is kept while
/// the ideal step is at most 1.1 times as coarse and 1.25 times the ideal step, rounded up, is no finer; otherwise the
/// sharpness would flicker during a drag.
int preview_step(std::int64_t pixels, double paths_per_second, double budget, int before);

/// The finest step with which a picture of `pixels` pixels samples at most one of them for each pixel of the screen.
/// shown: screen pixels that the picture covers; <= 0: unknown, as many as the picture has.
int step_of_shown(std::int64_t pixels, std::int64_t shown);

/// The step of a coarse clean view, at most 8, with which it takes about a tenth of a second. 1: none is needed,
/// because a whole one takes at most 40 ms. paths_per_second: <= 0: unknown; filter_seconds: for one pixel.
int coarse_clean_step(std::int64_t pixels, double paths_per_second, double filter_seconds);

/// What the renderer knows from the first pictures of earlier edits, and the step that follows for the next edit.
class FirstPictures {
 public:
  /// The step of the first picture of an edit. budget: see picture_budget; shown: see step_of_shown.
  int step_for(std::int64_t pixels, double budget, std::int64_t shown = 0);
  /// Reports the speed of a pass of one sample a pixel. Such passes are slower than longer ones, so only they predict
  /// the time of the next edit's first pass.
  void note_pass(double paths_per_second);
  /// Reports the time that making a picture from the film took.
  void note_drawing(double seconds) { drawing_seconds_ = seconds; }
  /// Reports the time from a first picture's completion to the screen. The whole time from the edit to the screen is
  /// kept to 1.6 times the budget.
  void note_showing(double seconds);
  /// Estimated from the reported passes; 0: unknown.
  double paths_per_second() const { return paths_per_second_; }

 private:
  double paths_per_second_ = 0;  ///< 0: unknown
  double drawing_seconds_ = 0, showing_seconds_ = 0;
  int step_ = 0;
};

}  // namespace tyndall
