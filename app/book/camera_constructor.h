#pragma once
#include <string>

namespace tyndall {

/// Text that gives our camera the constructor that a reader's has instead of the fourth edition's public members: with
/// an image width among its parameters, all of which have names that our camera knows. `code` is free of comments; "":
/// it has no such constructor.
std::string camera_constructor(const std::string& code);

/// Text that gives our camera a member of the reader's by another name for one of ours: "double& ascpect_ratio =
/// aspect_ratio;". camera: the text of the reader's class. "": it has no such member, or one whose meaning is not
/// clear.
std::string camera_alias(const std::string& camera, const std::string& name);

/// Text that gives the members of our camera the values that those of the reader's have from the start, where these
/// are plain numbers: "double vfov = 20;". "": none are.
std::string camera_defaults(const std::string& code);

}  // namespace tyndall
