#include "app/window/command.h"
#include "app/window/menus/menu.h"
#include "tests/app/window/panels/column.h"
#include "tests/support/skies.h"

#include <set>
#include <sstream>

namespace tyndall::test::palette_list_test {

namespace {

/// A scene with every kind of object, material, texture and step of a transform.
Scene varied_scene() {
  Scene scene;
  const auto pixels = std::make_shared<const Image::Pixels>(Image::Pixels{1, 1, {9, 9, 9}});
  scene.textures = {
      {"tiles", Checker<>{}}, {"stone", Noise<>{}}, {"plain", Solid<>{}}, {"photo", Image{"a.png", pixels}}};
  scene.materials = {{"gold", Vec3d{0.9, 0.6, 0.3}, Metal<>{0.2}},   {"glass", {}, Dielectric<>{1.5}},
                     {"matt", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"floor", TextureIndex{0}, Lambertian<>{}},
                     {"wall", TextureIndex{1}, Metal<>{0.5}},        {"paint", TextureIndex{2}, Lambertian<>{}},
                     {"globe", TextureIndex{3}, Lambertian<>{}},     {"lamp", Vec3d{4, 4, 4}, Light<>{}},
                     {"screen", TextureIndex{3}, Light<>{}}};
  const Sphere<> round{{0, 0, 0}, 0.7, {}};
  scene.objects = {solid(round, {}, 0),
                   solid(Box<>{}, {}, 0),
                   solid(round, {Translate{{1, 0, 0}}}, 1),
                   solid(Sphere<>{{2, 0, 0}, 0.5, Vec3d{2, 1, 0}}, {}, 2),
                   solid(Quad<>{}, {}, 3),
                   solid(Box<>{}, {RotateY{30}}, 4),
                   solid(round, {}, 5),
                   solid(round, {}, 6),
                   solid(Quad<>{}, {}, 7),
                   solid(Quad<>{}, {}, 8),
                   {"", Volume{Box<>{}, {RotateY{10}}, Medium<>{1.1, 0}, Vec3d{1, 1, 1}}, {}},
                   {"", Volume{round, {}, Medium<>{1.1, 0}, TextureIndex{0}}, {}},
                   solid(Disk<>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.5}, {}, 2),
                   {"group", Group{{solid(round, {}, 2)}}, {Translate{}}}};
  const char* names[] = {"gold",  "gold box", "glass",  "matt", "floor",     "wall", "paint",
                         "globe", "lamp",     "screen", "fog",  "tiled fog", "ring"};
  for (std::size_t k = 0; k < std::size(names); ++k) scene.objects[k].name = names[k];
  return scene;
}

/// The column over the varied scene.
struct VariedColumn : TestColumn {
  VariedColumn() {
    saved = varied_scene();
    scene() = saved;
    draw(3);
  }
  /// What the palette lists while this is selected.
  std::vector<ListedRow> rows(const ObjectPath& selected) {
    state.selected = selected;
    return listed_rows(all_rows());
  }
  ListedRow row_named(const std::string& label, const std::string& part = "Object", const ObjectPath& selected = {}) {
    const auto all = rows(selected);
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& one) { return one.row.label == label && one.row.part == part; });
    REQUIRE_MESSAGE(found != all.end(), label);
    return *found;
  }
  void go(const RowEntry& row) {
    problem.clear();
    ui.edit = {};
    seek_row(ui, {row.part, row.label});
    draw(7);
  }
};

/// Words that are divided by ", ".
std::vector<std::string> split(const std::string& words) {
  std::vector<std::string> result;
  std::istringstream parts(words);
  for (std::string word; std::getline(parts >> std::ws, word, ',');) result.push_back(word);
  return result;
}
/// What Return carries out when this is typed.
std::string first_found(const std::vector<PaletteItem>& items, const std::string& typed) {
  const std::vector<int> found = matching_items(items, typed);
  return found.empty() ? "" : items[static_cast<std::size_t>(found[0])].label;
}

}  // namespace

TEST_CASE("items are found by all words, in any order and case, other words too; those that begin so come first") {
  const std::vector<PaletteItem> items{{"save the scene", "Ctrl + S", "", {"save the scene"}},
                                       {"save as", "", "", {"save as"}},
                                       {"add a lamp", "", "", {"add a lamp"}},
                                       {"undo", "Ctrl + Z", "", {"undo"}}};
  CHECK(matching_items(items, "") == std::vector<int>{0, 1, 2, 3});
  CHECK(matching_items(items, "SAVE") == std::vector<int>{0, 1});
  CHECK(matching_items(items, "scene save") == std::vector<int>{0});
  CHECK(matching_items(items, "a") == std::vector<int>{2, 0, 1});
  CHECK(matching_items(items, "nothing").empty());
  const std::vector<PaletteItem> others{
      {"larger text", "", "font size, preferences"}, {"full screen", "", ""}, {"size of the film", "", ""}};
  CHECK(matching_items(others, "font") == std::vector<int>{0});
  CHECK(matching_items(others, "larger font") == std::vector<int>{0});
  CHECK(matching_items(others, "size") == std::vector<int>{2, 0});
  CHECK(matching_items({{"clean view on or off", "", "denoise"}, {"view: noise", "", ""}}, "view noise") ==
        std::vector<int>{1, 0});
}

TEST_CASE("what cannot be done in a menu is passed over by keys, and does nothing when it is clicked") {
  NullImGui imgui;
  Ui ui;
  Menu menu;
  std::optional<Request> chosen;
  const auto draw = [&] {
    imgui.frame([&] {
      if (const auto now = menu.draw(ui, {0, 0, 900, 700})) chosen = now;
    });
  };
  menu.open(100, 100, "ball", {{"no", "", "it cannot"}});
  draw();
  for (float y = 100; y < 200; y += 3) {
    compat::mouse_pos(ImGui::GetIO(), 130, y);
    for (const bool down : {true, false}) {
      compat::mouse_button(ImGui::GetIO(), 0, down);
      draw();
    }
  }
  CHECK_FALSE(chosen);
  menu.open(100, 100, "ball", {{"no", "", "it cannot"}, {"undo", "", ""}});
  CHECK(menu.take_key(264));  // down
  CHECK(menu.take_key(257));  // Enter
  draw();
  CHECK(chosen == Request{"undo"});
}

TEST_CASE("the words of other programs lead to the action or row that is meant there") {
  const std::pair<const char*, const char*> meant[] = {{"split view", "split, A/B"},
                                                       {"full screen", "fullscreen, full-screen, Full Screen"},
                                                       {"clean view on or off", "denoise"},
                                                       {"snapshot", "screenshot, screen shot"},
                                                       {"undo", "undo"},
                                                       {"refine a rectangle first", "render region"},
                                                       {"save as", "save as"},
                                                       {"go to: Refractive index", "ior, index of refraction"},
                                                       {"go to: Fuzz", "roughness"},
                                                       {"go to: Defocus", "aperture, f-stop, depth of field"},
                                                       {"go to: Power", "emission, intensity"},
                                                       {"go to: Field of view", "fov, focal, focal length"},
                                                       {"go to: Focus", "focus distance"},
                                                       {"go to: Exposure", "exposure"},
                                                       {"go to: Depth", "bounces"},
                                                       {"go to: Limit", "samples, spp"},
                                                       {"go to: Albedo", "albedo, color, base colour"},
                                                       {"go to: Density", "density"},
                                                       {"go to: Asymmetry g", "anisotropy"},
                                                       {"go to: Image size", "resolution"},
                                                       {"go to: Threads", "threads"},
                                                       {"go to: Tone map", "tone mapping"},
                                                       {"go to: Hole", "inner radius"},
                                                       {"go to: Background kind", "environment"},
                                                       {"go to: Histogram", "histogram"},
                                                       {"view: noise", "noise"},
                                                       {"view: false colour", "false color"},
                                                       {"go to: Render", "render"},
                                                       {"open: cover", "cover"}};
  VariedColumn column;
  const std::vector<PaletteItem> items = palette_items(column.rows({}), {"cover", "showroom"});
  for (const auto& [label, words] : meant)
    for (const std::string& word : split(words)) CHECK_MESSAGE(first_found(items, word) == label, word);
}

TEST_CASE("no two lines of the palette have the same name, and each other word leads to its own line") {
  VariedColumn column;
  for (const ObjectPath& selected : {ObjectPath{}, ObjectPath{0}, ObjectPath{10}}) {
    std::set<std::string> labels;
    const std::vector<PaletteItem> items = palette_items(column.rows(selected), {});
    for (const PaletteItem& item : items) {
      CHECK_MESSAGE(labels.insert(item.label).second, item.label);
      CHECK_MESSAGE((!item.label.starts_with("go to:") || !item.also.empty()), item.label);
      for (const std::string& word : split(item.also)) CHECK_MESSAGE(first_found(items, word) == item.label, word);
    }
  }
}

TEST_CASE("the palette has every row that is drawn; it takes the keyboard, or it is said what to do first") {
  VariedColumn column;
  column.scene().animation.emplace();
  std::set<std::string> reached, all;
  for (int k = -1; k < static_cast<int>(column.scene().objects.size()); ++k) {
    column.select(k < 0 ? ObjectPath{} : ObjectPath{k});
    std::vector<RowEntry> drawn;
    column.ui.rows = &drawn;
    column.draw();
    column.ui.rows = nullptr;
    CHECK(drawn.size() > 30);
    std::set<std::string> listed;
    for (const auto& [row, missing] : column.rows(column.state.selected)) {
      const std::string name = row.part + ": " + row.label;
      column.go(row);
      CHECK_MESSAGE(missing.empty() == column.problem.empty(), k, ": ", name);
      if (row.part != "Background") all.insert(name);
      if (!missing.empty()) continue;
      CHECK_MESSAGE((row.label.empty() || column.has_keyboard() || column.ui.sought.has_keys), name);
      listed.insert(name);
    }
    for (const RowEntry& row : drawn) CHECK_MESSAGE(listed.contains(row.part + ": " + row.label), k, ": ", row.label);
    reached.merge(listed);
  }
  CHECK(std::includes(reached.begin(), reached.end(), all.begin(), all.end()));
}

TEST_CASE("the rows of each kind of background are reached") {
  VariedColumn column;
  for (const auto& [background, label] : {std::pair<Background, const char*>{Gradient{}, "Top"},
                                          {Gradient{}, "Bottom"},
                                          {Hemispheres{}, "Above"},
                                          {Hemispheres{}, "Below"},
                                          {uniform_sky(1, 1, 1), "Turn"}}) {
    column.scene().background = background;
    column.go({"Background", label, "", ""});
    CHECK(column.problem.empty());
    CHECK(column.has_keyboard());
  }
}

TEST_CASE("a row in a folded section, far down, is opened and scrolled to, and what is typed goes into it") {
  VariedColumn column;
  column.height = 420;
  for (const char* section : {"Gold", "Camera", "Render"}) column.ui.folded.insert(section);
  column.select({0});
  const auto type = [&](const char* label, const char* part, const char* text) {
    column.go({part, label, "", ""});
    column.write(text);
    column.press(ImGuiKey_Enter);
  };
  type("Seed", "Render", "77");
  CHECK(column.scene().render.seed == 77);
  CHECK(column.has("render.seed"));
  CHECK(column.lit() == "Render");
  CHECK_FALSE(column.ui.folded.contains("Render"));
  CHECK(column.ui.folded.contains("Camera"));
  type("Fuzz", "Object", "0.75");
  CHECK(column.fuzz() == 0.75);
  CHECK(column.has("gold.fuzz"));
  column.scene().objects[0].transform = {RotateY{30}, RotateY{5}};
  type("Turn", "Object", "45");  // the first of two
  CHECK(column.scene().objects[0].transform == Transform{RotateY{45}, RotateY{5}});
  type("Up", "Camera", "0.5");  // a row that the column hides as long as up is up
  CHECK(column.scene().camera.vup.x == 0.5);
}

TEST_CASE("while nothing is selected the row is that of the first object that is shown; the others stay folded") {
  VariedColumn column;
  for (const char* title : {"Gold", "Glass", "Fog"}) column.ui.folded.insert(title);
  column.go(column.row_named("Refractive index").row);
  CHECK_FALSE(column.ui.folded.contains("Glass"));
  CHECK(column.ui.folded.contains("Gold"));
  CHECK(column.ui.folded.contains("Fog"));
  CHECK(column.row_named("Density").row.owner == "Fog");
  CHECK(column.row_named("Density", "Object", {0}).missing == "select fog first");
  CHECK(column.row_named("Fuzz", "Object", {2}).missing == "select an object of metal first");
  CHECK(column.row_named("Edge u", "Object", {2}).missing == "select a quad or a triangle or a disk first");
}

TEST_CASE("the arrow keys go through the choices of a row that was gone to, until Enter") {
  VariedColumn column;
  column.go(column.row_named("Tone map", "Image").row);
  REQUIRE(column.ui.sought.has_keys);
  column.press(ImGuiKey_RightArrow);
  CHECK(column.scene().display.tone_map == ToneMap::aces);
  column.press(ImGuiKey_LeftArrow);
  column.press(ImGuiKey_LeftArrow);  // there is none before the first
  CHECK(column.scene().display.tone_map == ToneMap::srgb);
  column.press(ImGuiKey_Enter);
  CHECK_FALSE(column.ui.sought.has_keys);
  column.press(ImGuiKey_RightArrow);
  CHECK(column.scene().display.tone_map == ToneMap::srgb);
  column.select({0});
  column.go(column.row_named("Material", "Object", {0}).row);
  column.press(ImGuiKey_DownArrow);
  CHECK(std::get<Solid3d>(column.scene().objects[0].kind).material == 1);
}

}  // namespace tyndall::test::palette_list_test
