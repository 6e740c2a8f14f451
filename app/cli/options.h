#pragma once
#include "app/cli/requests.h"

#include <string>
#include <vector>

namespace tyndall {

/// Reads the command line; arguments[0] is what follows the program's name. Throws UsageError. Reads no file but to see
/// whether a first argument that looks like a misspelt command is one.
Command read_command(const std::vector<std::string>& arguments);

}  // namespace tyndall
