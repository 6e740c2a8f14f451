#pragma once
#include "app/window/system/input_events.h"
#include "app/window/system/ui_log.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

/// One list of all that can be asked for. Keys, menus, the palette, panels and the help table are filled from it.
namespace tyndall {

/// What the window can be asked for.
enum class Action {
  deselect,
  frame,
  reset_camera,
  pause,
  restart,
  undo,
  redo,
  open,
  save,
  save_as,
  snapshot,
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
  play,
  key_cameras,
  add_sphere,  // these in the order of Addition
  add_hollow_sphere,
  add_box,
  add_quad,
  add_triangle,
  add_disk,
  add_light,
  add_medium,
  // From here on none is in actions(); most have an argument.
  view,              ///< number: see views.h
  section,           ///< of the column; number: see column_tabs()
  row,               ///< of the column; number: see row_entries()
  scene,             ///< opens what load_scene takes: text
  clean_as,          ///< number: 0 off, 1 on, 2 beside the raw picture
  render_at,         ///< number: 0 as many pixels as the file says, 1 as many as the window shows
  threads,           ///< number: how many render
  keep_half,         ///< of the split view; number: 0 the left one, A, 1 the right one, B
  take_file,         ///< that another program has changed; number: 0 keep the edits, 1 take it
  open_file,         ///< a scene, a picture of one, or a reference: text
  save_to,           ///< text: its file, which is replaced if it exists
  save_named,        ///< text: its file, as the user has typed it
  save_unsaved,      ///< goes to the edits that no file has, saves them and closes the window
  discard_unsaved,   ///< closes the window
  open_reference,    ///< text: its file
  render_reference,  ///< in the background
  drop_reference,
  sky_of_file  ///< text: its file
};

/// Whether the action adds an object.
constexpr bool is_addition(Action action) { return action >= Action::add_sphere && action <= Action::add_medium; }

/// A key with the modifiers that must be held with it, and no others. code: GLFW's number, for letters and digits their
/// capital ASCII; 0: no key.
struct Key {
  int code = 0;
  bool control = false, shift = false;
};

/// A line of the list of actions.
struct ActionEntry {
  Action action;
  const char* name;
  const char* other_words;  ///< by which the palette finds it, too, separated by ", "
  Key key, other_key{};
  const char* help = "";             ///< follows the name in the help table; "": the name says enough
  bool on_line_of_previous = false;  ///< the help table shows it in the line of the entry before
};

std::span<const ActionEntry> actions();
/// The entry of an action; null for those that are not in actions().
const ActionEntry* find_action(Action action);

/// What the window is asked for: an action, with its argument where it has one.
struct Request {
  Action action = Action::help;
  int number = 0;
  std::string text{};
  bool operator==(const Request&) const = default;
};

/// What a key asks for; nothing for keys that have no action.
std::optional<Request> request_of_key(int key, Modifiers modifiers);

/// "Ctrl + Shift + Z"; "": no key.
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
