#pragma once
#include "tests/bench/scenes.h"

#include <filesystem>
#include <vector>

namespace tyndall::bench {

/// Means of a long render of the scene with another seed, 3 floats a pixel. Kept in a file in `folder` whose name holds
/// the scene, its settings and the samples, and read from there the next time. Throws ImageFileError.
std::vector<float> reference_image(const NamedScene& named, int spp, const std::filesystem::path& folder);

}  // namespace tyndall::bench
