#include "app/cli/commands.h"
#include "app/cli/option_rows.h"
#include "app/cli/setting_options.h"
#include "app/text/standard_streams.h"
#include "core/base/text.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

/// Reads the command line.
namespace tyndall {
namespace {

using Text = const std::string&;
using Arguments = const std::vector<std::string>&;

void add_group(CLI::App& app, const OptionGroup& group, CommandRequest& request) {
  app.option_defaults()->group(group.heading);
  std::istringstream names(group.options);
  for (std::string name; names >> name;) {
    if (name == "{display}") {
      add_settings(app, request.scene.display);
    } else if (name == "{render}") {
      add_settings(app, request.scene.render, {"spp", request.command == "verify" ? "adaptive" : ""});
    } else {
      std::replace(name.begin(), name.end(), '_', ' ');
      const OptionRow& row = option_row(name, request.command);
      const auto take = [&](Text text) { row.taker.take(request, text); };
      add_option(app, row.names, row.unit, row.help, take, row.taker.takes, row.taker.choices);
    }
  }
}

Command read(const CommandRow& row, Arguments arguments) {
  CommandRequest request;
  request.command = row.name;
  request.arguments = arguments;
  if (request.command != "view") request.scene.what.clear();
  const auto app = new_command(row.usage, row.about, row.examples);
  for (const OptionGroup& group : row.groups) add_group(*app, group, request);
  if (auto help = parse(*app, arguments)) {
    help->page.summary = row.summary;
    return *help;
  }
  finish(row, request);
  return request;
}

std::string overview() {
  std::string text =
      "Tyndall: an interactive, progressive path tracer for glass, brushed metal and fog.\n"
      "Usage: tyndall [SCENE] | tyndall COMMAND [options]\n\nCommands:\n";
  for (const CommandRow& row : command_rows())
    text += "  " + std::string(row.name) + std::string(10 - std::string(row.name).size(), ' ') + row.summary + "\n";
  return text +
         "\nOptions:\n"
         "  -h, --help    show this text; 'tyndall COMMAND --help' shows that of a command\n"
         "  -V, --version show the version, the compiler, instruction sets and libraries\n"
         "  help man, help bash, help zsh, help fish: the manual's page; completion for a shell\n\n"
         "Exit codes: 0 done; 1 a check failed; 2 wrong usage or a scene that cannot be read;\n"
         "3 input, output or display error; 130 Ctrl-C; 128 and its number: another signal.\n";
}

/// Throws if a word that was not taken for a command must have been meant as one.
void refuse_misspelt_command(Text argument, bool alone) {
  std::vector<std::string> names;
  for (const CommandRow& row : command_rows()) names.emplace_back(row.name);
  const std::string hint = suggestion(argument, names);
  if ((hint.empty() && alone) || argument[0] == '-' || argument.find_first_of("./") != std::string::npos) return;
  std::error_code error;
  if (hint.empty() || std::filesystem::exists(argument, error)) return;
  throw UsageError("unknown command " + in_quotes(argument) + hint);
}

/// Throws if the first word must have been meant as an option of the program itself.
void refuse_misspelt_option(Text argument) {
  if (argument.size() < 3 || argument[0] != '-') return;
  const std::string hint = suggestion(argument, {"--version", "--help"});
  if (!hint.empty()) throw UsageError("unknown option " + in_quotes(argument) + hint + " (see tyndall --help)");
}

Command read_help(Arguments arguments) {
  if (arguments.empty()) return PrintCommand{overview(), {}};
  std::string (*const writers[])(const std::vector<CommandPage>&) = {man_page, bash_completion, zsh_completion,
                                                                     fish_completion};
  const std::size_t form = read_name(arguments[0], {"man", "bash", "zsh", "fish"});
  std::vector<CommandPage> pages;
  for (const CommandRow& row : command_rows()) pages.push_back(std::get<PrintCommand>(read(row, {"--help"})).page);
  return PrintCommand{writers[form](pages), {}};
}

}  // namespace

/// NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw UsageError("found \"" + text + "\", expected NAME=FLAGS, e.g. 'no MIS=--integrator nee'");
  CommandRequest method;
  method.curve = text.substr(0, equals);
  std::istringstream stream(text.substr(equals + 1));
  std::vector<std::string> arguments;
  for (std::string argument; stream >> argument;) arguments.push_back(argument);
  const auto app = new_command("--method NAME=FLAGS", "One curve of a chart.");
  add_group(*app, {"Method", "{render} --isa"}, method);
  if (parse(*app, arguments)) throw UsageError("found a question for help, expected flags of a method");
  return method;
}

Command read_command(const std::vector<std::string>& arguments) {
  const std::vector<CommandRow>& rows = command_rows();
  if (arguments.empty()) return read(rows.front(), {});
  const std::string& first = arguments.front();
  if (first == "-h" || first == "--help") return PrintCommand{overview(), {}};
  if (first == "help") return read_help({arguments.begin() + 1, arguments.end()});
  if (first == "-V" || first == "--version" || first == "version") return PrintCommand{version_text(), {}};
  for (const CommandRow& row : rows)
    if (first == row.name) return read(row, {arguments.begin() + 1, arguments.end()});
  if (first == "book" && !std::filesystem::exists(first))
    throw UsageError(
        "book: the folder of headers is gone: programs are read with their own; in place of a build by hand: tyndall "
        "main.cc, tyndall render main.cc -o picture.exr, or ./mine | tyndall view -");
  refuse_misspelt_command(first, arguments.size() == 1);
  if (arguments.size() == 1) refuse_misspelt_option(first);
  return read(rows.front(), arguments);
}

int run(const Command& command) {
  if (const auto* print = std::get_if<PrintCommand>(&command)) {
    write_standard_output(print->text);
    return 0;
  }
  const auto& request = std::get<CommandRequest>(command);
  for (const CommandRow& row : command_rows())
    if (request.command == row.name) return row.run(request);
  return 0;
}

}  // namespace tyndall
