#include "app/window/actions.h"

#include "app/window/accuracy/views.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tyndall {
namespace {

// GLFW's numbers for keys that do not type a character.
constexpr int key_escape = 256, key_tab = 258, key_insert = 260, key_delete = 261, key_home = 268, key_f1 = 290,
              key_f2 = 291, key_f11 = 300, key_space = 32;

constexpr ActionEntry entries[] = {
    {Action::deselect, "deselect", {key_escape}},
    {Action::grab, "move the selection", {'G'}, {}, "then X, Y or Z, the mouse or a number; Enter or Esc"},
    {Action::add, "add an object", {key_insert}, {}, "at the cursor"},
    {Action::duplicate, "duplicate", {'D', true}, {}, "", true},
    {Action::remove, "delete", {key_delete}, {}, "", true},
    {Action::rename, "rename", {key_f2}, {}, "", true},
    {Action::own_material, "make single user", {}},
    {Action::add_sphere, "add a sphere", {}},
    {Action::add_hollow_ball, "add a hollow ball", {}},
    {Action::add_box, "add a box", {}},
    {Action::add_quad, "add a quad", {}},
    {Action::add_lamp, "add a lamp", {}},
    {Action::add_fog, "add fog", {}},
    {Action::frame, "frame the selection", {'F'}},
    {Action::reset_camera, "reset the camera", {key_home}, {}, "", true},
    {Action::inspect, "inspect pixels", {'I'}, {}, "value, error and object under the cursor"},
    {Action::replay, "why noisy", {'I', false, true}, {}, "the path that adds most to that pixel", true},
    {Action::actual_size, "actual size", {'0'}, {}, "one pixel for each of the screen's; again: all of it"},
    {Action::refine_first, "refine a rectangle first", {'B', true}, {}, "then drag; again: the whole picture"},
    {Action::store_camera, "store the camera", {}},
    {Action::next_camera, "next stored camera", {}},
    {Action::pause, "pause or go on", {key_space}},
    {Action::restart, "start over", {'R'}, {}, "", true},
    {Action::undo, "undo", {'Z', true}},
    {Action::redo, "redo", {'Z', true, true}, {'Y', true}, "", true},
    {Action::open, "open a file", {'O', true}, {}, "a scene, or an image that Tyndall made"},
    {Action::save, "save the scene", {'S', true}},
    {Action::save_as, "save as", {'S', true, true}, {}, "", true},
    {Action::snapshot, "snapshot", {'P', true}, {}, "PNG and EXR, numbered"},
    {Action::clean, "clean view on or off", {'N'}, {}, "noise filtered away"},
    {Action::clean_beside_raw, "clean beside raw", {'N', false, true}, {}, "", true},
    {Action::split, "split view", {}},
    {Action::reference, "reference picture", {}},
    {Action::export_chart, "export the chart", {}},
    {Action::panels, "hide the panels", {key_tab}},
    {Action::full_screen, "full screen", {key_f11}, {}, "", true},
    {Action::larger_text, "larger text", {'+', true}},
    {Action::smaller_text, "smaller text", {'-', true}, {}, "", true},
    {Action::usual_text, "usual text", {'0', true}, {}, "", true},
    {Action::other_theme, "dark or light theme", {}},
    {Action::quit, "close the window", {'Q', true}},
    {Action::palette, "all actions by name", {'K', true}, {}, "and all rows: ior, roughness, fov"},
    {Action::help, "this table", {key_f1}, {'H'}},
};

constexpr std::pair<Action, const char*> other_words[] = {
    {Action::deselect, "unselect, select none, clear selection"},
    {Action::grab, "move, translate the selection, drag"},
    {Action::add, "new object, create, insert"},
    {Action::duplicate, "copy, clone"},
    {Action::remove, "remove, erase"},
    {Action::rename, "name, object name, title"},
    {Action::own_material, "copy the material, unlink"},
    {Action::add_sphere, "add a ball, sphere, ball"},
    {Action::add_hollow_ball, "hollow glass, bubble"},
    {Action::add_box, "cube, box, add a cube"},
    {Action::add_quad, "plane, quad, add a plane"},
    {Action::add_lamp, "light, lamp, add light, area light"},
    {Action::add_fog, "volume, fog, smoke, mist, add a volume"},
    {Action::frame, "zoom to, centre, center, frame selected, view selected, zoom selected"},
    {Action::reset_camera, "home, reset view"},
    {Action::inspect, "pick, probe, pixel value, eyedropper, color picker"},
    {Action::replay, "path, fireflies, variance, light paths"},
    {Action::actual_size, "1:1, zoom 1:1, 100 %, pixel for pixel"},
    {Action::refine_first, "region, crop, render region, render border, border, region of interest"},
    {Action::store_camera, "bookmark, camera bookmark, save camera"},
    {Action::next_camera, "switch camera, cycle cameras"},
    {Action::pause, "stop, resume, continue, play"},
    {Action::restart, "restart, render again, clear"},
    {Action::undo, "back, revert"},
    {Action::redo, "repeat"},
    {Action::open, "load, import, browse"},
    {Action::save, "write"},
    {Action::save_as, "save a copy, export the scene"},
    {Action::snapshot, "screenshot, export, export image, save image, save picture"},
    {Action::clean, "clean, denoise, denoiser, denoising, filter"},
    {Action::clean_beside_raw, "compare clean and raw, denoise beside raw"},
    {Action::split, "split, split screen, A/B, compare, compare settings, side by side"},
    {Action::reference, "reference, reference image, ground truth, compare with an image, true error"},
    {Action::export_chart, "csv, svg, export csv, save the chart"},
    {Action::panels, "show the panels, show the column, sidebar, toggle sidebar, hide ui"},
    {Action::full_screen, "maximize, maximise"},
    {Action::larger_text, "font size, larger font, bigger text, preferences, settings"},
    {Action::smaller_text, "smaller font"},
    {Action::usual_text, "reset font size"},
    {Action::other_theme, "dark mode, light mode, colours of the window, colors of the window"},
    {Action::quit, "exit, quit"},
    {Action::help, "help, keys, shortcuts, hotkeys, keymap, manual"},
};

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
                                {"Double click on them", "back to what the scene's file has"}};

bool is_pressed(const Key& key, int code, Modifiers modifiers) {
  return code != 0 && key.code == code && key.control == modifiers.control && key.shift == modifiers.shift;
}

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
void add_line(std::vector<HelpLine>& lines, const ActionEntry& entry) {
  if (entry.key.code == 0) return;  // menus have it
  const std::string effect = entry.name + (*entry.help ? ": " + std::string(entry.help) : "");
  if (entry.on_line_of_previous) {
    lines.back().input += ", " + text_of(entry.key);
    lines.back().effect += ", " + effect;
  } else {
    const bool two = entry.other_key.code != 0;
    lines.push_back({text_of(entry.key) + (two ? ", " + text_of(entry.other_key) : ""), effect});
  }
}

}  // namespace

std::span<const ActionEntry> actions() { return entries; }

const char* other_words_for(Action action) {
  for (const auto& [of, words] : other_words)
    if (of == action) return words;
  return "";
}

const ActionEntry* find_action(Action action) {
  const auto found = std::find_if(std::begin(entries), std::end(entries),
                                  [action](const ActionEntry& entry) { return entry.action == action; });
  return found == std::end(entries) ? nullptr : found;
}

std::optional<KeyCommand> command_of_key(int key, Modifiers modifiers) {
  if (modifiers.alt) return {};
  for (const ActionEntry& entry : entries)
    if (is_pressed(entry.key, key, modifiers) || is_pressed(entry.other_key, key, modifiers))
      return KeyCommand{entry.action};
  for (int k = 0; k < keyed_views; ++k)
    if (is_pressed({'1' + k}, key, modifiers)) return KeyCommand{Action::view, k};
  return {};
}

std::string text_of(const Key& key) {
  std::string text = key.control ? "Ctrl + " : "";
  if (key.shift) text += "Shift + ";
  switch (key.code) {
    case key_escape:
      return text + "Esc";
    case key_tab:
      return text + "Tab";
    case key_insert:
      return text + "Insert";
    case key_delete:
      return text + "Delete";
    case key_f2:
      return text + "F2";
    case key_home:
      return text + "Home";
    case key_f1:
      return text + "F1";
    case key_f11:
      return text + "F11";
    case key_space:
      return text + "Space";
    default:
      return text + static_cast<char>(key.code);
  }
}

void log_actions(UiLog& log) {
  for (const ActionEntry& entry : entries) {
    std::string name = entry.name, key = entry.key.code != 0 ? text_of(entry.key) : "none";
    std::erase(key, ' ');
    std::replace(name.begin(), name.end(), ' ', '_');
    log.line(fmt::format("action {} {}", name, key));
  }
}

std::vector<HelpLine> help_lines() {
  std::vector<HelpLine> lines(std::begin(mouse_lines), std::end(mouse_lines));
  for (const ActionEntry& entry : entries) {
    if (entry.action == Action::clean) {
      lines.push_back(views_line(false));
      lines.push_back(views_line(true));
      lines.push_back(line_of_other_views());
    }
    add_line(lines, entry);
  }
  return lines;
}

}  // namespace tyndall
