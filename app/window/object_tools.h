#pragma once
#include "app/window/edit/arrange.h"
#include "app/window/edit/object_list.h"
#include "app/window/handles/handles.h"
#include "app/window/panels/panels.h"
#include "app/window/session.h"
#include "app/window/tools/pointer.h"

/// What the user does to objects: selecting, moving, adding, duplicating, deleting.
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

}  // namespace tyndall
