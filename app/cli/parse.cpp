#include "app/cli/option_rows.h"
#include "core/base/text.h"

#include <CLI/CLI.hpp>

#include <algorithm>

/// What Tyndall's commands add to CLI11: values that are read by functions which say what they expected, so that every
/// refusal reads alike ("--size: found "8", expected WIDTHxHEIGHT ..."), suggestions, and a usage line of our own.
namespace tyndall {
namespace {

void add_option(CLI::App& app, const OptionRow& row, CommandRequest& request) {
  const auto take = [&](const std::string& text) {
    try {
      row.taker.take(request, text);
    } catch (const UsageError& error) {
      if (row.taker.takes == Takes::flag || row.names[0] != '-') throw;
      refuse("{}: {}", row.names.substr(row.names.find("--")), error.what());
    }
  };
  app.option_defaults()->group(row.heading);
  if (row.taker.takes == Takes::flag) {
    app.add_flag_callback(
        row.names, [take] { take("on"); }, row.help);
    return;
  }
  const bool many = row.taker.takes == Takes::each;
  const auto each = [take](const std::vector<std::string>& texts) { std::for_each(texts.begin(), texts.end(), take); };
  CLI::Option* option = many ? app.add_option_function<std::vector<std::string>>(row.names, each, row.help)
                             : app.add_option_function<std::string>(row.names, take, row.help);
  option->option_text(row.unit);
  if (many) option->take_all();
  if (row.names[0] == '-') option->allow_extra_args(false);
}

std::string help_text(const CLI::App& app, const CommandRow& command) {
  CLI::Formatter formatter;
  formatter.column_width(30);
  formatter.label("Positionals", "Arguments");
  std::string text = command.about + "\n\nUsage: tyndall " + command.usage + "\n" + formatter.make_positionals(&app) +
                     formatter.make_groups(&app, CLI::AppFormatMode::Normal) + "\n" + formatter.make_footer(&app);
  // CLI11 puts two empty lines between groups.
  for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
  return text;
}

/// Throws for the first word that is neither option nor argument.
void refuse_extras(const CLI::App& app, const std::string& see) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& argument : app.remaining()) {
    if (argument == "--") continue;  // words after this are no options
    if (argument.size() < 2 || argument[0] != '-') refuse("unexpected argument {}{}", in_quotes(argument), see);
    const std::string name = argument.substr(0, argument.find('='));
    refuse("unknown option {}{}{}", in_quotes(name), did_you_mean(name, {names.begin(), names.end()}), see);
  }
}

}  // namespace

std::string see_help(std::string_view command) { return " (see tyndall " + std::string(command) + " --help)"; }

std::optional<std::string> parse(const CommandRow& command, std::vector<std::string> arguments,
                                 CommandRequest& request) {
  CLI::App app;
  app.set_help_flag("-h,--help", command.options.front().help);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.allow_extras();  // they are refused below, with a suggestion
  app.footer(command.examples);
  for (const OptionRow& row : command.arguments) add_option(app, row, request);
  for (const OptionRow& row : command.options)
    if (row.taker.take) add_option(app, row, request);
  const std::string see = see_help(command.name());
  std::reverse(arguments.begin(), arguments.end());  // what CLI11 expects
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return help_text(app, command);
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    refuse("{}: a value is missing{}", text.substr(0, text.find(':')), see);
  } catch (const CLI::ParseError& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    refuse("{}{}", text, see);
  }
  refuse_extras(app, see);
  return std::nullopt;
}

}  // namespace tyndall
