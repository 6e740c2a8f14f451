#include "core/base/text.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace tyndall {
namespace {

/// The steps of a JSON pointer, with ~0 and ~1 replaced by what they stand for; nothing if the text is no pointer.
std::optional<std::vector<std::string>> pointer_steps(std::string_view pointer) {
  if (!pointer.starts_with('/')) return std::nullopt;
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      steps.emplace_back();
    } else if (pointer[i] == '~') {
      const char code = i + 1 < pointer.size() ? pointer[++i] : ' ';
      if (code != '0' && code != '1') return std::nullopt;
      steps.back() += code == '0' ? '~' : '/';
    } else {
      steps.back() += pointer[i];
    }
  }
  return steps;
}

/// An array's index as RFC 6901 writes it: digits, no leading zero.
std::optional<std::size_t> array_index(std::string_view step) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool whole = error == std::errc() && end == step.data() + step.size();
  if (!whole || (step.size() > 1 && step[0] == '0')) return std::nullopt;
  return index;
}

/// The value one step below; null if there is none.
JsonValue* child(JsonValue& json, const std::string& step) {
  if (auto* object = std::get_if<JsonObject>(&json.value)) {
    const auto at = std::find_if(object->begin(), object->end(), [&](const JsonMember& m) { return m.key == step; });
    return at == object->end() ? nullptr : &at->value;
  }
  auto* array = std::get_if<JsonArray>(&json.value);
  const auto index = array_index(step);
  return array && index && *index < array->size() ? &(*array)[*index] : nullptr;
}

std::string hint(const JsonValue& holder, const std::string& step) {
  const auto* object = std::get_if<JsonObject>(&holder.value);
  if (!object) return "";
  std::vector<std::string_view> keys;
  for (const JsonMember& member : *object) keys.push_back(member.key);
  return did_you_mean(step, keys);
}

std::size_t depth_of(const JsonValue& json) {
  std::size_t deepest = 0;
  if (const auto* array = std::get_if<JsonArray>(&json.value)) {
    for (const JsonValue& item : *array) deepest = std::max(deepest, depth_of(item));
    return deepest + 1;
  }
  const auto* object = std::get_if<JsonObject>(&json.value);
  if (!object) return 0;
  for (const JsonMember& member : *object) deepest = std::max(deepest, depth_of(member.value));
  return deepest + 1;
}

/// A copy of what a text holds, whose memory is its own.
JsonValue root_of(const std::string& text) {
  const JsonDocument document = parse_json(text);
  return document.root;
}

/// The value as JSON. Text that is not JSON stands for a string of that text.
JsonValue override_value(const std::string& text, const std::string& where) {
  try {
    return root_of(text);
  } catch (const ParseError&) {
  }
  try {
    return root_of(in_quotes(text));
  } catch (const ParseError&) {
    throw ParseError{where, "a value that is not UTF-8", "JSON or text"};
  }
}

/// The place for a new or existing member of `holder`.
JsonValue& make_child(JsonValue& holder, const std::string& step, const std::string& where) {
  if (JsonValue* old = child(holder, step)) return *old;
  if (auto* object = std::get_if<JsonObject>(&holder.value)) return object->emplace_back(JsonMember{step, {}}).value;
  auto* array = std::get_if<JsonArray>(&holder.value);
  if (!array) throw ParseError{where, describe(holder) + " as the parent", "an existing object or array as the parent"};
  if (step == "-" || array_index(step) == array->size()) return array->emplace_back();
  throw ParseError{where, "no element " + in_quotes(step) + " in " + describe(holder),
                   "an index below that, or - to append"};
}

}  // namespace

void apply_override(JsonValue& root, const Override& override_) {
  const std::string where = "--set " + override_.pointer;
  const auto steps = pointer_steps(override_.pointer);
  if (!steps)
    throw ParseError{where, "no JSON pointer",
                     "a pointer such as /camera/vfov (in keys, ~1 stands for / and ~0 for ~)"};
  JsonValue* holder = &root;
  std::string path;
  for (std::size_t i = 0; i + 1 < steps->size(); ++i) {
    JsonValue* next = child(*holder, (*steps)[i]);
    path += "/" + pointer_step((*steps)[i]);
    if (!next) throw ParseError{where, "no " + path, "an existing parent" + hint(*holder, (*steps)[i])};
    holder = next;
  }
  JsonValue value = override_value(override_.value, where);
  if (steps->size() + depth_of(value) > max_nesting)
    throw ParseError{where, "brackets nested more than " + std::to_string(max_nesting) + " deep", "a flatter value"};
  make_child(*holder, steps->back(), where) = std::move(value);
}

}  // namespace tyndall
