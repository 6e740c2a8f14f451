#pragma once
#include "app/window/panels/panels.h"
#include "core/scene/slots.h"

#include <functional>
#include <string>

/// Rows of the scene's values, each of which is known by its pointer: the panels are loops over parts of the scene, so
/// a new value of a struct has its row without a line here.
namespace tyndall {

/// The row of a value. meaning: the grey line beneath.
Row row_of(const Slot& slot, std::string meaning);

// Rows that are no single value of the scene, and that some objects or skies have.
extern const Row light_colour_row, light_power_row, light_stops_row, type_of_material, material_of_object,
    name_of_object, texture_file, sky_file;

/// Draws a row, and sets the value in the panels' scene when it was changed.
void slot_row(Ui& ui, PanelState& state, const Slot& slot, const Row& row);

/// Which values have a row, and the grey line beneath one. meaning: what the struct says of it by itself.
using Wanted = std::function<bool(const Slot& slot)>;
using Said = std::function<std::string(const Slot& slot, const std::string& meaning)>;
/// A row for each value of a part that is given. Without `wanted` all have one, without `said` the struct's own line.
void part_rows(Ui& ui, PanelState& state, const std::string& part, const Wanted& wanted = {}, const Said& said = {});

/// The value in that place of the scene's file, where the same thing stands there; nothing: there is none.
std::optional<Value> saved_value(const PanelState& state, const std::string& pointer);

/// "/materials/gold", "/textures/tiles".
std::string material_part(const Material& material);
std::string texture_part(const Texture& texture);
/// "/objects/2", and in a group "/objects/2/objects/0".
std::string object_part(const ObjectPath& path);
/// The steps of an object's transform: "/objects/2/transform/0"; of what bounds a medium:
/// "/objects/2/boundary/transform/0".
std::vector<std::string> transform_parts(const std::string& owner, const Transform& transform);

}  // namespace tyndall
