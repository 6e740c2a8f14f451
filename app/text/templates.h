#pragma once
#include <string>
#include <utility>
#include <vector>

namespace tyndall {

/// The text of a file in assets/templates, with a text in the place of each {{name}}, in the order in which these stand
/// there. Throws IoError if the file is not there, or lacks a name.
std::string from_template(const std::string& file, const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace tyndall
