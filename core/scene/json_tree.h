#pragma once
#include "core/base/choice.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

/// A JSON document as a tree, between text and Scene. Objects keep their order. Measured against nlohmann's trees on a
/// scene of 10^6 spheres and one of 10^5 materials: this one takes 2.7 and 0.63 s, 401 and 79 MB; json, which sorts its
/// objects, 3.7 and 0.99 s, 651 and 104 MB; ordered_json, which searches an object from its start for each new key, 3.8
/// and 31 s, 438 and 67 MB.
namespace tyndall {

/// The memory of a tree. Short lists, of which a scene of a million objects has two millions, are cut from large blocks
/// and given back all together; long ones are on their own.
class JsonMemory {
 public:
  static constexpr std::size_t longest_short = 4096;  ///< bytes

  /// bytes: of a short list, a multiple of 8.
  void* take(std::size_t bytes) {
    if (bytes > free_) {
      blocks_.push_back(std::unique_ptr<std::byte[]>(new std::byte[block]));
      free_ = block;
    }
    return blocks_.back().get() + block - std::exchange(free_, free_ - bytes);
  }

 private:
  static constexpr std::size_t block = std::size_t(1) << 16;  // bytes
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::size_t free_ = 0;  ///< bytes at the end of the last block
};

/// Gives lists the memory of a tree; without one, and in copies, that of the program.
template <class T>
struct JsonAllocator {
  using value_type = T;
  JsonMemory* memory = nullptr;

  JsonAllocator(JsonMemory* of = nullptr) : memory(of) {}
  template <class Other>
  JsonAllocator(const JsonAllocator<Other>& other) : memory(other.memory) {}
  T* allocate(std::size_t count) {
    static_assert(alignof(T) <= 8 && sizeof(T) % 8 == 0);
    const std::size_t bytes = count * sizeof(T);
    return static_cast<T*>(memory && bytes <= JsonMemory::longest_short ? memory->take(bytes) : ::operator new(bytes));
  }
  void deallocate(T* list, std::size_t count) {
    if (!memory || count * sizeof(T) > JsonMemory::longest_short) ::operator delete(list);
  }
  JsonAllocator select_on_container_copy_construction() const { return {}; }
  bool operator==(const JsonAllocator& other) const = default;
};

struct JsonValue;
struct JsonMember;
using JsonArray = std::vector<JsonValue, JsonAllocator<JsonValue>>;
using JsonObject = std::vector<JsonMember, JsonAllocator<JsonMember>>;

struct JsonValue {
  std::variant<std::nullptr_t, bool, double, std::string, JsonArray, JsonObject> value;
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

/// A value of the program as JSON. Numbers that are not finite, and values that are absent, become null.
inline JsonValue to_json(JsonValue value) { return value; }
inline JsonValue to_json(JsonObject object) { return {std::move(object)}; }
inline JsonValue to_json(double number) { return std::isfinite(number) ? JsonValue{number} : JsonValue{}; }
inline JsonValue to_json(bool value) { return {value}; }
inline JsonValue to_json(std::string text) { return {std::move(text)}; }
inline JsonValue to_json(const char* text) { return {std::string(text)}; }
inline JsonValue to_json(const Vec3d& v) { return {JsonArray{{v.x}, {v.y}, {v.z}}}; }
JsonValue to_json(std::integral auto number) { return {static_cast<double>(number)}; }
JsonValue to_json(NamedEnum auto value) { return to_json(name_of(value)); }
template <class T>
JsonValue to_json(const std::optional<T>& value) {
  return value ? to_json(*value) : JsonValue();
}
template <class T>
JsonValue to_json(const std::vector<T>& list) {
  JsonArray array;
  for (const T& value : list) array.push_back(to_json(value));
  return {std::move(array)};
}

template <class T>
void put(JsonObject& out, std::string key, T&& value) {
  out.push_back({std::move(key), to_json(std::forward<T>(value))});
}

/// What a text holds. It stays where it was made, because its values point into its memory; copies of them do not.
struct JsonDocument {
  const std::unique_ptr<JsonMemory> memory;
  JsonValue root;
};

inline constexpr std::size_t max_nesting = 64;
inline constexpr std::size_t max_scene_bytes = std::size_t(256) << 20;

/// The document in a text. Comments are skipped. Throws ParseError, at a pointer or at "line L, column C", for text
/// that is not JSON, duplicate keys, numbers that are not finite, nesting above max_nesting, and texts above
/// max_scene_bytes.
JsonDocument parse_json(std::string_view text);

/// The steps of a JSON pointer (RFC 6901), with ~0 and ~1 replaced by what they stand for; nothing if the text is none.
std::optional<std::vector<std::string>> pointer_steps(std::string_view pointer);

/// The value at the end of these steps; null: there is none.
JsonValue* find_value(JsonValue& root, const std::vector<std::string>& steps);
/// Replaces or adds the value at the end of these steps. Throws ParseError at `where` if there is nothing to hold it.
void put_value(JsonValue& root, const std::vector<std::string>& steps, JsonValue value, const std::string& where);

/// Replaces or adds one value. Throws ParseError at "--set POINTER".
void apply_override(JsonValue& root, const Override& override_);

/// The document that write_scene() writes.
JsonValue scene_json(const Scene& scene);
/// Adds the sections that a scene does not write because they are at their defaults, so that pointers can go into them.
void add_sections(JsonValue& root);
/// The value at a pointer, also where it is not written; nothing: the scene has no such value.
std::optional<JsonValue> value_at_pointer(const Scene& scene, const std::string& pointer);

/// The document as text: two spaces a level, what is short on one line.
std::string print_json(const JsonValue& root);
/// The same with a line for each member, however long it is.
std::string print_members(const JsonObject& root);

/// The value of a key; null if there is none.
const JsonValue* find(const JsonObject& object, std::string_view key);
/// The same in a value, which may be null or no object: then there is none.
const JsonValue* find(const JsonValue* holder, std::string_view key);
/// The text that a value is; "" if it is null or no text.
std::string text_of(const JsonValue* value);

/// "-1", "\"glas\"", "an array of 2 values": for messages.
std::string describe(const JsonValue& json);

}  // namespace tyndall
