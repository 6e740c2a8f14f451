#pragma once
#include "app/cli/requests.h"
#include "app/text/values.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// What Tyndall's commands add to CLI11: values that are read by functions which say what they expected, so that every
/// refusal reads alike ("--size: found "8", expected WIDTHxHEIGHT ..."), and a usage line of our own.
namespace tyndall {

/// Takes the text of a value; throws UsageError `found "X", expected Y`.
using Reader = std::function<void(const std::string&)>;

/// Columns that the help of an option has beside its name.
inline constexpr std::size_t help_width = 66;

/// A command. usage: its name, then what follows it, as the help shows it; about, examples: text before and after the
/// options. Of an option that is given several times the last counts, unless it says otherwise.
std::unique_ptr<CLI::App> new_command(const std::string& usage, const std::string& about,
                                      const std::string& examples = "");

/// How often an option may be given: a flag takes no value, of `once` the last value counts.
enum class Takes { flag, once, each };

/// An option, or without dashes in its names an argument. names: "-t,--threads"; unit: what the help calls the value;
/// choices: the values that it takes, where they have names, for shells that complete them.
void add_option(CLI::App& app, const std::string& names, const std::string& unit, const std::string& help, Reader read,
                Takes takes = Takes::once, const std::vector<std::string>& choices = {});

/// Reads the words after the command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<PrintCommand> parse(CLI::App& app, std::vector<std::string> arguments);

}  // namespace tyndall
