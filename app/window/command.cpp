#include "app/window/command.h"

#include "app/window/accuracy/views.h"
#include "app/window/panels/rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <iterator>
#include <utility>

namespace tyndall {

namespace {

// GLFW's numbers of keys that do not type a character.
constexpr std::pair<int, const char*> named_keys[] = {{256, "Esc"},    {258, "Tab"},  {260, "Insert"},
                                                      {261, "Delete"}, {268, "Home"}, {290, "F1"},
                                                      {291, "F2"},     {300, "F11"},  {' ', "Space"}};

const HelpLine mouse_lines[] = {{"Left drag", "orbit; on a handle of the selection: move, turn, size it"},
                                {"Middle drag", "pan"},
                                {"Right drag, wheel", "nearer, farther"},
                                {"Ctrl + wheel", "field of view"},
                                {"Alt + wheel, Alt + drag", "enlarge the picture at the cursor; move it"},
                                {"W A S D Q E", "fly; with Shift faster"},
                                {"Click", "select the object under the cursor; again: what lies behind it"},
                                {"Ctrl + click", "add to the selection"},
                                {"Right click", "menu: add, duplicate, delete, rename"},
                                {"Shift + click", "focus on that point"},
                                {"Ctrl + Shift + click", "focus there, but keep the far blur as it is"},
                                {"Drop a file", "open a scene or snapshot; other images become the reference"},
                                {"Numbers, sliders", "drag, or click and type (1/4); Shift: finer, Ctrl: round"},
                                {"Right click on them", "vary: small pictures of all its values; key of a film"},
                                {"Double click on them", "back to what the scene's file has"}};

/// The help line of the views with a digit that the renderer draws, "1 … 7" and "views: beauty, albedo, …", or of those
/// that show errors.
HelpLine views_line(bool of_errors) {
  int first = 0, last = -1;
  std::string names;
  for (int k = 0; k < keyed_views; ++k) {
    if (shows_errors(k) != of_errors) continue;
    if (last < 0) first = k;
    names += (last < 0 ? "" : of_errors ? " and " : ", ") + std::string(view_entry(k).name);
    last = k;
  }
  std::string input = std::to_string(first + 1);
  if (last > first) input += (last == first + 1 ? ", " : " … ") + std::to_string(last + 1);
  return {input, of_errors ? names + " against the reference or the other half" : "views: " + names};
}

/// The views that have no digit.
HelpLine line_of_other_views() {
  std::string names;
  for (int k = keyed_views; k < view_count; ++k) names += (names.empty() ? "" : ", ") + std::string(view_entry(k).name);
  return {"Buttons, Ctrl + K", "more views: " + names};
}

/// A new line of the help table, or the end of the last one.
void add_line(std::vector<HelpLine>& lines, const Command& command) {
  const std::string effect = command.name + (command.help.empty() ? "" : ": " + command.help);
  const std::string other = text_of(command.other_key),
                    keys = text_of(command.key) + (other.empty() ? "" : ", " + other);
  if (command.is(beside_previous))
    lines.back().input += ", " + text_of(command.key), lines.back().effect += ", " + effect;
  else
    lines.push_back({keys, effect});
}

std::string name_of_row(const RowEntry& row) {
  if (row.label.empty()) return "go to: " + row.part;
  if (row.part != "Background") return "go to: " + row.label;
  std::string label = row.label;
  label[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(label[0])));
  return "go to: Background " + label;
}

/// Collects rows, one of each label in a part.
class RowList {
 public:
  /// who: what must be selected for it, "fog"; of other parts than Object what to do first; "": the column has it now.
  void add(RowEntry row, const std::string& who = "") {
    const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const ListedRow& one) {
      return one.row.part == row.part && one.row.label == row.label;
    });
    if (found == rows_.end())
      rows_.push_back({std::move(row), who});
    else if (!found->missing.empty() && found->missing.find(who) == std::string::npos)
      found->missing += " or " + who;
  }
  void add(const char* part, const Row& row, const std::string& who) { add({part, row.label, row.words, ""}, who); }
  void add(const char* part, const Slot& slot, const std::string& who) {
    add({part, slot.label, slot.synonyms, ""}, slot.given ? who : who + " that moves");
  }
  /// The fields of a kind.
  template <class Kind>
  void add_kind(const char* part, const std::string& who) {
    if constexpr (requires { fields(static_cast<const Kind*>(nullptr)); }) {
      const Kind kind{};
      each_in("", kind, [&](const Slot& slot, const Kind&) { return add(part, slot, who), false; });
    }
  }
  std::vector<ListedRow> take() {
    for (ListedRow& one : rows_)
      if (one.row.part == "Object" && !one.missing.empty()) one.missing = "select " + one.missing + " first";
    return std::move(rows_);
  }

 private:
  std::vector<ListedRow> rows_;
};

/// What objects and skies of other kinds have.
void add_missing(RowList& rows) {
  rows.add_kind<Metal<>>("Object", "an object of metal");
  rows.add_kind<Dielectric<>>("Object", "an object of glass");
  rows.add("Object", colour_slot("", "albedo", {}), "an object with a colour");
  rows.add("Object", colour_slot("", "radiance", {}), "a lamp with a texture");
  for (const Row* row : {&light_colour_row, &light_power_row, &light_stops_row}) rows.add("Object", *row, "a lamp");
  rows.add_kind<Checker<>>("Object", "an object with a checker texture");
  rows.add_kind<Noise<>>("Object", "an object with a noise texture");
  rows.add_kind<Solid<>>("Object", "an object with a texture of one colour");
  rows.add("Object", texture_file, "an object with a picture as its texture");
  for (const Row* row : {&type_of_material, &material_of_object}) rows.add("Object", *row, "an object with a surface");
  rows.add_kind<Medium<>>("Object", "fog");
  [&]<class... Shapes>(const std::variant<Shapes...>*) {
    (rows.add_kind<Shapes>("Object", std::string("a ") + Shapes::type), ...);
  }(static_cast<const decltype(Solid3d::shape)*>(nullptr));
  rows.add_kind<RotateY>("Object", "an object with a turn");
  rows.add_kind<Translate>("Object", "an object with a shift");
  rows.add("Object", name_of_object, "an object");
  rows.add_kind<Animation>("Film", "give a value a key first: right click on its row");
  rows.add("Background", colour_slot("", "colour", {}), "choose colour as the background's kind first");
  rows.add_kind<Gradient>("Background", "choose gradient as the background's kind first");
  rows.add_kind<Hemispheres>("Background", "choose hemispheres as the background's kind first");
  const char* no_sky = "drop a picture of the sky on the window first";
  rows.add("Background", sky_file, no_sky);
  rows.add_kind<SkyPicture>("Background", no_sky);
}

}  // namespace

const Command& command_named(std::string_view name) {
  const auto found =
      std::find_if(commands().begin(), commands().end(), [&](const Command& c) { return c.name == name; });
  assert(found != commands().end());
  return *found;
}

const Command* command_of_key(int key, Modifiers modifiers) {
  const Key pressed{key, modifiers.control, modifiers.shift};
  for (const Command& command : commands())
    if (key != 0 && !modifiers.alt && (command.key == pressed || command.other_key == pressed)) return &command;
  return nullptr;
}

std::string text_of(const Key& key) {
  if (key.code == 0) return "";
  const auto* named = std::find_if(std::begin(named_keys), std::end(named_keys),
                                   [&](const auto& one) { return one.first == key.code; });
  const bool has_name = named != std::end(named_keys);
  return std::string(key.control ? "Ctrl + " : "") + (key.shift ? "Shift + " : "") +
         (has_name ? named->second : std::string(1, static_cast<char>(key.code)));
}

void log_commands(UiLog& log) {
  for (const Command& command : commands()) {
    if (command.is(unlisted)) continue;
    std::string key = command.key.code != 0 ? text_of(command.key) : "none";
    std::erase(key, ' ');
    log.line(fmt::format("action {} {}", log_name(command.name), key));
  }
}

std::vector<HelpLine> help_lines() {
  std::vector<HelpLine> lines(std::begin(mouse_lines), std::end(mouse_lines));
  for (const Command& command : commands()) {
    if (command.name == "clean view on or off")
      for (HelpLine line : {views_line(false), views_line(true), line_of_other_views()})
        lines.push_back(std::move(line));
    if (command.key.code != 0 && !command.is(shows_view)) add_line(lines, command);
  }
  return lines;
}

std::vector<ListedRow> listed_rows(const std::vector<RowEntry>& drawn) {
  RowList rows;
  for (const RowEntry& row : drawn) rows.add(row);
  for (const Section& one : column_sections())
    if (!one.is(has_tab) && *one.words) rows.add({one.name, "", one.words, one.name});
  add_missing(rows);
  return rows.take();
}

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
