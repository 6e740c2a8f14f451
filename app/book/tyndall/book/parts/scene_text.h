#pragma once
#include "maths.h"
#include "program.h"

#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// The scene as it becomes text: Tyndall's JSON (scene.schema.json describes it).
namespace tyndall_book {

/// A parameter for a pointer of any edition: shared_ptr, unique_ptr, a raw pointer, which stays the reader's, a box by
/// value, null.
template <class T>
struct ref : shared_ptr<T> {
  ref() = default;
  ref(std::nullptr_t) {}
  template <class U, class = std::enable_if_t<std::is_base_of<T, U>::value>>
  ref(U* raw) : shared_ptr<T>(raw, [](T*) {}) {}
  template <class U, class = std::enable_if_t<std::is_convertible<const U&, shared_ptr<T>>::value>, class = void>
  ref(const U& other) : shared_ptr<T>(other) {}
  template <class U, class = std::enable_if_t<std::is_base_of<T, U>::value>>
  ref(std::unique_ptr<U>&& other) : shared_ptr<T>(std::move(other)) {}
  operator T*() const { return this->get(); }
};

/// A JSON string.
inline std::string quoted(const std::string& text) {
  const char* digits = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      out += std::string("\\u00") + digits[byte / 16] + digits[byte % 16];
    } else {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
  }
  return out + "\"";
}

/// Reads back as the same number, whatever language the program is set to.
inline std::string number(double value) {
  if (!std::isfinite(value)) refuse("a number of the scene is not finite: " + std::to_string(value));
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(17);
  out << value;
  return out.str();
}

inline std::string triple(const vec3& v) { return "[" + number(v[0]) + "," + number(v[1]) + "," + number(v[2]) + "]"; }

/// Textures, materials and objects as far as they are written.
struct scene_text {
  std::string textures, materials;   ///< members of JSON objects
  std::vector<std::string> objects;  ///< JSON objects
  bool one_sided_lights = false;     ///< light leaves quads only along their normals, as in the third book
  bool has_lights = false, has_images = false;

  /// The quoted name of a texture or material, which is added to `list` when it is asked for first. text: makes it.
  template <class T, class Text>
  std::string name_of(const T& thing, std::string& list, const Text& text) {
    const auto known = names_.find(&thing);
    if (known != names_.end()) return known->second;
    const std::string made = text();
    const std::string kind = class_of(thing);
    const std::string name = quoted(kind + " " + std::to_string(++counts_[kind]));
    list += (list.empty() ? "" : ",\n") + name + ":" + made;
    return names_[&thing] = name;
  }

 private:
  std::map<const void*, std::string> names_;
  std::map<std::string, int> counts_;
};

/// How an object is placed by what encloses it.
struct placing {
  std::vector<std::string> moves;  ///< JSON, innermost first
  bool boundary = false;           ///< of a medium: it is written without a material
  bool flipped = false;            ///< its normals point the other way
};

inline std::string transform_of(const placing& at) {
  std::string moves;
  for (const std::string& move : at.moves) moves += (moves.empty() ? "" : ",") + move;
  return moves.empty() ? "" : ",\"transform\":[" + moves + "]";
}

/// The last object whose function of these headers was called, which a reader's class may have overridden.
inline const void*& base_called() {
  static const void* object = nullptr;
  return object;
}
/// Whether functions are only called to see whose they are.
inline bool& is_probing_answers() {
  static bool probing = false;
  return probing;
}

}  // namespace tyndall_book
