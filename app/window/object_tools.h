#pragma once
#include "app/window/actions/actions.h"
#include "app/window/edit/linked_objects.h"
#include "app/window/edit/object_list.h"
#include "app/window/handles/handle_tool.h"
#include "app/window/menus/menu.h"
#include "app/window/panels/panels.h"
#include "app/window/session.h"
#include "app/window/system/pacing.h"
#include "app/window/tools/pointer.h"

/// What the user does to objects: selecting, moving, adding, duplicating, deleting, and the menus for it.
namespace tyndall {

/// Mouse and keys on the objects in the picture.
class ObjectTools {
 public:
  /// The arguments belong to the window and must outlive this.
  ObjectTools(Session& session, PanelState& panels, Gestures& gestures, Pacing& pacing)
      : session_(session), panels_(panels), gestures_(gestures), pacing_(pacing) {}

  /// The next object is added where the mouse is now, or in the middle of the picture if it is not over it. Called
  /// when a list of actions opens, whose lines may lie elsewhere.
  void look_under_mouse();
  /// Carries out an action on objects; what is no such action is left. Returns whether it was one.
  bool act(Action action);
  /// A key or character that a menu or a movement waits for. Returns whether it was meant for one.
  bool take_press(const KeyPress& press);
  /// These are selected from now on, and nothing else.
  void select_all(const ObjectPaths& paths);
  /// Closes the menu, or takes back what is being moved. Returns whether there was anything.
  bool escape();

  /// The mouse in the picture, before the tool that orbits; moves objects of the panels' scene. free: nothing else has
  /// the mouse. Returns whether this has it.
  bool use_mouse(const Mouse& mouse, const Layout& layout, float scale, bool free);
  /// A click of the left button selects or focuses; of the right button opens the menu.
  void click(const Layout& layout, const Mouse& mouse, PressedButton button);

  /// Draws outline, handles and menu, and does what was chosen.
  void draw(Ui& ui, const Layout& layout);
  /// Whether something is being moved: edits until its end are one step.
  bool active() const { return handles_.active(); }
  /// Whether keys belong to what is being moved.
  bool has_keys() const { return handles_.active() || menu_.is_open(); }
  /// Whether the menu is open, or was closed by this drawing: a click beside it does nothing else.
  bool shows_menu() const { return shows_menu_ || menu_.is_open(); }

 private:
  void select(const PictureClick& click, const Renderer::Pick& pick, bool more, bool again);
  void focus_on(const Renderer::Pick& pick, bool keep_blur);
  PictureClick click_in(const Scene& scene, const Rect& image, float x, float y) const;
  void open_menu(const std::string& title, std::span<const Action> actions);
  void add(Addition what);
  void duplicate();
  void remove();
  void own_material();
  ObjectPaths selected() const { return all_selected(panels_); }

  Session& session_;
  PanelState& panels_;
  Gestures& gestures_;
  Pacing& pacing_;
  HandleTool handles_;
  ClickPlace clicks_;
  Menu menu_;
  Mouse mouse_;    ///< as the last drawing found it
  Layout layout_;  ///< of the last drawing
  float scale_ = 1;
  Spot spot_;  ///< where the next object is added
  bool shows_menu_ = false;
};

}  // namespace tyndall
