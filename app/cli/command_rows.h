#pragma once
#include "app/cli/requests.h"

#include <vector>

/// The commands, a row each.
namespace tyndall {

/// Options that stand below one heading of a help.
struct OptionGroup {
  const char* heading;  ///< "": no help lists them
  /// Long names as option_row() knows them; {display} and {render}: those of fields().
  const char* options;
};

struct CommandRow {
  const char* name;
  const char* summary;
  const char* usage;     ///< what follows "tyndall"
  const char* about;     ///< before the options in the help
  const char* examples;  ///< and after them
  std::vector<OptionGroup> groups;
  void (*finish)(CommandRequest&);  ///< looks at the options as a whole; throws UsageError
  int (*run)(const CommandRequest&);
};

const std::vector<CommandRow>& command_rows();

}  // namespace tyndall
