#include "core/scene/json_read.h"

#include <algorithm>
#include <charconv>

namespace tyndall {
namespace {

/// All frames of a film have one size.
bool may_have_keys(const std::vector<std::string>& steps) {
  constexpr std::string_view refused[] = {"tyndall", "name", "image", "animation"};
  return std::find(std::begin(refused), std::end(refused), steps[0]) == std::end(refused);
}

int read_frame(const std::string& text, const Place& at) {
  int frame = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
  const bool whole = error == std::errc() && end == text.data() + text.size() && text == std::to_string(frame);
  if (!whole || frame < 0) fail({at, text}, in_quotes(text), "a frame: a whole number from 0 on, as text");
  return frame;
}

std::vector<double> read_numbers(const JsonValue& json, const Place& at) {
  constexpr const char* expected = "a number or an array of numbers";
  if (const auto* number = std::get_if<double>(&json.value)) return {*number};
  std::vector<double> numbers;
  for (const JsonValue& item : array_at(json, at, expected)) {
    const auto* number = std::get_if<double>(&item.value);
    if (!number) fail({at, numbers.size()}, describe(item), "a number");
    numbers.push_back(*number);
  }
  if (numbers.size() < 2) fail(at, describe(json), expected);
  return numbers;
}

KeyedValue read_keyed_value(const JsonMember& member, const Place& at) {
  const auto steps = pointer_steps(member.key);
  if (!steps) fail(at, in_quotes(member.key), "a JSON pointer to a value of the scene, such as /camera/vfov");
  if (!may_have_keys(*steps)) fail(at, in_quotes(member.key), "a value of the camera, a material, an object, …");
  KeyedValue keyed{member.key, {}};
  const JsonObject& keys = object_at(member.value, at, "an object of values by frame, such as { \"0\": 1, \"47\": 2 }");
  for (const JsonMember& key : keys)
    keyed.keys.push_back({read_frame(key.key, at), read_numbers(key.value, {at, key.key})});
  std::sort(keyed.keys.begin(), keyed.keys.end(),
            [](const KeyFrame& a, const KeyFrame& b) { return a.frame < b.frame; });
  return keyed;
}

}  // namespace

Animation read_animation(const JsonValue& json, const Place& at) {
  Animation animation;
  const JsonObject& object = object_at(json, at, "an object with \"frames\" and \"keys\"");
  read_fields(object, at, fields_of<Animation>(), {"keys"}, animation);
  const JsonValue* keys = find(object, "keys");
  if (!keys) return animation;
  const Place here{at, "keys"};
  for (const JsonMember& member : object_at(*keys, here, "an object of keys by JSON pointer"))
    animation.keyed.push_back(read_keyed_value(member, {here, member.key}));
  return animation;
}

}  // namespace tyndall
