#pragma once
#include "app/window/edit/object_list.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

/// Changing what objects are made of, and the background.
namespace tyndall {

/// What an object can be made of, as the window lists it: the kinds of materials, and glass with media within.
std::span<const char* const> surface_types();
/// The number in surface_types() of an object with a surface; -1: it has none.
int surface_type(const Scene& scene, const ObjectPath& path);
/// Why the object cannot be of that type: one line; "": it can.
std::string why_not(const Scene& scene, const ObjectPath& path, int type);
/// Materials, by their names, as they were before they were given another type: the last of each kind, since the scene
/// was opened.
using MaterialMemory =
    std::map<std::string, std::array<std::optional<Material>, std::variant_size_v<MaterialKinds<double>>>>;
/// Gives the object's material another type; its colour stays as far as both types have one, and what else the new type
/// has is as it was when the material was of that type. All objects with that material change. Fog within is a medium
/// behind the object in its list, which goes again with another type; an object that shared its material gets its own
/// then, unless that is glass already. Returns where the object is afterwards.
ObjectPath set_surface_type(Scene& scene, const ObjectPath& path, int type, MaterialMemory& memory);

/// Gives the object a material of its own, a copy of the present one with a new name. Nothing happens if no other
/// object has it.
void make_single_user(Scene& scene, const ObjectPath& path);

/// A light's radiance as a colour, whose largest component is 1, times power.
struct LightColour {
  Vec3d colour{1, 1, 1};
  double power = 0;
};
LightColour light_colour(Vec3d radiance);
/// The radiance of a colour and a power; only the proportions of the colour count.
Vec3d light_radiance(LightColour light);

/// The backgrounds of each kind that the user has seen since the scene was opened.
using BackgroundMemory = std::array<std::optional<Background>, std::variant_size_v<Background>>;
/// Gives the background another kind (its place in the variant): with the colours that it had when it was of that kind,
/// else with those of the present one.
void set_background_kind(Background& background, int kind, BackgroundMemory& memory);

}  // namespace tyndall
