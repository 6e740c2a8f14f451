#pragma once
#include "app/cli/requests.h"
#include "app/cli/setting_options.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// The options of all commands, and the commands, a row each.
namespace tyndall {

/// What an option does with its text. Throws UsageError `found "X", expected Y`, before which the option's name is put.
struct Taker {
  std::function<void(CommandRequest&, const std::string&)> take;
  Takes takes = Takes::once;
  std::vector<std::string> choices{};  ///< the values that it takes, where they have names
};

struct OptionRow {
  /// Where memory runs out within a list of rows, GCC 12 destroys members of an aggregate that were not made yet.
  OptionRow(const char* n, const char* u, Taker t, std::string h, std::string_view c = "")
      : names(n), unit(u), taker(std::move(t)), help(std::move(h)), commands(c) {}

  const char* names;  ///< "-t,--threads"
  const char* unit;   ///< what the help calls the value; "": it takes none
  Taker taker;
  std::string help;
  std::string_view commands;  ///< those that it is an option of in this way; "": of all that name it
};

/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);

/// The curve of a chart that --method describes, NAME=FLAGS.
CommandRequest read_method(const std::string& text);

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
  int (*run)(const CommandRequest&);
};

const std::vector<CommandRow>& command_rows();

}  // namespace tyndall
