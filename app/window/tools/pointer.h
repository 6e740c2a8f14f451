#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/layout.h"
#include "app/window/tools/projection.h"
#include "core/render/renderer.h"
#include "core/scene/scene.h"

/// This room turns mouse and keys into edits of the scene: it moves the camera and selects objects.
namespace tyndall {

/// The button of a click.
enum class PressedButton { none, left, right, middle };

/// The mouse in the picture: a left drag orbits, a middle drag pans, a right drag or the wheel dollies, Ctrl + wheel
/// opens the field of view. A press that does not move is a click.
class PointerTool {
 public:
  /// To be called in each drawing; changes the camera. free: no dialog waits for an answer. scale: window units per
  /// unit of the design. Returns the button that was clicked, on the picture or beside it.
  PressedButton update(const Mouse& mouse, const Layout& layout, float scale, bool free, double now, Camera& camera);

  /// Whether a button is down that was pressed in the picture's area.
  bool is_pressed() const { return button_ >= 0; }
  /// Whether the wheel turns over the picture or did so less than half a second ago: what it does is then one edit.
  bool is_turning(const Mouse& mouse, const Layout& layout, double now) const {
    return (mouse.wheel != 0 && is_over(mouse, layout)) || now < wheel_time_ + 0.5;
  }

 private:
  static bool is_over(const Mouse& mouse, const Layout& layout) {
    return !mouse.taken && layout.area.contains(mouse.x, mouse.y);
  }
  void drag(const Layout& layout, double dx, double dy, Camera& camera) const;

  int button_ = -1;  ///< -1: nothing is pressed
  bool moved_ = false;
  double wheel_time_ = -1;
};

/// A click on a point inside the picture.
struct PictureClick {
  ImagePoint at;
  int x = 0, y = 0;  ///< the pixel
};
/// The point of the picture under a place of the window that is within `image`. width, height: the picture's pixels.
PictureClick click_at(const Rect& image, float mouse_x, float mouse_y, int width, int height);

/// What a click selects. pick: the object that is seen at that place. again: the click before was at the same place;
/// then what lies behind the present selection there is selected, fog before the rest, and after the last one the first
/// again. Where nothing is seen, the fog that is nearest.
ObjectPath clicked_object(const Scene& scene, const Renderer::Pick& pick, ImagePoint at, const ObjectPath& selected,
                          bool again);

/// Remembers where the last click was.
class ClickPlace {
 public:
  /// Whether the click before was within a few units of the design of this one, while the camera was the same.
  bool again(float x, float y, float scale, const Camera& camera);

 private:
  float x_ = -1e9f, y_ = -1e9f;
  Camera camera_;
};

}  // namespace tyndall
