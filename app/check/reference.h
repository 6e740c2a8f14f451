#pragma once
#include "core/image/image.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tyndall {

/// A picture rendered to measure another one against.
struct Reference {
  LinearImage image;
  std::vector<float> variance;  ///< of each number of the image, from two halves of the samples
};

/// What is spent on a reference at most, but for its first samples.
struct ReferenceLimits {
  double seconds = 0;
  std::uint32_t spp = 8192;
};

/// Renders the scene until the noise is small against the difference from `picture`, which has the scene's size, or
/// a limit is reached. go_on: asked now and then; false ends it. Pixels share no paths, so that their errors are
/// independent.
Reference render_reference(Scene scene, const LinearImage& picture, const ReferenceLimits& limits,
                           const std::function<bool()>& go_on);

}  // namespace tyndall
