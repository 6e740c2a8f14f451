#include "app/cli/setting_options.h"

#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) {
    column_width(30);
    label("Positionals", "Arguments");
  }
  std::string make_usage(const CLI::App*, std::string) const override { return "\nUsage: tyndall " + usage_ + "\n"; }
  const std::string& usage() const { return usage_; }
  /// CLI11 puts two empty lines between groups.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
    return text;
  }

 private:
  std::string usage_;
};

std::string see_help(const CLI::App& app) { return " (see " + app.get_name() + " --help)"; }

/// A reader that puts the option's name before what it complains about.
Reader named(const std::string& names, Reader read) {
  return [name = names.substr(names.find("--")), read = std::move(read)](const std::string& text) {
    try {
      read(text);
    } catch (const UsageError& error) {
      throw UsageError(name + ": " + error.what());
    }
  };
}

std::vector<std::string> split(const std::string& text, char separator) {
  return text.empty() ? std::vector<std::string>() : CLI::detail::split(text, separator);
}

OptionPage page_of(const CLI::Option& option) {
  OptionPage page{
      {}, option.get_group(), option.get_option_text(), split(option.get_type_name(), '|'), option.get_description()};
  for (const std::string& name : option.get_snames()) page.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) page.names.push_back("--" + name);
  if (page.names.empty()) page.names = {option.get_name()};
  if (page.choices.empty() && page.unit.find('|') != std::string::npos) page.choices = split(page.unit, '|');
  if (page.unit == " " || option.get_expected_min() == 0) page.unit.clear();
  return page;
}

CommandPage page_of(const CLI::App& app) {
  const std::string name = app.get_name().substr(app.get_name().find(' ') + 1);
  const auto formatter = std::static_pointer_cast<HelpFormatter>(app.get_formatter());
  CommandPage page{name, {}, formatter->usage(), app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? page.arguments : page.options).push_back(page_of(*option));
  return page;
}

/// Throws for the first word that is neither option nor argument.
void refuse_extras(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& argument : app.remaining()) {
    if (argument == "--") continue;  // words after this are no options
    if (argument.size() < 2 || argument[0] != '-')
      throw UsageError("unexpected argument " + in_quotes(argument) + see_help(app));
    const std::string name = argument.substr(0, argument.find('='));
    throw UsageError("unknown option " + in_quotes(name) + did_you_mean(name, {names.begin(), names.end()}) +
                     see_help(app));
  }
}

}  // namespace

std::unique_ptr<CLI::App> new_command(const std::string& usage, const std::string& about, const std::string& examples) {
  auto app = std::make_unique<CLI::App>(about, "tyndall " + usage.substr(0, usage.find(' ')));
  app->formatter(std::make_shared<HelpFormatter>(usage));
  app->set_help_flag("-h,--help", "show this text");
  app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app->allow_extras();  // parse() refuses them with a suggestion
  app->footer(examples);
  return app;
}

void add_option(CLI::App& app, const std::string& names, const std::string& unit, const std::string& help, Reader read,
                Takes takes, const std::vector<std::string>& choices) {
  if (takes == Takes::flag) {
    app.add_flag_callback(
        names, [read = std::move(read)] { read(""); }, help);
    return;
  }
  const bool argument = names[0] != '-';
  if (!argument) read = named(names, std::move(read));
  const auto each = [read](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) read(text);
  };
  CLI::Option* option = takes == Takes::each ? app.add_option_function<std::vector<std::string>>(names, each, help)
                                             : app.add_option_function<std::string>(names, read, help);
  option->option_text(unit)->type_name(CLI::detail::join(choices, "|"));  // the help shows the unit alone
  if (takes == Takes::each) option->take_all();
  if (!argument) option->allow_extra_args(false);
}

std::optional<PrintCommand> parse(CLI::App& app, std::vector<std::string> arguments) {
  std::reverse(arguments.begin(), arguments.end());  // what CLI11 expects
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return PrintCommand{app.help(), page_of(app)};
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    throw UsageError(text.substr(0, text.find(':')) + ": a value is missing" + see_help(app));
  } catch (const CLI::ParseError& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    throw UsageError(text + see_help(app));
  }
  refuse_extras(app);
  return std::nullopt;
}

}  // namespace tyndall
