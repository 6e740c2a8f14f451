#pragma once
#include "app/window/panels/meaning.h"
#include "app/window/panels/widgets.h"

#include <optional>
#include <tuple>

/// Rows for the values that a struct lists in fields(): the panels are loops over them.
namespace tyndall {

template <class Owner, class T>
Row row_of(const Field<Owner, T>& field, std::string meaning_text) {
  return {field.name, label_of(field.name), field.valid, field.slider, field.unit, field.help, std::move(meaning_text)};
}

inline bool value_row(Ui& ui, const Row& row, double& value) { return slider_row(ui, row, value); }

/// Colours are vectors in [0, 1]; all others are places, which are dragged by the size of the scene.
inline bool value_row(Ui& ui, Row row, Vec3d& value) {
  if (row.valid.low == 0 && row.valid.high == 1) return colour_row(ui, row, value);
  row.slider = {-ui.size, ui.size};
  return vector_row(ui, row, value);
}

/// What is not given has no row.
template <class T>
bool value_row(Ui& ui, const Row& row, std::optional<T>& value) {
  return value && value_row(ui, row, *value);
}

/// A row per field for which `wanted(type tag, name)` is true. Meanings come from meaning(owner, name), if there is
/// one for the struct.
template <class Owner, class Wanted>
void field_rows(Ui& ui, Owner& owner, const Wanted& wanted) {
  const auto one = [&](const auto& field) {
    auto& value = owner.*(field.value);
    if (!wanted(value, std::string_view(field.name))) return;
    std::string text;
    if constexpr (requires { meaning(owner, std::string_view()); }) text = meaning(owner, field.name);
    value_row(ui, row_of(field, std::move(text)), value);
  };
  std::apply([&](const auto&... field) { (one(field), ...); }, fields(static_cast<const Owner*>(nullptr)));
}

template <class Owner>
void field_rows(Ui& ui, Owner& owner) {
  field_rows(ui, owner, [](const auto&, std::string_view) { return true; });
}

}  // namespace tyndall
