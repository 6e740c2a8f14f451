#include "app/window/command.h"
#include "app/window/accuracy/views.h"

#include <doctest/doctest.h>

#include <set>

namespace tyndall::test::command_test {

TEST_CASE("no two commands have the same name or key, each can be carried out, and other modifiers are none") {
  std::set<std::string> names;
  for (const Command& command : commands()) {
    CHECK_MESSAGE(names.insert(command.name).second, command.name);
    CHECK_MESSAGE(bool(command.run), command.name);
    for (const Key& key : {command.key, command.other_key})
      if (key.code != 0) CHECK(command_of_key(key.code, {key.control, key.shift, false}) == &command);
  }
  for (int k = 0; k < view_count; ++k) CHECK(names.contains(std::string("view: ") + view_entry(k).name));
  for (const int key : {int{'S'}, int{'Z'}, 0}) CHECK_FALSE(command_of_key(key, {}));
  CHECK_FALSE(command_of_key('P', {.control = true, .alt = true}));
  CHECK(command_of_key('Y', {.control = true}) == command_of_key('Z', {.control = true, .shift = true}));
}

TEST_CASE("the help table tells of every command that has a key") {
  std::set<std::pair<std::string, std::string>> lines;
  std::string all;
  for (const HelpLine& line : help_lines()) {
    lines.emplace(line.input, line.effect);
    all += line.effect + "\n";
  }
  for (const auto& [input, effect] : std::initializer_list<std::pair<std::string, std::string>>{
           {"Left drag", "orbit; on a handle of the selection: move, turn, size it"},
           {"Insert, Ctrl + D, Delete, F2", "add an object: at the cursor, duplicate, delete, rename"},
           {"F, Home", "frame the selection, reset the camera"},
           {"Ctrl + Z, Ctrl + Shift + Z", "undo, redo"},
           {"Ctrl + P", "snapshot: PNG and EXR, numbered"},
           {"1 … 7", "views: beauty, albedo, normal, depth, noise, samples, cost"},
           {"8, 9", "error and FLIP against the reference or the other half"},
           {"Buttons, Ctrl + K", "more views: object, false colour"},
           {"F1, H", "this table"}})
    CHECK_MESSAGE(lines.contains({input, effect}), input);
  for (const Command& command : commands()) {
    const std::string name = command.name.substr(command.name.starts_with("view: ") ? 6 : 0);
    if (command.key.code != 0) CHECK_MESSAGE(all.find(name) != std::string::npos, name);
  }
}

}  // namespace tyndall::test::command_test
