#include "app/window/command.h"

#include "app/window/accuracy/views.h"

#include <doctest/doctest.h>

#include <set>

namespace tyndall::test::command_test {

namespace {

std::string effect_of(const std::string& input) {
  for (const HelpLine& line : help_lines())
    if (line.input == input) return line.effect;
  return "no such line";
}

}  // namespace

TEST_CASE("each shortcut has one command, with exactly its modifiers") {
  const auto name_of_key = [](int key, Modifiers modifiers) {
    const Command* command = command_of_key(key, modifiers);
    return command ? command->name : "";
  };
  CHECK(name_of_key('Z', {.control = true}) == "undo");
  CHECK(name_of_key('Z', {.control = true, .shift = true}) == "redo");
  CHECK(name_of_key('Y', {.control = true}) == "redo");
  CHECK(name_of_key('S', {.control = true}) == "save the scene");
  CHECK(name_of_key('4', {}) == "view: depth");
  CHECK(name_of_key('S', {}).empty());
  CHECK(name_of_key('Z', {}).empty());
  CHECK(name_of_key('P', {.control = true, .alt = true}).empty());
  CHECK(name_of_key(0, {}).empty());
}

TEST_CASE("no two commands have the same name or key, and each can be carried out") {
  std::set<std::string> names;
  for (const Command& command : commands()) {
    CHECK_MESSAGE(names.insert(command.name).second, command.name);
    CHECK_MESSAGE(bool(command.run), command.name);
    for (const Key& key : {command.key, command.other_key})
      if (key.code != 0) CHECK(command_of_key(key.code, {key.control, key.shift, false}) == &command);
  }
  for (int k = 0; k < view_count; ++k) CHECK(names.contains(std::string("view: ") + view_entry(k).name));
}

TEST_CASE("the help table tells of every command that has a key") {
  CHECK(effect_of("Left drag") == "orbit; on a handle of the selection: move, turn, size it");
  CHECK(effect_of("Insert, Ctrl + D, Delete, F2") == "add an object: at the cursor, duplicate, delete, rename");
  CHECK(effect_of("F, Home") == "frame the selection, reset the camera");
  CHECK(effect_of("Ctrl + Z, Ctrl + Shift + Z") == "undo, redo");
  CHECK(effect_of("Ctrl + P") == "snapshot: PNG and EXR, numbered");
  CHECK(effect_of("1 … 7") == "views: beauty, albedo, normal, depth, noise, samples, cost");
  CHECK(effect_of("8, 9") == "error and FLIP against the reference or the other half");
  CHECK(effect_of("Buttons, Ctrl + K") == "more views: object, false colour");
  CHECK(effect_of("F1, H") == "this table");
  std::string all;
  for (const HelpLine& line : help_lines()) all += line.effect + "\n";
  for (const Command& command : commands()) {
    const std::string name = command.name.substr(command.name.starts_with("view: ") ? 6 : 0);
    if (command.key.code != 0) CHECK_MESSAGE(all.find(name) != std::string::npos, name);
  }
}

}  // namespace tyndall::test::command_test
