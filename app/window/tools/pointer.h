#pragma once
#include "app/window/system/layout.h"
#include "app/window/system/mouse.h"
#include "app/window/tools/outline.h"
#include "core/render/renderer.h"
#include "core/scene/scene.h"

/// This room turns mouse and keys into edits of the scene: it moves the camera and selects objects.
namespace tyndall {

/// The mouse in the picture: a left drag orbits, a middle drag pans, a right drag or the wheel dollies, Ctrl + wheel
/// opens the field of view. A press that does not move is a click.
class PointerTool {
 public:
  /// To be called in each drawing; changes the camera. free: no dialog waits for an answer. scale: window units per
  /// unit of the design. Returns whether the left button was clicked, on the picture or beside it.
  bool update(const Mouse& mouse, const Layout& layout, float scale, bool free, double now, Camera& camera);

  /// Whether a button is down that was pressed in the picture's area.
  bool is_pressed() const { return button_ >= 0; }
  /// Whether the wheel was turned less than half a second ago: what it does is then one edit.
  bool is_turning(double now) const { return now < wheel_time_ + 0.5; }

 private:
  void turn_wheel(const Mouse& mouse, double now, Camera& camera);
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

/// What a click selects. pick: the object at that place. Fog is seen through: it is selected where nothing else is, or
/// by a second click.
ObjectPath clicked_object(const Scene& scene, const Renderer::Pick& pick, ImagePoint at, const ObjectPath& selected);

}  // namespace tyndall
