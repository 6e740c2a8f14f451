#pragma once
#include "app/cli/requests.h"
#include "app/manual/page.h"

#include <string>
#include <vector>

/// The options of all commands, and the commands, a row each.
namespace tyndall {

/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);

const std::vector<CommandRow>& command_rows();

/// The commands with the options that their groups name.
std::vector<CommandRow> with_options(std::vector<CommandRow> commands);

/// The curve of a chart that --method describes, NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text);

}  // namespace tyndall
