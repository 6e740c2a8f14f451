#include "app/window/system/shortcuts.h"

namespace tyndall {
namespace {

// GLFW's numbers for keys that are no characters.
constexpr int key_escape = 256, key_tab = 258, key_home = 268, key_f1 = 290, key_f11 = 300, key_space = 32;

struct Shortcut {
  int key;
  bool control, shift;
  Action action;
};

constexpr Shortcut shortcuts[] = {{key_f1, false, false, Action::help},
                                  {'H', false, false, Action::help},
                                  {key_escape, false, false, Action::deselect},
                                  {'F', false, false, Action::frame},
                                  {key_home, false, false, Action::reset_camera},
                                  {key_space, false, false, Action::pause},
                                  {'R', false, false, Action::restart},
                                  {'Z', true, false, Action::undo},
                                  {'Z', true, true, Action::redo},
                                  {'Y', true, false, Action::redo},
                                  {'S', true, false, Action::save},
                                  {'S', true, true, Action::save_as},
                                  {'P', true, false, Action::snapshot},
                                  {'1', false, false, Action::view_beauty},
                                  {'2', false, false, Action::view_albedo},
                                  {'3', false, false, Action::view_normal},
                                  {'4', false, false, Action::view_depth},
                                  {'5', false, false, Action::view_noise},
                                  {'6', false, false, Action::view_samples},
                                  {'7', false, false, Action::view_cost},
                                  {'8', false, false, Action::view_error},
                                  {'9', false, false, Action::view_flip},
                                  {key_tab, false, false, Action::panels},
                                  {key_f11, false, false, Action::full_screen},
                                  {'Q', true, false, Action::quit}};

constexpr HelpLine lines[] = {{"Left drag", "orbit"},
                              {"Middle drag", "pan"},
                              {"Right drag, wheel", "nearer, farther"},
                              {"Ctrl + wheel", "field of view"},
                              {"W A S D Q E", "fly; with Shift faster"},
                              {"Click", "select the object under the cursor"},
                              {"Esc", "deselect"},
                              {"Shift + click", "focus on that point"},
                              {"Ctrl + Shift + click", "focus, the blur keeps its look"},
                              {"F, Home", "frame the selection, reset the camera"},
                              {"Space, R", "pause or go on, start over"},
                              {"Ctrl + Z, Ctrl + Shift + Z", "undo, redo"},
                              {"Ctrl + S, Ctrl + Shift + S", "save the scene, save as"},
                              {"Ctrl + P", "snapshot: PNG and EXR, numbered"},
                              {"1 … 7", "views: beauty, albedo, normal, depth, noise, samples, cost"},
                              {"8, 9", "error and FLIP against the reference or the other half"},
                              {"Tab, F11", "hide the panels, full screen"},
                              {"Drop a file", "open a scene or a snapshot; another image: the reference"},
                              {"Numbers", "drag sideways, or click and type; Shift: finer"},
                              {"F1, H", "this table"}};

}  // namespace

std::optional<Action> action_of(int key, Modifiers modifiers) {
  if (modifiers.alt) return {};
  for (const Shortcut& shortcut : shortcuts)
    if (shortcut.key == key && shortcut.control == modifiers.control && shortcut.shift == modifiers.shift)
      return shortcut.action;
  return {};
}

std::optional<FlyKey> fly_key(int key) {
  switch (key) {
    case 'D':
      return FlyKey{0, 1};
    case 'A':
      return FlyKey{0, -1};
    case 'E':
      return FlyKey{1, 1};
    case 'Q':
      return FlyKey{1, -1};
    case 'W':
      return FlyKey{2, 1};
    case 'S':
      return FlyKey{2, -1};
    default:
      return {};
  }
}

std::span<const HelpLine> help_lines() { return lines; }

}  // namespace tyndall
