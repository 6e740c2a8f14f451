#pragma once
#include <optional>
#include <span>
#include <string>

/// Keys to actions, and the table that F1 shows. Keys are GLFW's numbers (letters and digits are their capital ASCII).
namespace tyndall {

enum class Action {
  help,
  deselect,
  frame,
  reset_camera,
  pause,
  restart,
  undo,
  redo,
  save,
  save_as,
  snapshot,
  view_beauty,
  view_albedo,
  view_normal,
  view_depth,
  view_noise,
  view_samples,
  view_cost,
  view_error,
  view_flip,
  panels,
  full_screen,
  quit
};

struct Modifiers {
  bool control = false, shift = false, alt = false;
};

/// The action of a key; nothing for keys that have none.
std::optional<Action> action_of(int key, Modifiers modifiers);

/// A direction of flight while a key is held: axis 0 right, 1 up, 2 forward; sign 1 or -1.
struct FlyKey {
  int axis = 0, sign = 0;
};
std::optional<FlyKey> fly_key(int key);

/// One line of the help table.
struct HelpLine {
  const char* input;
  const char* action;
};
std::span<const HelpLine> help_lines();

}  // namespace tyndall
