#pragma once
#include "core/scene/scene.h"

#include <string>
#include <vector>

/// How messages name things of a scene: by their names in the file, or by kind and place.
namespace tyndall {

/// `"ball" (glass)`: what an object is called, or else its place in the file, and its material. path: of indices, as in
/// Elements::object.
std::string object_text(const Scene& scene, const std::vector<int>& path);

}  // namespace tyndall
