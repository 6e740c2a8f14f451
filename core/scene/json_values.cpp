#include "core/scene/json_values.h"

#include <cmath>
#include <limits>

namespace tyndall {
namespace {

template <class T>
T whole_number(const JsonValue& json, const Place& at, const Meaning& meaning) {
  const auto* number = std::get_if<double>(&json.value);
  const bool fits = number && *number == std::floor(*number) &&
                    *number >= static_cast<double>(std::numeric_limits<T>::min()) &&
                    *number <= static_cast<double>(std::numeric_limits<T>::max());
  if (fits) return static_cast<T>(*number);
  Meaning bounded = meaning;
  const bool too_large = number && *number > 0 && *number == std::floor(*number);
  if (too_large) bounded.valid.high = std::min(meaning.valid.high, static_cast<double>(std::numeric_limits<T>::max()));
  fail(at, describe(json), expected_text(bounded, Form::whole));
}

}  // namespace

const JsonObject& object_at(const JsonValue& json, const Place& at, const char* expected) {
  if (const auto* object = std::get_if<JsonObject>(&json.value)) return *object;
  fail(at, describe(json), expected);
}

const JsonArray& array_at(const JsonValue& json, const Place& at, const char* expected) {
  if (const auto* array = std::get_if<JsonArray>(&json.value)) return *array;
  fail(at, describe(json), expected);
}

const std::string& string_at(const JsonValue& json, const Place& at, const std::string& expected) {
  if (const auto* text = std::get_if<std::string>(&json.value)) return *text;
  fail(at, describe(json), expected);
}

const JsonValue& member_at(const JsonObject& object, const Place& at, const char* key, std::string_view expected) {
  if (const JsonValue* json = find(object, key)) return *json;
  fail(at, "no " + in_quotes(key), std::string(expected));
}

void fail_key(const Place& at, std::string_view key, const std::vector<std::string_view>& known) {
  fail({at, key}, "an unknown key", one_of(known) + did_you_mean(key, known));
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, double& out) {
  const auto* number = std::get_if<double>(&json.value);
  if (!number) fail(at, describe(json), expected_text(meaning, Form::number));
  out = *number;
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, int& out) {
  out = whole_number<int>(json, at, meaning);
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, std::uint32_t& out) {
  out = whole_number<std::uint32_t>(json, at, meaning);
}

void read_value(const JsonValue& json, const Place& at, const Meaning& meaning, Vec3d& out) {
  const auto* array = std::get_if<JsonArray>(&json.value);
  if (!array || array->size() != 3) fail(at, describe(json), expected_text(meaning, Form::vector));
  double* const components[3] = {&out.x, &out.y, &out.z};
  for (std::size_t i = 0; i < 3; ++i) read_value((*array)[i], {at, i}, meaning, *components[i]);
}

void read_value(const JsonValue& json, const Place& at, const Meaning&, bool& out) {
  const bool* value = std::get_if<bool>(&json.value);
  if (!value) fail(at, describe(json), "true or false");
  out = *value;
}

std::string_view type_at(const JsonObject& object, const Place& at, std::vector<std::string_view> (*types)()) {
  const JsonValue* json = find(object, "type");
  if (!json) fail(at, "no \"type\"", one_of(types()));
  if (const auto* type = std::get_if<std::string>(&json->value)) return *type;
  fail({at, "type"}, describe(*json), one_of(types()));
}

void fail_type(const Place& at, std::string_view found, const std::vector<std::string_view>& types) {
  fail({at, "type"}, in_quotes(shortened(found, 80)), one_of(types) + did_you_mean(found, types));
}

}  // namespace tyndall
