#pragma once

/// Variables of the environment that say yes or no.
namespace tyndall {

/// Whether the variable is there and not empty, for those of other programs, such as NO_COLOR and DISPLAY.
bool is_set(const char* variable);

/// Whether a switch of ours is on: 1, yes, true or on; 0, no, false, off, empty or absent is off, in small letters or
/// capitals. Throws UsageError for anything else.
bool is_on(const char* variable);

}  // namespace tyndall
