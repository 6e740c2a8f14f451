#pragma once
#include <string>

namespace tyndall {

/// Text that gives our camera the constructor that a reader's has instead of the fourth edition's public members: with
/// an image width among its parameters, all of which have names that our camera knows. `code` is free of comments; "":
/// it has no such constructor.
std::string camera_constructor(const std::string& code);

}  // namespace tyndall
