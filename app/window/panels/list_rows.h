#pragma once
#include "app/window/panels/widgets.h"

/// Lists in the column: of objects, of scenes.
namespace tyndall {

/// A line of a list, with a grey word on the right. Returns whether it was clicked.
bool list_line(Ui& ui, const std::string& name, const std::string& label, const std::string& note, bool on);
/// Begins a list that is `maximum` lines high at most, and scrolls when it has more; see scroll_list(). line: the
/// height of one, in window units.
bool begin_list(Ui& ui, const char* name, float line, std::size_t lines, std::size_t maximum);
void end_list();

}  // namespace tyndall
