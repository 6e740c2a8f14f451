#pragma once
#include "core/base/choice.h"
#include "core/base/fields.h"
#include "core/base/text.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

/// Messages about a scene's values: where a value stands, what it means, what was expected. Reading, checking and the
/// command line use the same words.
namespace tyndall {

/// What is wrong with a scene, and where: a JSON pointer, or a line and column.
struct ParseError {
  std::string where, found, expected;
};

/// One override of a value in the file's JSON, applied before validation: pointer "/materials/gold/fuzz", value JSON
/// or, if it is not JSON, a string.
struct Override {
  std::string pointer, value;
};

/// A place in a scene: one step (a key or an index) from the place that holds it. Nothing is copied; the JSON pointer
/// is put together only when a message needs it.
struct Place {
  const Place* parent = nullptr;  ///< must outlive this place; null: the whole scene
  std::string_view key;
  std::size_t index = 0;  ///< counts where key is null

  Place() = default;
  Place(const Place& holder, std::string_view name) : parent(&holder), key(name) {}
  Place(const Place& holder, std::size_t i) : parent(&holder), key(nullptr, 0), index(i) {}
};

/// A key as one step of a JSON pointer (RFC 6901): ~ as ~0, / as ~1.
std::string pointer_step(std::string_view key);
/// The JSON pointer of a place; "/" for the whole scene.
std::string pointer(const Place& place);

/// Throws ParseError.
[[noreturn]] void fail(const Place& place, std::string found, std::string expected);

/// What a number, or each number of a vector, means.
struct Meaning {
  Valid valid;
  const char* unit = "";
  const char* help = "";
  Slider slider = no_slider();
};
template <class Owner, class T>
Meaning meaning_of(const Field<Owner, T>& field) {
  return {field.valid, field.unit, field.help, field.slider};
}

/// Calls visit(field) for each field of a list.
template <class Fields, class Visit>
void for_each_field(const Fields& list, const Visit& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, list);
}

/// What a material's or a medium's colour means. colour_name: its key, "albedo" or "radiance".
Meaning colour_meaning(std::string_view colour_name);

enum class Form { number, whole, vector };

/// A setting's value in a message.
inline std::string setting_text(double value) { return number_text(value); }
inline std::string setting_text(bool value) { return value ? "on" : "off"; }
template <NamedEnum E>
std::string setting_text(E value) {
  return name_of(value);
}
template <class T>
requires(std::is_integral_v<T>) std::string setting_text(T value) { return std::to_string(value); }
template <class T>
std::string setting_text(const std::optional<T>& value) {
  return value ? setting_text(*value) : "not given";
}

/// "a number >= 0 (mean number of events per unit length)".
std::string expected_text(const Meaning& meaning, Form form);

}  // namespace tyndall
