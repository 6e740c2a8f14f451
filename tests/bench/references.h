#pragma once
#include "tests/bench/scenes.h"

#include <filesystem>
#include <vector>

namespace tyndall::bench {

/// Means of a long render of the scene with another seed, 3 floats a pixel, and what part of a relMSE against it is its
/// own noise.
struct Reference {
  std::vector<float> rgb;
  double rel_mse = 0;
};

/// Kept in two files in `folder` whose names hold the scene, its settings and the samples, and read from there the next
/// time. Throws ImageFileError.
Reference reference_image(const NamedScene& named, int spp, const std::filesystem::path& folder);

}  // namespace tyndall::bench
