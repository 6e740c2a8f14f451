#pragma once
#include "app/window/gallery/gallery.h"
#include "app/window/panels/widgets.h"
#include "core/scene/slots.h"

#include <optional>

/// This room holds the film in the window: the bar to play it and to go to a frame, and edits of keys.
namespace tyndall {

/// The scene with the values of that frame, and its keys. Throws ParseError.
Scene at_frame_with_keys(const Scene& scene, double frame);

/// Gives a value, as it is, a key at the frame. A scene without an animation gets one.
void add_key(Scene& scene, const Slot& slot, int frame);
/// Takes away the keys of a frame; without any left the animation goes.
void remove_keys(Scene& scene, int frame);
/// Whether a value has a key at that frame.
bool has_keys(const Scene& scene, int frame);
/// Gives the camera keys so that a film goes through the stored ones, two seconds from each to the next.
void key_cameras(Scene& scene, const CameraSlots& slots);

/// What the bar wants of the scene.
struct TimelineWish {
  std::optional<int> frame;  ///< go there
  bool remove = false;       ///< take the keys of the present frame away
};

/// The bar beneath the picture: play, the frame, and where keys are.
class Timeline {
 public:
  /// In window units; 0: the scene has no film.
  static float height(const Scene& scene, float scale);

  int frame() const { return frame_; }
  bool plays() const { return playing_; }
  /// Begins at the frame that is shown, or ends. now: seconds.
  void play_or_stop(double now);
  void stop() { playing_ = false; }

  /// Draws it. now: seconds; while it plays, frames come by it.
  TimelineWish draw(Ui& ui, const Rect& rect, const Scene& scene, double now);

 private:
  void draw_keys(Ui& ui, const Rect& track, const Animation& animation) const;

  int frame_ = 0;
  bool playing_ = false;
  double started_ = 0;  ///< when frame 0 would have been shown, seconds
};

}  // namespace tyndall
