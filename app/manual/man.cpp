#include "app/manual/page.h"

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

/// Lines that keep their breaks.
std::string as_typed(const std::string& text) { return ".nf\n" + escaped(text) + "\n.fi\n"; }

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
  return command.examples.empty() ? text : text + ".SS Notes\n" + as_typed(command.examples);
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
         ".TP\n.B CXX\nthe compiler of programs of the books; else c++, g++ or clang++\n"
         ".TP\n.B TYNDALL_OUTPUT\nread by programs that were built with the headers of \\(dqtyndall book\\(dq: the "
         "file of their "
         "picture\n";
}

}  // namespace tyndall
