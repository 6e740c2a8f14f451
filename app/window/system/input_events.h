#pragma once
#include <filesystem>
#include <vector>

/// What the user did between two drawings, with keys and mouse.
namespace tyndall {

/// Keys that are held while another one is pressed.
struct Modifiers {
  bool control = false, shift = false, alt = false;
};

struct KeyPress {
  int key = 0;  ///< GLFW's number; letters by what is printed on the user's keyboard
  Modifiers modifiers;
  bool typing = false;    ///< a control took the keyboard when it was pressed
  char character = '\0';  ///< the ASCII character that was typed, in a press of its own after that of the key, key 0
};

/// What the user did since this was last taken.
struct InputEvents {
  bool any = false;  ///< something happened that may change what is drawn
  double first = 0;  ///< clock second at which the oldest event of keys or mouse came; 0: there was none
  std::vector<KeyPress> keys;
  std::vector<std::filesystem::path> dropped;  ///< files
};

/// The mouse as one drawing of the window finds it. Places are in window units, y down; the buttons are left, right,
/// middle.
struct Mouse {
  float x = 0, y = 0;
  float dx = 0, dy = 0;  ///< how far it went since the last drawing
  float wheel = 0;       ///< notches turned since the last drawing, positive: away from the user
  bool clicked[3] = {};  ///< pressed since the last drawing, and maybe released again
  bool down[3] = {};
  float pressed_x[3] = {}, pressed_y[3] = {};  ///< where each button went down last
  bool control = false, shift = false, alt = false;
  bool taken = false;   ///< a control of the panels or a dialog has it
  bool typing = false;  ///< a control has the keyboard

  bool any_down() const { return down[0] || down[1] || down[2]; }
};

/// What Dear ImGui knows of the mouse. Within one of its frames.
Mouse read_mouse();

}  // namespace tyndall
