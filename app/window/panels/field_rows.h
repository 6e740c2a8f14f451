#pragma once
#include "app/window/panels/meaning.h"
#include "app/window/panels/widgets.h"
#include "core/base/choice.h"
#include "core/scene/place.h"

#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

/// Rows for the values that a struct lists in fields(): the panels are loops over them, so a new value has its row
/// without a line here.
namespace tyndall {

inline Row row_of(const char* name, const Meaning& meaning, std::string meaning_text) {
  return {name, label_of(name), meaning.valid, meaning.slider, meaning.unit, meaning.help, std::move(meaning_text)};
}
template <class Owner, class T>
Row row_of(const Field<Owner, T>& field, std::string meaning_text) {
  return row_of(field.name, meaning_of(field), std::move(meaning_text));
}

inline bool value_row(Ui& ui, const Row& row, double& value) { return slider_row(ui, row, value); }

/// Whole numbers.
template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) bool value_row(Ui& ui, Row row, T& value) {
  auto number = static_cast<double>(value);
  row.whole = true;
  row.valid.high = std::min(row.valid.high, static_cast<double>(std::numeric_limits<T>::max()));
  if (!slider_row(ui, row, number)) return false;
  value = static_cast<T>(std::llround(number));
  return true;
}

/// A number that may be absent: 0 stands for that.
inline bool value_row(Ui& ui, Row row, std::optional<int>& value) {
  int number = value.value_or(0);
  row.valid.low = 0;
  if (!value_row(ui, std::move(row), number)) return false;
  value = number > 0 ? std::optional(number) : std::nullopt;
  return true;
}

inline bool value_row(Ui& ui, const Row& row, bool& value) {
  static constexpr Choice choices[] = {{"off"}, {"on"}};
  int chosen = value ? 1 : 0;
  if (!choice_row(ui, row, choices, chosen)) return false;
  value = chosen == 1;
  return true;
}

/// Buttons for the values of an enum. An approximation says so beneath.
template <NamedEnum E>
bool value_row(Ui& ui, Row row, E& value) {
  std::vector<Choice> choices;
  for (int k = 0; k < count_of<E>(); ++k)
    choices.push_back({name_of(static_cast<E>(k)), nullptr, label(static_cast<E>(k)).help});
  int chosen = static_cast<int>(value);
  row.warning = label(value).approximation;
  if (row.warning) row.meaning = std::string("approximation: ") + label(value).help;
  if (!choice_row(ui, row, choices, chosen)) return false;
  value = static_cast<E>(chosen);
  return true;
}

/// Vectors with a slider are colours; all others are places, which are dragged by the size of the scene.
inline bool value_row(Ui& ui, Row row, Vec3d& value) {
  if (has_slider(row.slider)) return colour_row(ui, row, value);
  row.slider = {-ui.size, ui.size};
  return vector_row(ui, row, value);
}
/// What is not given has no row.
template <class T>
bool value_row(Ui& ui, const Row& row, std::optional<T>& value) {
  return value && value_row(ui, row, *value);
}

/// For field_rows(): the fields whose type is one of T.
template <class... T>
constexpr bool is_any_of(const auto& value, std::string_view) {
  return (std::is_same_v<std::decay_t<decltype(value)>, T> || ...);
}

/// What a double click on a row sets: nothing for choices.
template <class T>
std::optional<Vec3d> original_of(const T& value) {
  if constexpr (std::is_same_v<T, Vec3d>)
    return value;
  else if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
    return Vec3d{static_cast<double>(value), 0, 0};
  else
    return {};
}
template <class T>
std::optional<Vec3d> original_of(const std::optional<T>& value) {
  return value ? original_of(*value) : std::nullopt;
}

/// A row per field for which wanted(value, name) is true; said(name) is the grey line beneath. saved: what the scene's
/// file has, to which a double click goes back; null: it has no such thing, and the defaults count.
template <class Owner, class Wanted, class Said>
void field_rows(Ui& ui, Owner& owner, const Owner* saved, const Wanted& wanted, const Said& said) {
  static const Owner defaults{};
  const Owner& original = saved ? *saved : defaults;
  for_each_field(fields_of<Owner>(), [&](const auto& field) {
    auto& value = owner.*(field.value);
    if (!wanted(value, std::string_view(field.name))) return;
    Row row = row_of(field, said(field.name));
    row.original = original_of(original.*(field.value));
    row.of_scene = true;
    value_row(ui, row, value);
  });
}

/// The same, with the grey lines of meaning(owner, name) where the struct has them.
template <class Owner, class Wanted>
void field_rows(Ui& ui, Owner& owner, const Owner* saved, const Wanted& wanted) {
  field_rows(ui, owner, saved, wanted, [&]([[maybe_unused]] std::string_view name) -> std::string {
    if constexpr (requires { meaning(owner, name); })
      return meaning(owner, name);
    else
      return "";
  });
}

template <class Owner>
void field_rows(Ui& ui, Owner& owner, const Owner* saved) {
  field_rows(ui, owner, saved, [](const auto&, std::string_view) { return true; });
}

/// The same kind in another variant; null if that is of another kind, or null.
template <class Kind, class Variant>
const Kind* same_kind(const Kind&, const Variant* other) {
  return other ? std::get_if<Kind>(other) : nullptr;
}

}  // namespace tyndall
