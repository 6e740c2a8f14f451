#include "app/window/actions/actions.h"

#include "app/window/accuracy/views.h"

#include <doctest/doctest.h>

#include <set>

namespace tyndall::test::actions_test {

namespace {

std::string effect_of(const std::string& input) {
  for (const HelpLine& line : help_lines())
    if (line.input == input) return line.effect;
  return "no such line";
}

}  // namespace

TEST_CASE("each shortcut has one action, with exactly its modifiers") {
  CHECK(request_of_key('Z', {.control = true}) == Request{Action::undo});
  CHECK(request_of_key('Z', {.control = true, .shift = true}) == Request{Action::redo});
  CHECK(request_of_key('Y', {.control = true}) == Request{Action::redo});
  CHECK(request_of_key('S', {.control = true}) == Request{Action::save});
  CHECK_FALSE(request_of_key('S', {}).has_value());
  CHECK_FALSE(request_of_key('Z', {}).has_value());
  CHECK_FALSE(request_of_key('P', {.control = true, .alt = true}).has_value());
  CHECK_FALSE(request_of_key(0, {}).has_value());
}

TEST_CASE("no two actions of the list have the same key, and the first nine views have a digit") {
  std::set<Action> seen;
  for (const ActionEntry& entry : actions()) {
    CHECK_MESSAGE(seen.insert(entry.action).second, entry.name);
    for (const Key& key : {entry.key, entry.other_key})
      if (key.code != 0) CHECK(request_of_key(key.code, {key.control, key.shift, false}) == Request{entry.action});
  }
  CHECK(seen.size() == static_cast<std::size_t>(Action::add_medium) + 1);  // the others have lists or arguments
  for (int k = 0; k < keyed_views; ++k) CHECK(request_of_key('1' + k, {}) == Request{Action::view, k});
  CHECK_FALSE(request_of_key('1' + keyed_views, {}).has_value());
}

TEST_CASE("the help table tells of every action and every view") {
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
  for (const ActionEntry& entry : actions())
    if (entry.key.code != 0) CHECK_MESSAGE(all.find(entry.name) != std::string::npos, entry.name);
}

}  // namespace tyndall::test::actions_test
