#pragma once
#include "app/window/system/shortcuts.h"

#include <filesystem>
#include <vector>

namespace tyndall {

struct KeyPress {
  int key = 0;
  Modifiers modifiers;
  bool typing = false;  ///< a control took the keyboard when it was pressed
};

/// What came in since it was last taken.
struct InputEvents {
  bool any = false;  ///< anything that may change what is drawn
  std::vector<KeyPress> keys;
  std::vector<std::filesystem::path> dropped;
  bool rescaled = false;  ///< another density of the screen
};

}  // namespace tyndall
