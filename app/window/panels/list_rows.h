#pragma once
#include "app/window/panels/widgets.h"

#include <functional>

/// Lists in the column: of objects, of scenes; and the wheel of the mouse over them and over the column, which scrolls
/// itself.
namespace tyndall {

/// To be called at the end of the column's window: scrolls it unless a list did.
void scroll_column(Ui& ui);

/// A line of a list, with a grey word on the right. Returns whether it was clicked.
bool list_line(Ui& ui, const std::string& name, const std::string& label, const std::string& note, bool on);
/// A list of so many lines, `shown` of them seen at a time: when the mouse is over it, the wheel scrolls it, unless the
/// column was being scrolled a moment ago, or the list is at its end. line: the height of one, in window units; draw:
/// draws a line by its number, and is called for those that are seen; before: called within the list's window first.
void list(Ui& ui, const char* name, float line, std::size_t lines, std::size_t shown,
          const std::function<void(std::size_t)>& draw, const std::function<void()>& before = {});

}  // namespace tyndall
