#pragma once
#include "core/scene/json_tree.h"
#include "core/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

/// Values of a scene by their JSON pointers.
namespace tyndall {

/// Adds the sections that a scene does not write because they are at their defaults, so that pointers can go into them.
void add_sections(JsonValue& root);
/// A setting that is not written because it is at its default; nothing: there is no such setting. root: the scene's
/// document.
std::optional<JsonValue> unwritten_value(const Scene& scene, JsonValue& root, std::vector<std::string> steps);

/// The value at a pointer, also where it is not written; nothing: the scene has no such value.
std::optional<JsonValue> value_at_pointer(const Scene& scene, const std::string& pointer);
/// The scene with another value there. Throws ParseError if it has no place, or the scene is then not valid.
Scene with_value(const Scene& scene, const std::string& pointer, JsonValue value);

}  // namespace tyndall
