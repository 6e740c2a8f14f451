#pragma once
#include <functional>
#include <string>

/// A display that goes away.
namespace tyndall {

/// From now on the program says so in one line and ends with exit code 3 when the X server goes away, instead of the X
/// library's words and exit code 1. Nothing happens where no X library is loaded. Call after the window was opened.
/// before_end: called first, from whichever thread has noticed it; must not use the display; may be empty. What it
/// returns is said in a line of its own, unless it is "".
void end_when_display_is_lost(std::function<std::string()> before_end);

}  // namespace tyndall
