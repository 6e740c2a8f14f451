#include "app/manual/page.h"

#include "app/text/markup.h"
#include "core/base/text.h"

#include <algorithm>

namespace tyndall {
namespace {

/// Text that man(7) shows as it is: a backslash, a dash, and a line that begins like a request would be read otherwise.
std::string escaped(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
    at_start = c == '\n';
  }
  return out;
}

std::string capitals(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string option_text(const OptionPage& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "\\fB" : ", \\fB") + escaped(name) + "\\fR";
  if (!option.unit.empty()) names += " \\fI" + escaped(option.unit) + "\\fR";
  return ".TP\n" + names + "\n" + escaped(option.help) + "\n";
}

std::string command_text(const CommandPage& command) {
  std::string text = ".SH " + capitals(command.name) + "\n.B tyndall " + escaped(command.usage) + "\n.PP\n";
  for (std::size_t at = 0; at <= command.about.size();) {  // paragraphs are two line ends apart
    const std::size_t end = std::min(command.about.find("\n\n", at), command.about.size());
    text += escaped(command.about.substr(at, end - at)) + "\n.PP\n";
    at = end + 2;
  }
  for (const OptionPage& argument : command.arguments) text += option_text(argument);
  std::string group;
  for (const OptionPage& option : command.options) {
    if (option.group != group) text += ".SS " + escaped(option.group) + "\n";
    group = option.group;
    text += option_text(option);
  }
  // .nf to .fi: lines keep their breaks.
  return command.examples.empty() ? text : text + ".SS Notes\n.nf\n" + escaped(command.examples) + "\n.fi\n";
}

/// The help up to its first "; ", colon or line end.
std::string short_help(const std::string& help) {
  return help.substr(0, std::min({help.find('\n'), help.find("; "), help.find(": "), help.find(" [")}));
}

bool takes_file(const OptionPage& option) { return option.unit.rfind("FILE", 0) == 0 || option.unit == "DIR"; }

std::string bash_values(const CommandPage& command) {
  std::string text;
  for (const OptionPage& option : command.options) {
    if (option.unit.empty()) continue;
    for (const std::string& name : option.names)
      text += (&name == &option.names.front() ? "    '" : " | '") + command.name + " " + name + "'";
    text += ") ";
    if (!option.choices.empty()) {
      text += "words='" + joined(option.choices, " ") + "'";
    } else {
      text += takes_file(option) ? "_tyndall_files \"$word\"; return" : "return";
    }
    text += " ;;\n";
  }
  return text;
}

constexpr char bash_start[] = R"(# Completion of tyndall for bash; made by "tyndall help bash".
_tyndall_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$1")
}
_tyndall() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} words=''
  COMPREPLY=()
  if [ "$word" = = ]; then word=''; elif [ "$before" = = ]; then before=${COMP_WORDS[COMP_CWORD-2]}; fi
  case "$command $before" in
)";

constexpr char bash_end[] = R"(    esac
  else
    words=$(tyndall scenes 2>/dev/null | cut -d ' ' -f 1)
    [ "$COMP_CWORD" -gt 1 ] || words="$words $commands"
    _tyndall_files "$word"
  fi
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _tyndall tyndall
)";

std::string zsh_option(const OptionPage& option) {
  std::string help = short_help(option.help), unit = option.unit;
  for (const char c : {'[', ']'}) std::replace(help.begin(), help.end(), c, c == '[' ? '(' : ')');
  std::replace(unit.begin(), unit.end(), ':', '-');
  std::string value;
  if (!option.unit.empty()) {
    const std::string choices = option.choices.empty() ? "" : "(" + joined(option.choices, " ") + ")";
    value = ":" + unit + ":" + (takes_file(option) ? "_files" : choices);
  }
  const std::string names = option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names[0];
  return "        '*'" + names + in_shell("[" + help + "]" + value);
}

}  // namespace

std::string man_page(const std::vector<CommandPage>& commands) {
  std::string text =
      ".\\\" Made by \"tyndall help man\" from the options of the program.\n"
      ".TH TYNDALL 1 \"\" \"Tyndall " TYNDALL_VERSION
      "\" \"User Commands\"\n"
      ".SH NAME\ntyndall \\- progressive path tracer for glass, brushed metal and fog\n"
      ".SH SYNOPSIS\n.B tyndall\n[\\fISCENE\\fR]\n.br\n.B tyndall\n\\fICOMMAND\\fR [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\n"
      "Tyndall computes pictures by following light paths at random. It opens a scene in a window, where each\n"
      "value is a slider, or renders it without one. Pictures are the same bits for any number of threads, and\n"
      "for parts that were rendered on many machines and merged.\n.PP\n"
      "\\fISCENE\\fR is a scene file, the name of a built\\-in scene, a PNG or EXR that Tyndall made, \\- for "
      "standard\n"
      "input, or a C++ source file (.cc, .cpp, .cxx): a program of the books \\(dqRay Tracing in One Weekend\\(dq,\n"
      "which is compiled and run. Where standard input begins with P3 or P6, \\fBtyndall view \\-\\fR shows the "
      "picture\n"
      "that another program writes, row by row: \\fB./mine | tyndall view \\-\\fR.\n.SH COMMANDS\n";
  for (const CommandPage& command : commands)
    text += ".TP\n.B " + command.name + "\n" + escaped(command.summary) + "\n";
  for (const CommandPage& command : commands) text += command_text(command);
  return text +
         ".SH EXIT STATUS\n0: done; 1: a check failed; 2: wrong usage or a scene that cannot be read; 3: input, "
         "output\n"
         "or display error; 130: Ctrl\\-C; 128 and its number: another signal.\n"
         ".SH ENVIRONMENT\n.TP\n.B TYNDALL_ASSETS\nthe folder that holds the built\\-in scenes and known answers\n"
         ".TP\n.B NO_COLOR\nno colours in progress\n"
         ".TP\n.B CXX\nthe compiler of programs of the books; else c++, g++ or clang++\n";
}

std::string bash_completion(const std::vector<CommandPage>& commands) {
  std::string text = bash_start;
  std::vector<std::string> names;
  for (const CommandPage& command : commands) text += bash_values(command), names.push_back(command.name);
  text += "  esac\n  local commands='" + joined(names, " ") +
          "'\n  if [ -n \"$words\" ]; then :\n  elif [[ $word == -* ]]; then\n    case $command in\n";
  for (const CommandPage& command : commands) {
    names.clear();
    for (const OptionPage& option : command.options)
      names.insert(names.end(), option.names.begin(), option.names.end());
    text += "      " + command.name + ") words='" + joined(names, " ") + "' ;;\n";
  }
  return text + "      *) words='--help --version' ;;\n" + bash_end;
}

std::string zsh_completion(const std::vector<CommandPage>& commands) {
  std::string text =
      "#compdef tyndall\n# Completion of tyndall for zsh; made by \"tyndall help zsh\".\n"
      "_tyndall_words() {\n  local -a scenes\n  scenes=(${(f)\"$(tyndall scenes 2>/dev/null | cut -d ' ' -f 1)\"})\n"
      "  _alternative 'scenes:built-in scene:compadd -a scenes' 'files:file:_files'\n}\n"
      "_tyndall() {\n  if (( CURRENT == 2 )); then\n    local -a commands\n    commands=(\n";
  for (const CommandPage& command : commands)
    text += "      " + in_shell(command.name + ":" + short_help(command.summary)) + "\n";
  text +=
      "    )\n    _describe command commands\n    _tyndall_words\n    return\n  fi\n"
      "  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n";
  for (const CommandPage& command : commands) {
    text += "    " + command.name + ")\n      _arguments -S";
    for (const OptionPage& option : command.options) text += " \\\n" + zsh_option(option);
    text += std::string(command.arguments.empty() ? "" : " \\\n        '*:file:_tyndall_words'") + "\n      ;;\n";
  }
  return text + "    *) _tyndall_words ;;\n  esac\n}\n_tyndall \"$@\"\n";
}

std::string fish_completion(const std::vector<CommandPage>& commands) {
  std::string text = "# Completion of tyndall for fish; made by \"tyndall help fish\".\n";
  const std::string one = "complete -c tyndall -n ";
  text += "complete -c tyndall -a '(tyndall scenes 2>/dev/null | string split -f 1 \" \")' -d scene\n";
  for (const CommandPage& command : commands)
    text += one + "__fish_use_subcommand -a " + command.name + " -d " + in_shell(short_help(command.summary)) + "\n";
  for (const CommandPage& command : commands)
    for (const OptionPage& option : command.options) {
      text += one + "'__fish_seen_subcommand_from " + command.name + "'";
      for (const std::string& name : option.names) {
        const bool is_long = name.rfind("--", 0) == 0;
        text += (is_long ? " -l " : " -s ") + name.substr(is_long ? 2 : 1);
      }
      if (!option.choices.empty()) text += " -x -a '" + joined(option.choices, " ") + "'";
      if (option.choices.empty() && !option.unit.empty()) text += takes_file(option) ? " -r -F" : " -x";
      text += " -d " + in_shell(short_help(option.help)) + "\n";
    }
  return text;
}

}  // namespace tyndall
