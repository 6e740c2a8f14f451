#include "app/window/actions/actions.h"

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
constexpr std::pair<int, const char*> named_keys[] = {
    {key_escape, "Esc"}, {key_tab, "Tab"}, {key_insert, "Insert"}, {key_delete, "Delete"}, {key_home, "Home"},
    {key_f1, "F1"},      {key_f2, "F2"},   {key_f11, "F11"},       {key_space, "Space"}};

constexpr Key no_key{};
constexpr Key plain(int code) { return {code}; }
constexpr Key ctrl(int code) { return {code, true}; }
constexpr Key shift(int code) { return {code, false, true}; }
constexpr Key ctrl_shift(int code) { return {code, true, true}; }

constexpr ActionEntry entries[] = {
    {Action::deselect, "deselect", "unselect, select none, clear selection", plain(key_escape)},
    {Action::grab, "move the selection", "move, translate the selection, drag", plain('G'), no_key,
     "then X, Y or Z, the mouse or a number; Enter or Esc"},
    {Action::add, "add an object", "new object, create, insert", plain(key_insert), no_key, "at the cursor"},
    {Action::duplicate, "duplicate", "copy, clone", ctrl('D'), no_key, "", true},
    {Action::remove, "delete", "remove, erase", plain(key_delete), no_key, "", true},
    {Action::rename, "rename", "name, object name, title", plain(key_f2), no_key, "", true},
    {Action::own_material, "make single user", "copy the material, unlink", no_key},
    {Action::add_sphere, "add a sphere", "add a ball, sphere, ball", no_key},
    {Action::add_hollow_sphere, "add a hollow ball", "hollow glass, bubble", no_key},
    {Action::add_box, "add a box", "cube, box, add a cube", no_key},
    {Action::add_quad, "add a quad", "plane, quad, add a plane", no_key},
    {Action::add_triangle, "add a triangle", "triangle, polygon", no_key},
    {Action::add_disk, "add a disk", "disk, disc, circle, ring, ellipse, annulus", no_key},
    {Action::add_light, "add a lamp", "light, lamp, add light, area light", no_key},
    {Action::add_medium, "add fog", "volume, fog, smoke, mist, add a volume", no_key},
    {Action::frame, "frame the selection", "zoom to, centre, center, frame selected, view selected, zoom selected",
     plain('F')},
    {Action::reset_camera, "reset the camera", "home, reset view", plain(key_home), no_key, "", true},
    {Action::inspect, "inspect pixels", "pick, probe, pixel value, eyedropper, color picker", plain('I'), no_key,
     "value, error and object under the cursor"},
    {Action::replay, "why noisy", "path, fireflies, variance, light paths", shift('I'), no_key,
     "the path that adds most to that pixel", true},
    {Action::actual_size, "actual size", "1:1, zoom 1:1, 100 %, pixel for pixel", plain('0'), no_key,
     "one pixel for each of the screen's; again: all of it"},
    {Action::refine_first, "refine a rectangle first",
     "region, crop, render region, render border, border, region of interest", ctrl('B'), no_key,
     "then drag; again: the whole picture"},
    {Action::store_camera, "store the camera", "bookmark, camera bookmark, save camera", no_key},
    {Action::next_camera, "next stored camera", "switch camera, cycle cameras", no_key},
    {Action::play, "play or stop the film", "play, animate, animation, film", plain('P'), no_key,
     "of values with keys: right click on a row"},
    {Action::key_cameras, "film through the stored cameras", "animate the cameras, camera path, fly through", no_key},
    {Action::pause, "pause or go on", "stop, resume, continue", plain(key_space)},
    {Action::restart, "start over", "restart, render again, clear", plain('R'), no_key, "", true},
    {Action::undo, "undo", "back, revert", ctrl('Z')},
    {Action::redo, "redo", "repeat", ctrl_shift('Z'), ctrl('Y'), "", true},
    {Action::open, "open a file", "load, import, browse", ctrl('O'), no_key, "a scene, or an image that Tyndall made"},
    {Action::save, "save the scene", "write", ctrl('S')},
    {Action::save_as, "save as", "save a copy, export the scene", ctrl_shift('S'), no_key, "", true},
    {Action::snapshot, "snapshot", "screenshot, export, export image, save image, save picture", ctrl('P'), no_key,
     "PNG and EXR, numbered"},
    {Action::clean, "clean view on or off", "clean, denoise, denoiser, denoising, filter", plain('N'), no_key,
     "noise filtered away"},
    {Action::clean_beside_raw, "clean beside raw", "compare clean and raw, denoise beside raw", shift('N'), no_key, "",
     true},
    {Action::split, "split view", "split, split screen, A/B, compare, compare settings, side by side", no_key},
    {Action::reference, "reference picture",
     "reference, reference image, ground truth, compare with an image, true error", no_key},
    {Action::export_chart, "export the chart", "csv, svg, export csv, save the chart", no_key},
    {Action::panels, "hide the panels", "show the panels, show the column, sidebar, toggle sidebar, hide ui",
     plain(key_tab)},
    {Action::full_screen, "full screen", "maximize, maximise", plain(key_f11), no_key, "", true},
    {Action::larger_text, "larger text", "font size, larger font, bigger text, preferences, settings", ctrl('+')},
    {Action::smaller_text, "smaller text", "smaller font", ctrl('-'), no_key, "", true},
    {Action::usual_text, "usual text", "reset font size", ctrl('0'), no_key, "", true},
    {Action::other_theme, "dark or light theme", "dark mode, light mode, colours of the window, colors of the window",
     no_key},
    {Action::quit, "close the window", "exit, quit", ctrl('Q')},
    {Action::palette, "all actions by name", "", ctrl('K'), no_key, "and all rows: ior, roughness, fov"},
    {Action::help, "this table", "help, keys, shortcuts, hotkeys, keymap, manual", plain(key_f1), plain('H')}};

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

const ActionEntry* find_action(Action action) {
  for (const ActionEntry& entry : entries)
    if (entry.action == action) return &entry;
  return nullptr;
}

std::optional<Request> request_of_key(int key, Modifiers modifiers) {
  if (modifiers.alt) return {};
  for (const ActionEntry& entry : entries)
    if (is_pressed(entry.key, key, modifiers) || is_pressed(entry.other_key, key, modifiers))
      return Request{entry.action};
  for (int k = 0; k < keyed_views; ++k)
    if (is_pressed({'1' + k}, key, modifiers)) return Request{Action::view, k};
  return {};
}

std::string text_of(const Key& key) {
  if (key.code == 0) return "";
  const auto* named = std::find_if(std::begin(named_keys), std::end(named_keys),
                                   [&](const auto& one) { return one.first == key.code; });
  const bool has_name = named != std::end(named_keys);
  return std::string(key.control ? "Ctrl + " : "") + (key.shift ? "Shift + " : "") +
         (has_name ? named->second : std::string(1, static_cast<char>(key.code)));
}

void log_actions(UiLog& log) {
  for (const ActionEntry& entry : entries) {
    std::string key = entry.key.code != 0 ? text_of(entry.key) : "none";
    std::erase(key, ' ');
    log.line(fmt::format("action {} {}", log_name(entry.name), key));
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
