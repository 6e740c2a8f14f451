#pragma once
#include "app/cli/requests.h"
#include "app/manual/page.h"

#include <optional>
#include <string>
#include <vector>

/// The options of all commands, and the commands, a row each; and how a command line is read by them.
namespace tyndall {

/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);

const std::vector<CommandRow>& command_rows();

/// The commands with the options that their groups name.
std::vector<CommandRow> with_options(std::vector<CommandRow> commands);

/// " (see tyndall render --help)".
std::string see_help(std::string_view command);

/// Reads what follows a command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<std::string> parse(const CommandRow& command, std::vector<std::string> arguments,
                                 CommandRequest& request);

/// The curve of a chart that --method describes, NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text);

}  // namespace tyndall
