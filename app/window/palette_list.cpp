#include "app/window/palette_list.h"

#include "app/window/accuracy/views.h"
#include "app/window/menus/row_list.h"
#include "app/window/panels/panels.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

namespace tyndall {
namespace {

/// Other words for views and parts of the column, by their names.
constexpr std::pair<std::string_view, const char*> words_of_parts[] = {
    {"beauty", "combined, rgb"},
    {"normal", "normals"},
    {"depth", "depth buffer, z buffer, distance"},
    {"noise", "variance map, convergence"},
    {"samples", "sample map"},
    {"cost", "heat map of time, time per pixel"},
    {"error", "difference, error map"},
    {"FLIP", "perceptual difference"},
    {"object", "object id, cryptomatte"},
    {"false colour", "false color, heat map, zebra"},
    {"Object", "properties, selected object"},
    {"Camera", "camera settings"},
    {"Image", "image settings"},
    {"Render", "render settings"},
    {"Accuracy", "chart, statistics, graph"},
    {"Objects", "outliner, hierarchy, object list, tree"},
    {"Scenes", "examples, recent files, gallery"},
};

std::string words_for(std::string_view name) {
  for (const auto& [of, words] : words_of_parts)
    if (of == name) return words;
  return "";
}

std::string name_of_row(const RowEntry& row) {
  if (row.label.empty()) return "go to: " + row.part;
  if (row.part != "Background") return "go to: " + row.label;
  std::string label = row.label;
  label[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(label[0])));
  return "go to: Background " + label;
}

void add_rows(std::vector<PaletteItem>& lines, const Scene& scene, const ObjectPath& selected) {
  std::vector<PaletteItem> missing;
  for (int k = 0; const RowEntry& row : row_entries()) {
    const std::string owner = owner_of(row, scene, selected);
    PaletteItem line{name_of_row(row), owner.empty() ? row.missing : owner, row.also, {Action::row, k++}};
    (owner.empty() ? missing : lines).push_back(std::move(line));
  }
  lines.insert(lines.end(), missing.begin(), missing.end());
}

}  // namespace

std::vector<PaletteItem> palette_items(const Scene& scene, const ObjectPath& selected,
                                       const std::vector<std::string>& scenes) {
  std::vector<PaletteItem> lines;
  for (const ActionEntry& entry : actions())
    if (entry.action != Action::palette)
      lines.push_back({entry.name, text_of(entry.key), entry.other_words, {entry.action}});
  add_rows(lines, scene, selected);
  for (int k = 0; k < view_count; ++k)
    lines.push_back({std::string("view: ") + view_entry(k).name,
                     k < keyed_views ? std::to_string(k + 1) : "",
                     words_for(view_entry(k).name),
                     {Action::view, k}});
  for (int k = 0; const Tab& tab : column_tabs())
    lines.push_back({std::string("go to: ") + tab.name, "", words_for(tab.name), {Action::section, k++}});
  for (const std::string& what : scenes) lines.push_back({"open: " + what, "", "scene", {Action::scene, 0, what}});
  return lines;
}

bool requires_scene(const Request& request) {
  constexpr Action of_scenes[] = {
      Action::frame,        Action::reset_camera,     Action::save,         Action::save_as,
      Action::clean,        Action::clean_beside_raw, Action::split,        Action::grab,
      Action::add,          Action::duplicate,        Action::remove,       Action::rename,
      Action::own_material, Action::replay,           Action::refine_first, Action::store_camera,
      Action::next_camera,  Action::render_reference, Action::play,         Action::key_cameras};
  if (request.action == Action::view) return is_view_of_scene(request.number);
  if (request.action == Action::section)
    return is_part_of_scene(column_tabs()[static_cast<std::size_t>(request.number)].name);
  if (request.action == Action::row) {
    const RowEntry& row = row_entries()[static_cast<std::size_t>(request.number)];
    return is_part_of_scene(row.part) || row.label == "Clean";
  }
  return is_addition(request.action) || std::count(std::begin(of_scenes), std::end(of_scenes), request.action) > 0;
}

bool requires_rendering(const Request& request) {
  const bool view = request.action == Action::view && view_entry(request.number).view != View::beauty;
  return view || request.action == Action::pause || request.action == Action::restart;
}

}  // namespace tyndall
