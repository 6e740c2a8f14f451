#pragma once
#include <concepts>
#include <optional>
#include <string_view>
#include <vector>

/// Enums whose values have names in scene files, options and panels. Beside such an enum E stands
///
///   constexpr Label label(E value) {
///     switch (value) {
///       case E::first:
///         return {"first", "description of the value"};
///       ...
///     }
///     return {};
///   }
///
/// The switch has no default, so a value without a label does not compile (-Wswitch); all other code loops over the
/// labels. Values count up from 0 without gaps.
namespace tyndall {

/// Name and description of one value of an enum.
struct Label {
  const char* name = nullptr;  ///< as scene files and options spell it; null: there is no such value
  const char* help = "";       ///< a few words; "" where the name says it all
  bool approximation = false;  ///< wrong on purpose: marked wherever it is chosen
};

template <class E>
concept NamedEnum = requires(E value) {
  { label(value) } -> std::same_as<Label>;
};

/// Number of values.
template <NamedEnum E>
constexpr int count_of() {
  int count = 0;
  while (label(static_cast<E>(count)).name) ++count;
  return count;
}

template <NamedEnum E>
constexpr const char* name_of(E value) {
  return label(value).name;
}

/// All names, in the order of the values.
template <NamedEnum E>
std::vector<std::string_view> names_of() {
  std::vector<std::string_view> names;
  for (int i = 0; i < count_of<E>(); ++i) names.emplace_back(name_of(static_cast<E>(i)));
  return names;
}

/// The value of a name; nothing if there is none.
template <NamedEnum E>
constexpr std::optional<E> value_named(std::string_view name) {
  for (int i = 0; i < count_of<E>(); ++i)
    if (name == name_of(static_cast<E>(i))) return static_cast<E>(i);
  return std::nullopt;
}

}  // namespace tyndall
