#pragma once
#include <string>
#include <vector>

/// What the program can tell about itself beside --help: a page for man, completion for shells, what it was built from.
namespace tyndall {

/// One option of a command, as its --help shows it.
struct OptionPage {
  std::vector<std::string> names;    ///< with their dashes, the short one first; of an argument its name in capitals
  std::string group;                 ///< the heading that it stands below
  std::string unit;                  ///< what the help calls its value; "": it takes none
  std::vector<std::string> choices;  ///< the values that it takes, where they have names; else none
  std::string help;                  ///< lines, with \n between them
};

/// One command, as its --help shows it. All texts are lines with \n between them.
struct CommandPage {
  std::string name, summary;    ///< "render", and what it does in a few words
  std::string usage;            ///< what follows "tyndall"
  std::string about, examples;  ///< before and after the options
  std::vector<OptionPage> arguments, options;
};

/// The page "tyndall.1" in the language of man(7).
std::string man_page(const std::vector<CommandPage>& commands);

/// Scripts that complete commands, options, named values, files and built-in scenes.
std::string bash_completion(const std::vector<CommandPage>& commands);
std::string zsh_completion(const std::vector<CommandPage>& commands);
std::string fish_completion(const std::vector<CommandPage>& commands);

/// Lines that name the version, the compiler, the instruction sets and the libraries.
std::string version_text();

}  // namespace tyndall
