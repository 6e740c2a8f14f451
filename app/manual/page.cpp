#include "app/manual/page.h"

#include "app/text/markup.h"
#include "app/text/values.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/system/guard.h"

#include <algorithm>

namespace tyndall {
namespace {

/// What a function says of each row of a list.
template <class Row, class Say>
std::string of_each(const std::vector<Row>& rows, const Say& say) {
  std::string text;
  for (const Row& row : rows) text += say(row);
  return text;
}

std::vector<std::string> names_of(const OptionRow& option) { return split_at(option.names, ','); }

/// Text that man(7) shows as it is: a backslash, a dash, and a line that begins like a request would be read otherwise.
std::string escaped(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\' || c == '-') out += '\\';
    out += c == '\\' ? 'e' : c;
    at_start = c == '\n';
  }
  return out;
}

std::string option_text(const OptionRow& option) {
  std::string text = ".TP\n";
  for (const std::string& name : names_of(option))
    text += (text.ends_with('\n') ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  if (!option.unit.empty() && option.unit != " ") text += " \\fI" + escaped(option.unit) + "\\fR";
  return text + "\n" + escaped(option.help) + "\n";
}

std::string command_text(const CommandRow& command) {
  std::string name = command.name(), about = escaped(command.about), group;
  std::transform(name.begin(), name.end(), name.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  for (std::size_t at = 0; (at = about.find("\n\n", at)) != about.npos;) about.replace(at, 2, "\n.PP\n");
  std::string text = ".SH " + name + "\n.B tyndall " + escaped(command.usage) + "\n.PP\n" + about + "\n.PP\n";
  text += of_each(command.arguments, option_text);
  for (const OptionRow& option : command.options) {
    if (option.heading != group) text += ".SS " + escaped(option.heading) + "\n";
    group = option.heading;
    text += option_text(option);
  }
  // .nf to .fi: lines keep their breaks.
  return command.examples.empty() ? text : text + ".SS Notes\n.nf\n" + escaped(command.examples) + "\n.fi\n";
}

/// The help up to its first "; ", colon or line end.
std::string short_help(const std::string& help) {
  return help.substr(0, std::min({help.find('\n'), help.find("; "), help.find(": "), help.find(" [")}));
}

bool takes_file(const OptionRow& option) { return option.unit.starts_with("FILE") || option.unit == "DIR"; }

std::string bash_values(const CommandRow& command) {
  return of_each(command.options, [&](const OptionRow& option) {
    if (option.unit.empty()) return std::string();
    const std::string cases = joined(names_of(option), "' | '" + command.name() + " ");
    std::string values = takes_file(option) ? "_tyndall_files \"$word\"; return" : "return";
    if (!option.taker.choices.empty()) values = "words='" + joined(option.taker.choices, " ") + "'";
    return "    '" + command.name() + " " + cases + "') " + values + " ;;\n";
  });
}

std::string bash_options(const CommandRow& command) {
  std::vector<std::string> names;
  for (const OptionRow& option : command.options) names.push_back(joined(names_of(option), " "));
  return "      " + command.name() + ") words='" + joined(names, " ") + "' ;;\n";
}

std::string zsh_option(const OptionRow& option) {
  std::string help = short_help(option.help), unit = option.unit;
  for (const char c : {'[', ']'}) std::replace(help.begin(), help.end(), c, c == '[' ? '(' : ')');
  std::replace(unit.begin(), unit.end(), ':', '-');
  const auto& choices = option.taker.choices;
  const std::string words = choices.empty() ? "" : "(" + joined(choices, " ") + ")";
  const std::string value = unit.empty() ? "" : ":" + unit + ":" + (takes_file(option) ? "_files" : words);
  const bool several = option.names.find(',') != option.names.npos;
  return " \\\n        '*'" + (several ? "{" + option.names + "}" : option.names) + in_shell("[" + help + "]" + value);
}

std::string zsh_options(const CommandRow& command) {
  return "    " + command.name() + ")\n      _arguments -S" + of_each(command.options, zsh_option) +
         (command.arguments.empty() ? "" : " \\\n        '*:file:_tyndall_words'") + "\n      ;;\n";
}

std::string fish_option(const OptionRow& option) {
  std::string text;
  for (const std::string& name : names_of(option))
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.taker.choices.empty()) text += " -x -a '" + joined(option.taker.choices, " ") + "'";
  if (option.taker.choices.empty() && !option.unit.empty()) text += takes_file(option) ? " -r -F" : " -x";
  return text + " -d " + in_shell(short_help(option.help)) + "\n";
}

std::string compiler_text() {
#if defined(__clang__)
  const std::string name = "clang " __clang_version__;
#else
  const std::string name = "GCC " __VERSION__;
#endif
#if defined(_LIBCPP_VERSION)
  const std::string library = "libc++ " + std::to_string(_LIBCPP_VERSION / 1000);
#else
  const std::string library = "libstdc++ " + std::to_string(_GLIBCXX_RELEASE);
#endif
  return name.substr(0, name.find_last_not_of(' ') + 1) + ", " + library + ", " TYNDALL_BUILD;
}

}  // namespace

std::string man_page(const std::vector<CommandRow>& commands) {
  const auto summary = [](const CommandRow& command) {
    return ".TP\n.B " + command.name() + "\n" + escaped(command.summary) + "\n";
  };
  return from_template("tyndall.1", {{"version", TYNDALL_VERSION},
                                     {"commands", of_each(commands, summary)},
                                     {"sections", of_each(commands, command_text)}});
}

std::string bash_completion(const std::vector<CommandRow>& commands) {
  std::vector<std::string> names;
  for (const CommandRow& command : commands) names.push_back(command.name());
  return from_template("completion.bash", {{"values", of_each(commands, bash_values)},
                                           {"commands", joined(names, " ")},
                                           {"options", of_each(commands, bash_options)}});
}

std::string zsh_completion(const std::vector<CommandRow>& commands) {
  const auto summary = [](const CommandRow& command) {
    return "      " + in_shell(command.name() + ":" + short_help(command.summary)) + "\n";
  };
  return from_template("completion.zsh",
                       {{"commands", of_each(commands, summary)}, {"options", of_each(commands, zsh_options)}});
}

std::string fish_completion(const std::vector<CommandRow>& commands) {
  const std::string one = "complete -c tyndall -n ";
  const auto summary = [&one](const CommandRow& command) {
    return one + "__fish_use_subcommand -a " + command.name() + " -d " + in_shell(short_help(command.summary)) + "\n";
  };
  const auto options = [&one](const CommandRow& command) {
    return of_each(command.options, [&](const OptionRow& option) {
      return one + "'__fish_seen_subcommand_from " + command.name() + "'" + fish_option(option);
    });
  };
  return "# Completion of tyndall for fish; made by \"tyndall help fish\".\n"
         "complete -c tyndall -a '(tyndall scenes 2>/dev/null | string split -f 1 \" \")' -d scene\n" +
         of_each(commands, summary) + of_each(commands, options);
}

std::string version_text() {
  const std::vector<Target> missing = missing_targets();
  return "tyndall " TYNDALL_VERSION "\ncompiler   " + compiler_text() + "\nkernels    " + names_of(built_targets()) +
         "; this CPU runs " + names_of(available_targets()) +
         (missing.empty() ? "" : ", and could run " + names_of(missing) + how_to_build(name_of(missing.back()))) +
         "\nguard      " + guard_text(available_guard()) + "\nlibraries  " TYNDALL_LIBRARIES "\n";
}

}  // namespace tyndall
