#include "core/scene/json_tree.h"

#include "core/base/text.h"
#include "core/scene/place.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace tyndall {
namespace {

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

/// The value as JSON. Text that is not JSON stands for a string of that text.
JsonValue override_value(const std::string& text, const std::string& where) {
  try {
    const JsonDocument document = parse_json(text);
    return document.root;  // a copy, whose memory is its own
  } catch (const ParseError&) {
    if (!is_utf8(text)) throw ParseError{where, "a value that is not UTF-8", "JSON or text"};
    return {text};
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

constexpr std::size_t width = 150;

/// Whether a member is a list of textures, materials or objects: these get a line each, however short they are.
bool stays_open(const JsonMember& member) {
  const auto* array = std::get_if<JsonArray>(&member.value.value);
  const auto* object = std::get_if<JsonObject>(&member.value.value);
  const bool listed = member.key == "textures" || member.key == "materials" || member.key == "objects";
  return listed && ((array && !array->empty()) || (object && !object->empty()));
}

/// Appends the value in one line; false as soon as the line is full or the value may not be on one.
bool print_line(const JsonValue& json, std::string& line, std::size_t limit) {
  if (line.size() > limit) return false;
  if (const auto* array = std::get_if<JsonArray>(&json.value)) {
    line += '[';
    for (std::size_t i = 0; i < array->size(); ++i) {
      if (i) line += ", ";
      if (!print_line((*array)[i], line, limit)) return false;
    }
    line += ']';
  } else if (const auto* object = std::get_if<JsonObject>(&json.value)) {
    if (object->empty()) line += '{';
    for (const JsonMember& member : *object) {
      line += (&member == object->data() ? "{ " : ", ") + in_quotes(member.key) + ": ";
      if (stays_open(member) || !print_line(member.value, line, limit)) return false;
    }
    line += object->empty() ? "}" : " }";
  } else if (const auto* text = std::get_if<std::string>(&json.value)) {
    line += in_quotes(*text);
  } else {
    line += describe(json);
  }
  return line.size() <= limit;
}

/// Appends the value; its first line begins at `column` and its further lines are indented.
void print(const JsonValue& json, std::string& out, std::size_t indent, std::size_t column, bool open) {
  const auto* array = std::get_if<JsonArray>(&json.value);
  const auto* object = std::get_if<JsonObject>(&json.value);
  const bool is_leaf = !array && !object;
  std::string line;
  // The 1 keeps a place for a comma after the value.
  const std::size_t limit = is_leaf ? line.max_size() : width - std::min(width, column + 1);
  if ((is_leaf || !open) && print_line(json, line, limit)) {
    out += line;
    return;
  }
  const std::string begin = "\n" + std::string(indent + 2, ' ');
  const std::size_t count = array ? array->size() : object->size();
  out += array ? '[' : '{';
  for (std::size_t i = 0; i < count; ++i) {
    out += i ? "," + begin : begin;
    if (array) {
      print((*array)[i], out, indent + 2, indent + 2, false);
      continue;
    }
    const JsonMember& member = (*object)[i];
    const std::string key = in_quotes(member.key) + ": ";
    out += key;
    print(member.value, out, indent + 2, indent + 2 + key.size(), stays_open(member));
  }
  out += '\n' + std::string(indent, ' ') + (array ? ']' : '}');
}

}  // namespace

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

const JsonValue* find(const JsonObject& object, std::string_view key) {
  const auto at = std::find_if(object.begin(), object.end(), [key](const JsonMember& m) { return m.key == key; });
  return at == object.end() ? nullptr : &at->value;
}

const JsonValue* find(const JsonValue* holder, std::string_view key) {
  const auto* object = holder ? std::get_if<JsonObject>(&holder->value) : nullptr;
  return object ? find(*object, key) : nullptr;
}

std::string text_of(const JsonValue* value) {
  const auto* text = value ? std::get_if<std::string>(&value->value) : nullptr;
  return text ? *text : "";
}

std::string describe(const JsonValue& json) {
  if (const auto* number = std::get_if<double>(&json.value)) return number_text(*number);
  if (const auto* text = std::get_if<std::string>(&json.value)) return in_quotes(shortened(*text, 80));
  if (const auto* truth = std::get_if<bool>(&json.value)) return *truth ? "true" : "false";
  if (std::holds_alternative<JsonObject>(json.value)) return "an object";
  const auto* array = std::get_if<JsonArray>(&json.value);
  if (!array) return "null";
  return array->size() == 1 ? "an array of 1 value" : "an array of " + std::to_string(array->size()) + " values";
}

JsonValue* find_value(JsonValue& root, const std::vector<std::string>& steps) {
  JsonValue* value = &root;
  for (const std::string& step : steps) value = value ? child(*value, step) : nullptr;
  return value;
}

void put_value(JsonValue& root, const std::vector<std::string>& steps, JsonValue value, const std::string& where) {
  JsonValue* holder = &root;
  std::string path;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    JsonValue* next = child(*holder, steps[i]);
    path += "/" + pointer_step(steps[i]);
    if (!next) throw ParseError{where, "no " + path, "an existing parent" + hint(*holder, steps[i])};
    holder = next;
  }
  make_child(*holder, steps.back(), where) = std::move(value);
}

void apply_override(JsonValue& root, const Override& override_) {
  const std::string where = "--set " + override_.pointer;
  const auto steps = pointer_steps(override_.pointer);
  if (!steps)
    throw ParseError{where, "no JSON pointer",
                     "a pointer such as /camera/vfov (in keys, ~1 stands for / and ~0 for ~)"};
  JsonValue value = override_value(override_.value, where);
  if (steps->size() + depth_of(value) > max_nesting)
    throw ParseError{where, "brackets nested more than " + std::to_string(max_nesting) + " deep", "a flatter value"};
  put_value(root, *steps, std::move(value), where);
}

std::string print_json(const JsonValue& root) {
  std::string out;
  print(root, out, 0, 0, true);
  return out + '\n';
}

std::string print_members(const JsonObject& root) {
  std::string out;
  for (const JsonMember& member : root) {
    out += (out.empty() ? "{\n  " : ",\n  ") + in_quotes(member.key) + ": ";
    print_line(member.value, out, out.max_size());
  }
  return out + "\n}\n";
}

}  // namespace tyndall
