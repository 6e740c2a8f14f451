#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// The options and the commands, a row each, and what the program can tell about itself by them beside --help: a page
/// for man, completion for shells; and what it was built from.
namespace tyndall {

struct CommandRequest;  // see app/cli/requests.h

/// What an option does with its text; a flag gets "on". Throws UsageError `found "X", expected Y`, before which the
/// option's name is put.
struct Taker {
  std::function<void(CommandRequest&, const std::string&)> take;
  std::vector<std::string> choices{};  ///< the values that it takes, where they have names, for shells
  bool each = false;                   ///< whether all values count that an option is given, not the last one alone
};

/// An option of commands, or without dashes in its names an argument.
struct OptionRow {
  /// Where memory runs out within a list of rows, GCC 12 destroys members of an aggregate that were not made yet.
  OptionRow(std::string n, std::string u, Taker t, std::string h, std::string_view c = "", const char* below = "")
      : names(std::move(n)), unit(std::move(u)), taker(std::move(t)), help(std::move(h)), commands(c), heading(below) {}

  std::string names;  ///< "-t,--threads", "SCENE"
  std::string unit;   ///< what the help calls the value; "": it takes none, as a flag; " ": the name says it
  Taker taker;
  std::string help;           ///< lines, with \n between them
  std::string_view commands;  ///< those that it is an option of in this way; "": of all that name it
  std::string heading;        ///< that it stands below in a help; "": no help lists it
};

/// Options that stand below one heading of a help.
struct OptionGroup {
  const char* heading;  ///< "": no help lists them
  /// Long names as option_row() knows them, with spaces between; {display} and {render}: those of fields().
  const char* options;
};

/// One command. All texts are lines with \n between them.
struct CommandRow {
  std::string usage, summary;   ///< what follows "tyndall", and what the command does in a few words
  std::string about, examples;  ///< before and after the options in the help
  std::vector<OptionGroup> groups;
  int (*run)(const CommandRequest&);
  std::vector<OptionRow> arguments{}, options{};  ///< those that the groups name

  std::string name() const { return usage.substr(0, usage.find(' ')); }
};

/// The page "tyndall.1" in the language of man(7).
std::string man_page(const std::vector<CommandRow>& commands);

/// Scripts that complete commands, options, named values, files and built-in scenes.
std::string bash_completion(const std::vector<CommandRow>& commands);
std::string zsh_completion(const std::vector<CommandRow>& commands);
std::string fish_completion(const std::vector<CommandRow>& commands);

/// Lines that name the version, the compiler, the instruction sets and the libraries.
std::string version_text();

}  // namespace tyndall
