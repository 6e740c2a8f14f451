#include "app/cli/command_line.h"

#include "core/base/text.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace tyndall {

struct CommandLine::State {
  CLI::App app;
  std::string usage;
  std::string group = "Options";

  std::string see_help() const { return " (see " + app.get_name() + " --help)"; }

  /// CLI11's help, with our own usage line and without double empty lines.
  std::string help() const {
    std::string text = app.help();
    const std::size_t line = text.find("Usage: "), end = text.find('\n', line);
    text.replace(line, end - line, "\nUsage: tyndall " + usage);
    for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
    return text;
  }

  /// Throws for the first word that is neither option nor argument.
  void refuse_extras() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& word : app.remaining()) {
      if (word == "--") continue;  // ends the options
      if (word.size() < 2 || word[0] != '-') throw UsageError("unexpected argument " + in_quotes(word) + see_help());
      const std::string name = word.substr(0, word.find('='));
      throw UsageError("unknown option " + in_quotes(name) + suggestion(name, names) + see_help());
    }
  }
};

namespace {

/// Calls read and puts the option's name before what it complains about.
void read_named(const std::string& name, const CommandLine::Reader& read, const std::string& text) {
  try {
    read(text);
  } catch (const UsageError& error) {
    throw UsageError(name + ": " + error.what());
  }
}

std::string long_name(const std::string& names) { return names.substr(names.find("--")); }

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

CommandLine::CommandLine(const std::string& usage, const std::string& about, const std::string& examples)
    : state_(new State{CLI::App(about, "tyndall " + usage.substr(0, usage.find(' '))), usage}) {
  CLI::App& app = state_->app;
  app.set_help_flag("-h,--help", "show this text");
  app.allow_extras();
  app.footer(examples);
  app.get_formatter()->column_width(30);
  app.get_formatter()->label("Positionals", "Arguments");
}

CommandLine::~CommandLine() = default;

void CommandLine::group(const std::string& name) { state_->group = name; }

void CommandLine::value(const std::string& names, const std::string& unit, const std::string& help, Reader read) {
  const std::string name = long_name(names);
  const Reader named = [name, read](const std::string& text) { read_named(name, read, text); };
  CLI::Option* option = state_->app.add_option_function<std::string>(names, named, help);
  option->option_text(unit)->group(state_->group)->take_last();
}

void CommandLine::values(const std::string& names, const std::string& unit, const std::string& help, Reader read) {
  const std::string name = long_name(names);
  const auto each = [name, read](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) read_named(name, read, text);
  };
  CLI::Option* option = state_->app.add_option_function<std::vector<std::string>>(names, each, help);
  option->option_text(unit)->group(state_->group)->allow_extra_args(false);
}

void CommandLine::flag(const std::string& names, const std::string& help, bool& on) {
  state_->app.add_flag(names, on, help)->group(state_->group)->take_last();
}

void CommandLine::flag(const std::string& names, const std::string& help, std::function<void()> switch_on) {
  const auto given = [switch_on](std::int64_t) { switch_on(); };
  state_->app.add_flag_function(names, given, help)->group(state_->group)->take_last();
}

void CommandLine::argument(const std::string& name, const std::string& help, std::string& text) {
  state_->app.add_option(name, text, help)->option_text(" ");
}

void CommandLine::arguments(const std::string& name, const std::string& help, std::vector<std::string>& texts) {
  state_->app.add_option(name, texts, help)->option_text(" ");
}

std::optional<std::string> CommandLine::read(std::vector<std::string> words) {
  std::reverse(words.begin(), words.end());  // what CLI11 expects
  try {
    state_->app.parse(words);
  } catch (const CLI::CallForHelp&) {
    return state_->help();
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    throw UsageError(text.substr(0, text.find(':')) + ": a value is missing" + state_->see_help());
  } catch (const CLI::ParseError& error) {
    throw UsageError(on_one_line(error.what()) + state_->see_help());
  }
  state_->refuse_extras();
  return std::nullopt;
}

void CommandLine::require(bool given, const std::string& what) const {
  if (!given) throw UsageError(what + " is missing" + state_->see_help());
}

}  // namespace tyndall
