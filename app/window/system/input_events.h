#pragma once
#include <filesystem>
#include <vector>

/// What the user did between two drawings, apart from the mouse (mouse.h).
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

}  // namespace tyndall
