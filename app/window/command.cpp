#include "app/window/command.h"

#include "app/window/accuracy/views.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
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
void add_line(std::vector<HelpLine>& lines, const Command& command) {
  const std::string effect = command.name + (command.help.empty() ? "" : ": " + command.help);
  const std::string other = text_of(command.other_key),
                    keys = text_of(command.key) + (other.empty() ? "" : ", " + other);
  if (command.is(beside_previous))
    lines.back().input += ", " + text_of(command.key), lines.back().effect += ", " + effect;
  else
    lines.push_back({keys, effect});
}

}  // namespace

const Command& command_named(std::string_view name) {
  const auto found =
      std::find_if(commands().begin(), commands().end(), [&](const Command& c) { return c.name == name; });
  assert(found != commands().end());
  return *found;
}

const Command* command_of_key(int key, Modifiers modifiers) {
  const auto found = std::find_if(commands().begin(), commands().end(), [&](const Command& c) {
    return is_pressed(c.key, key, modifiers) || is_pressed(c.other_key, key, modifiers);
  });
  return found == commands().end() || modifiers.alt ? nullptr : &*found;
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

}  // namespace tyndall
