#pragma once
#include "app/window/actions/actions.h"
#include "app/window/panels/widgets.h"

#include <optional>
#include <string>
#include <vector>

/// This room holds what opens over the picture to choose from: menus and the palette of actions.
namespace tyndall {

/// A line of a menu.
struct MenuItem {
  std::string name;  ///< in the log: "menu.duplicate"
  std::string label;
  std::string key;         ///< shown on the right: "Ctrl + D"
  std::string why_not;     ///< not "": it cannot be chosen, and why
  bool separated = false;  ///< a line above it
  Request request{};
};

/// A list of items at a place of the window, from which one is chosen by a click, or by the arrow keys and Enter.
class Menu {
 public:
  void open(float x, float y, std::string title, std::vector<MenuItem> items);
  void close() { items_.clear(); }
  bool is_open() const { return !items_.empty(); }

  /// Up and down move the mark, Enter chooses; key: GLFW's number. Returns whether it was meant for the menu.
  bool take_key(int key);
  /// Draws it; it closes by a click beside it or when something was chosen. Returns what that asks for.
  std::optional<Request> draw(Ui& ui, const Rect& area);

 private:
  void move_mark(int by);

  std::vector<MenuItem> items_;
  std::string title_;
  float x_ = 0, y_ = 0;
  int mark_ = -1, chosen_ = -1;
  bool fresh_ = false;
};

}  // namespace tyndall
