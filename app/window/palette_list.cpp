#include "app/window/palette_list.h"

#include "app/window/command.h"
#include "app/window/panels/panels.h"

#include <cctype>
#include <utility>

namespace tyndall {
namespace {

std::string name_of_row(const RowEntry& row) {
  if (row.label.empty()) return "go to: " + row.part;
  if (row.part != "Background") return "go to: " + row.label;
  std::string label = row.label;
  label[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(label[0])));
  return "go to: Background " + label;
}

}  // namespace

std::vector<PaletteItem> palette_items(const std::vector<ListedRow>& rows, const std::vector<std::string>& scenes) {
  std::vector<PaletteItem> lines;
  const auto add_commands = [&lines](bool views) {
    for (const Command& command : commands())
      if (!command.is(unlisted) && command.is(shows_view) == views && command.name != "all actions by name")
        lines.push_back({command.name, text_of(command.key), command.words, {command.name}});
  };
  add_commands(false);
  for (const auto& [row, missing] : rows) {
    const bool shown = missing.empty();
    const Request request{shown ? "row" : "say", row.part + "/" + row.label + (shown ? "" : ": " + missing)};
    lines.push_back({name_of_row(row), shown ? row.owner : missing, row.words, request});
  }
  add_commands(true);
  for (const Section& one : column_sections())
    if (one.is(has_tab)) lines.push_back({std::string("go to: ") + one.name, "", one.words, {"part", one.name}});
  for (const std::string& what : scenes) lines.push_back({"open: " + what, "", "scene", {"scene", what}});
  return lines;
}

}  // namespace tyndall
