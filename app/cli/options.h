#pragma once
#include "app/cli/requests.h"

#include <string>
#include <vector>

/// The command line as a whole: which command, and its request.
namespace tyndall {

/// arguments[0] is what follows the program's name. Throws UsageError. Of files only the existence is looked at, to
/// tell a misspelt command from a scene's file.
Command read_command(const std::vector<std::string>& arguments);

}  // namespace tyndall
