#pragma once
#include "app/window/inspector/inspector.h"
#include "app/window/panels/panels.h"
#include "app/window/picture/display.h"
#include "app/window/session.h"
#include "app/window/tools/pointer.h"

#include <functional>

/// What the user does to look closer at the picture: enlarging it, asking what a pixel is, refining a rectangle first.
namespace tyndall {

/// Mouse and keys that look closer, and the cameras that were put aside. Only going to one of these changes the scene.
class PictureTools {
 public:
  /// The arguments belong to the window and must outlive this. wake: see JobQueue.
  PictureTools(Session& session, PanelState& panels, std::function<void()> wake)
      : inspector(std::move(wake)), session_(session), panels_(panels) {}

  void toggle_actual_size() { zoom_.toggle(mouse_.x, mouse_.y); }
  void find_path();          ///< why the pixel under the cursor is noisy
  void refine();             ///< begins to draw a rectangle, or gives one up
  void store_camera();       ///< puts the camera aside
  void look_through_next();  ///< of the cameras that were put aside
  /// Ends the innermost of what is shown. Returns whether there was anything.
  bool escape();

  /// Where the user has moved the picture to. layout.image: where all of it is shown; width, height: in pixels; dots:
  /// pixels of the screen in a window unit.
  Rect place(const Layout& layout, int width, int height, float dots) {
    return zoom_.place(layout.area, layout.image, width, height, dots);
  }
  /// Whether pixels of the picture are shown as squares.
  bool shows_pixels() const { return !zoom_.fits() && zoom_.dots_a_pixel() >= 1; }
  /// The mouse, before all other tools. free: nothing else has it. Returns whether this has it.
  bool use_mouse(const Mouse& mouse, bool free);
  /// Draws what is known over the picture.
  void draw(Ui& ui);

  Inspector inspector;

 private:
  bool drag_picture(const Mouse& mouse, bool free);
  std::string said_of_rectangle() const;
  void draw_zoom(Ui& ui, const Rect& visible) const;

  Session& session_;
  PanelState& panels_;
  ImageZoom zoom_;
  RectangleTool rectangle_;
  Mouse mouse_;      ///< as the last drawing found it
  int button_ = -1;  ///< that drags the picture; -1: none
};

}  // namespace tyndall
