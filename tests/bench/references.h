#pragma once
#include "tests/bench/scenes.h"

#include <filesystem>
#include <vector>

/// References: long renders that the errors of other renders are measured against.
namespace tyndall::bench {

/// The means of a long render of a scene with another seed, 3 floats a pixel. rel_mse: the part of a relMSE against it
/// that is its own noise.
struct Reference {
  std::vector<float> rgb;
  double rel_mse = 0;
};

/// Renders a reference, or reads what an earlier run has left in two files in `folder`, whose names hold the scene, its
/// settings and the number of samples. Throws ImageFileError.
Reference reference_image(const NamedScene& named, int spp, const std::filesystem::path& folder);

}  // namespace tyndall::bench
