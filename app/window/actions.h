#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/ui_log.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

/// One list of all that keys do. Keys, menus and the help table are loops over it.
namespace tyndall {

/// What a key can ask for.
enum class Action {
  deselect,
  frame,
  reset_camera,
  pause,
  restart,
  undo,
  redo,
  open,
  scene,  ///< opens one that is listed: which one follows
  save,
  save_as,
  snapshot,
  view,
  clean,
  clean_beside_raw,
  panels,
  full_screen,
  quit,
  help,
  palette,
  larger_text,
  smaller_text,
  usual_text,
  other_theme,
  section,  ///< of the column: which one follows
  row,      ///< of the column: which one follows
  split,
  reference,
  export_chart,
  grab,
  add,
  duplicate,
  remove,
  rename,
  own_material,
  inspect,
  replay,
  actual_size,
  refine_first,
  store_camera,
  next_camera,
  add_sphere,  // these in the order of Addition
  add_hollow_ball,
  add_box,
  add_quad,
  add_lamp,
  add_fog
};

/// Whether the action adds an object.
constexpr bool is_addition(Action action) { return action >= Action::add_sphere && action <= Action::add_fog; }

/// A key with the modifiers that must be held with it, and no others. code: GLFW's number, for letters and digits their
/// capital ASCII; 0: no key.
struct Key {
  int code = 0;
  bool control = false, shift = false;
};

/// A line of the list of actions. The keys, the help table and every menu are loops over this list.
struct ActionEntry {
  Action action;
  const char* name;
  Key key, other_key{};
  const char* help = "";             ///< follows the name in the help table; "": the name says enough
  bool on_line_of_previous = false;  ///< the help table shows it in the line of the entry before
};

/// All actions but views, scenes, sections and rows, which have lists of their own.
std::span<const ActionEntry> actions();
/// Words other than an action's name by which the palette finds it, too, separated by ", "; "": none.
const char* other_words_for(Action action);
/// The entry of an action; null for those that have lists of their own.
const ActionEntry* find_action(Action action);

/// An action, and for those that have lists of their own which: the number of the view, see views.h, of the tab, see
/// column_tabs(), of the row, see row_entries(), or of the scene.
struct KeyCommand {
  Action action = Action::help;
  int which = 0;
  bool operator==(const KeyCommand&) const = default;
};

/// What a key asks for; nothing for keys that have no action.
std::optional<KeyCommand> command_of_key(int key, Modifiers modifiers);

/// "Ctrl + Shift + Z".
std::string text_of(const Key& key);

/// Writes an "action" line for each action into the log.
void log_actions(UiLog& log);

/// One line of the help table.
struct HelpLine {
  std::string input, effect;
};
/// The help table: what the mouse does, then the keys.
std::vector<HelpLine> help_lines();

}  // namespace tyndall
