#include "tests/bench/options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace tyndall::bench {
namespace {

std::string parts_help() {
  std::string text = "Parts:\n";
  for (const Part& part : parts())
    text += "  " + std::string(part.name) + std::string(12 - std::string(part.name).size(), ' ') + part.about + "\n";
  return text;
}

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The named parts in the order in which they run, each once; all of them for none.
std::vector<std::string> chosen_parts(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto named = [&](const Part& part) { return name == part.name; };
    if (std::none_of(parts().begin(), parts().end(), named))
      throw UsageError("PART: found \"" + on_one_line(name) + "\", expected one of those that --help lists");
  }
  std::vector<std::string> chosen;
  for (const Part& part : parts())
    if (names.empty() || std::find(names.begin(), names.end(), part.name) != names.end())
      chosen.emplace_back(part.name);
  return chosen;
}

int read_repeat(const std::string& text) {
  constexpr int maximum = 1000;
  int value = 0;
  std::istringstream stream(text);
  if (!(stream >> value) || !stream.eof() || value < 1 || value > maximum)
    throw UsageError("--repeat: found \"" + on_one_line(text) + "\", expected a whole number from 1 to 1000");
  return value;
}

}  // namespace

std::optional<Settings> read_settings(std::vector<std::string> arguments) {
  Settings settings;
  std::vector<std::string> names;
  std::string repeat;
  CLI::App app("Measures how fast and how accurate Tyndall is on this machine.", "tyndall_bench");
  app.footer(parts_help());
  app.add_option("PART", names, "what to measure; default: everything")->type_name("");
  app.add_option("--json", settings.json, "write all figures as JSON")->type_name("FILE");
  app.add_flag("--quick", settings.quick, "shorter and less exact");
  app.add_flag("--thorough", settings.thorough, "also the time to relMSE 0.001");
  app.add_option("--repeat", repeat, "repetitions of each measurement; default: each part's own")->type_name("N");
  app.add_option("--references", settings.references, "folder for the reference images; default: the current one")
      ->type_name("FOLDER");
  app.add_option("--against", settings.against,
                 "another program \"tyndall\", such as the last release, for the part against")
      ->type_name("FILE");
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    std::printf("%s", app.help().c_str());
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw UsageError(on_one_line(error.what()));
  }
  if (!repeat.empty()) settings.repeat = read_repeat(repeat);
  if (!std::filesystem::is_directory(settings.references))
    throw UsageError("--references: found \"" + on_one_line(settings.references.string()) + "\", expected a folder");
  if (!settings.against.empty() && !std::filesystem::is_regular_file(settings.against))
    throw UsageError("--against: found \"" + on_one_line(settings.against.string()) + "\", expected a program");
  settings.parts = chosen_parts(names);
  return settings;
}

}  // namespace tyndall::bench
