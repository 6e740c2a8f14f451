#pragma once
#include "app/window/edit/arrange.h"
#include "app/window/edit/object_list.h"
#include "app/window/handles/handles.h"
#include "app/window/inspector/inspector.h"
#include "app/window/panels/panels.h"
#include "app/window/picture/display.h"
#include "app/window/session.h"
#include "app/window/tools/pointer.h"

#include <functional>

/// What the user does in the picture: selecting, moving, adding, duplicating and deleting objects; and looking closer:
/// enlarging it, asking what a pixel is, refining a rectangle first.
namespace tyndall {

/// Mouse and keys on the objects in the picture.
class ObjectTools {
 public:
  /// The arguments belong to the window and must outlive this.
  ObjectTools(Session& session, PanelState& panels) : session_(session), panels_(panels) {}

  /// The next object is added where the mouse is now, or in the middle of the picture if it is not over it. Called
  /// when a list of actions opens, whose lines may lie elsewhere.
  void look_under_mouse();
  void add(const Addition& what);
  // Of what is selected, which must be something.
  void grab();  ///< it moves with the mouse from now on
  void duplicate();
  void remove();
  void own_material();
  /// A key or character that a movement waits for. Returns whether it was meant for it.
  bool take_press(const KeyPress& press);
  /// These are selected from now on, and nothing else.
  void select_all(const ObjectPaths& paths);
  /// Takes back what is being moved. Returns whether there was anything.
  bool escape();

  /// The mouse in the picture, before the tool that orbits; moves objects of the panels' scene. free: nothing else has
  /// the mouse. Returns whether this has it.
  bool use_mouse(const Mouse& mouse, float scale, bool free);
  /// A click of the left button selects or focuses; for one of the right button it returns true: it asks for the menu.
  bool click(const Mouse& mouse, PressedButton button);

  /// Draws outline and handles.
  void draw(Ui& ui);
  const Mouse& mouse() const { return mouse_; }
  /// Whether something is being moved: edits until its end are one step.
  bool active() const { return handles_.active(); }

 private:
  void select(const PictureClick& click, const Renderer::Pick& pick, bool more, bool again);
  void focus_on(const Renderer::Pick& pick, bool keep_blur);
  PictureClick click_in(const Scene& scene, float x, float y) const;
  ObjectPaths selected() const { return all_selected(panels_); }

  Session& session_;
  PanelState& panels_;
  HandleTool handles_;
  ClickPlace clicks_;
  Mouse mouse_;  ///< as the last drawing found it
  float scale_ = 1;
  Spot spot_;  ///< where the next object is added
};

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
