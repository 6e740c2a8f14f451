#pragma once
#include "core/scene/json_values.h"

#include <filesystem>
#include <memory>
#include <string_view>
#include <unordered_map>

/// Reading of objects and colours, which refer by name to the materials and textures that were read before them. All
/// throw ParseError.
namespace tyndall {

/// Index of each texture or material by its name. The names must outlive it.
using NameTable = std::unordered_map<std::string_view, int>;

struct NameTables {
  NameTable textures, materials;
};

/// The thing that a value names. kind: "material", "texture".
int read_reference(const JsonValue& json, const Place& at, const NameTable& table, const std::string& kind);

/// The colour under colour_name ("albedo" or "radiance"), which must be there: three numbers or a texture's name.
ColourOrTexture read_colour(const JsonObject& object, const Place& at, const char* colour_name,
                            const NameTable& textures);

/// After an override of a material's type: leaves out values that other types have and the new one lacks; its colour
/// stays, under the name that the new type has for it.
void fit_to_type(JsonValue& root, const Override& override_);

/// The scene of a document whose image files were read before: they are taken from a scene that has the same ones.
Scene scene_with_pictures(const JsonValue& root, const Scene& pictures);

/// The picture of a sky. file: as the scene names it, from the folder.
std::shared_ptr<const Image::Pixels> read_sky_pixels(const std::string& file, const std::filesystem::path& folder,
                                                     const Place& at);

std::vector<Object> read_objects(const JsonValue& json, const Place& at, const NameTables& references);

}  // namespace tyndall
