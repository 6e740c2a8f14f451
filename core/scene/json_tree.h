#pragma once
#include "core/scene/json.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// A JSON document as a tree, between text and Scene. Objects keep their order.
namespace tyndall {

struct JsonMember;
using JsonArray = std::vector<struct JsonValue>;
using JsonObject = std::vector<JsonMember>;

struct JsonValue {
  std::variant<std::nullptr_t, bool, double, std::string, JsonArray, JsonObject> value;
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

inline constexpr std::size_t max_nesting = 64;
inline constexpr std::size_t max_scene_bytes = std::size_t(256) << 20;

/// The document in a text. Comments are skipped. Throws Broken, at a pointer or at "line L, column C", for text that is
/// not JSON, duplicate keys, numbers that are not finite, nesting above max_nesting, and texts above max_scene_bytes.
JsonValue parse_json(std::string_view text);

/// Replaces or adds one value. Throws Broken at "--set POINTER".
void apply_override(JsonValue& root, const Override& override_);

/// The document that write_scene() writes.
JsonValue scene_json(const Scene& scene);

/// The document as text: two spaces a level, what is short on one line.
std::string print_json(const JsonValue& root);

/// The value of a key; null if there is none.
const JsonValue* find(const JsonObject& object, std::string_view key);

/// "-1", "\"glas\"", "an array of 2 values": for messages.
std::string describe(const JsonValue& json);

}  // namespace tyndall
