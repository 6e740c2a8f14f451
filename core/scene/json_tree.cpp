#include "core/scene/json_tree.h"

#include "core/base/text.h"

#include <algorithm>

namespace tyndall {

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

}  // namespace tyndall
