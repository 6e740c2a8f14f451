#include "app/window/palette_list.h"

#include "app/window/command.h"
#include "app/window/panels/rows.h"

#include <algorithm>
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
