#pragma once
#include "app/window/panels/panels.h"
#include "core/scene/scene.h"
#include "core/scene/slots.h"

#include <functional>
#include <string>
#include <string_view>

/// Rows of the scene's values, each of which is known by its pointer: the panels are loops over parts of the scene, so
/// a new value of a struct has its row without a line here.
namespace tyndall {

// What a value means, in words: the grey line beneath a slider. Pure.

/// Fraction of white light, spread over directions as from a bright sky, that a fuzzy metal loses below its surface:
/// fuzz² / 10, which is what it loses at each cosine of incidence, averaged. In [0, 0.1].
double fuzz_loss(double fuzz);
/// Share that Henyey and Greenstein's law sends into the forward half, in [0, 1]; g in (-1, 1).
double forward_fraction(double g);

/// The range of depths that one pixel shows sharp: blur discs of at most a pixel. far is infinite beyond the hyperfocal
/// distance.
struct SharpRange {
  double near = 0, far = 0;
};
SharpRange sharp_range(const Camera& camera, int image_height);

/// The grey line for a field of each struct that has something to say; "" where there is nothing.
std::string meaning(const Metal<>& metal, std::string_view field);
std::string meaning(const Dielectric<>& glass, std::string_view field);
std::string meaning(const Medium<>& medium, std::string_view field);
std::string meaning(const Sphere<>& sphere, std::string_view field);
std::string meaning(const Disk<>& disk, std::string_view field);
std::string meaning(const Camera& camera, std::string_view field);
std::string meaning(const Display& display, std::string_view field);

/// The row of a value. meaning: the grey line beneath.
Row row_of(const Slot& slot, std::string meaning);

// Rows that are no single value of the scene, and that some objects or skies have.
extern const Row light_colour_row, light_power_row, light_stops_row, type_of_material, material_of_object,
    name_of_object, texture_file, sky_file;

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
