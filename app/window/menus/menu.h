#pragma once
#include "app/window/panels/widgets.h"

#include <optional>
#include <string>
#include <vector>

/// This room holds what opens over the picture to choose from: menus and the palette of actions.
namespace tyndall {

/// A line of a menu.
struct MenuItem {
  std::string command;     ///< that it asks for; its label, too
  std::string key;         ///< shown on the right: "Ctrl + D"
  std::string why_not;     ///< not "": it cannot be chosen, and why
  bool separated = false;  ///< a line above it
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
  std::vector<MenuItem> items_;
  std::string title_;
  float x_ = 0, y_ = 0;
  int mark_ = -1, chosen_ = -1;
  bool fresh_ = false;
};

/// A line of the palette.
struct PaletteItem {
  std::string label;  ///< "save as"
  std::string key;    ///< "Ctrl + Shift + S"; "": it has none
  std::string also;   ///< other words by which it is found, separated by ", "
  Request request{};
};

/// The numbers of the items that the text may mean, the likeliest first: those whose name (of "view: depth" the part
/// behind the colon, too) or one of whose other words is the text; whose name begins with it; whose name holds all its
/// words in any order; whose name or other words do. Capitals, spaces and signs make no difference: "fullscreen",
/// "Full-screen" and "full screen" are one.
std::vector<int> matching_items(const std::vector<PaletteItem>& items, const std::string& text);

/// A box over the picture in which the user types part of an action's name and chooses one with the arrow keys and
/// Enter, or by a click.
class Palette {
 public:
  void open(std::vector<PaletteItem> items);
  void close() { items_.clear(); }
  bool is_open() const { return !items_.empty(); }

  /// Up and down move the mark; key: GLFW's number. Returns whether it was meant for the palette.
  bool take_key(int key);
  /// Draws it; it closes by a click beside it or when something was chosen. Returns what that asks for.
  std::optional<Request> draw(Ui& ui, const Rect& area);

 private:
  bool draw_text(Ui& ui);

  std::vector<PaletteItem> items_;
  char text_[64] = {};
  int mark_ = 0;
  bool fresh_ = false, moved_ = false;
  bool active_ = false;   ///< the text has the keyboard
  bool resumes_ = false;  ///< typing goes on where it was: it was ended by Enter or a click
};

}  // namespace tyndall
