#include "app/window/commands.h"

namespace tyndall {

/// None: a window of the system has no address. The page in browsers has a file of its own in the place of this one.
std::vector<Command> Commands::table_of_page() { return {}; }

}  // namespace tyndall
