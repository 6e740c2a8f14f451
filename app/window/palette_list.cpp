#include "app/window/palette_list.h"

#include "app/window/command.h"
#include "app/window/menus/row_list.h"
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

std::vector<PaletteItem> palette_items(const Scene& scene, const ObjectPath& selected,
                                       const std::vector<std::string>& scenes) {
  std::vector<PaletteItem> lines;
  const auto add_commands = [&lines](bool views) {
    for (const Command& command : commands())
      if (!command.is(unlisted) && command.is(shows_view) == views && command.name != "all actions by name")
        lines.push_back({command.name, text_of(command.key), command.words, {command.name}});
  };
  add_commands(false);
  for (const RowEntry& row : row_entries(scene, selected))
    lines.push_back({name_of_row(row),
                     row.missing.empty() ? row.owner : row.missing,
                     row.synonyms,
                     {"row", row.part + "/" + row.label}});
  add_commands(true);
  for (const Tab& tab : column_tabs())
    lines.push_back({std::string("go to: ") + tab.name, "", tab.words, {"part", tab.name}});
  for (const std::string& what : scenes) lines.push_back({"open: " + what, "", "scene", {"scene", what}});
  return lines;
}

}  // namespace tyndall
