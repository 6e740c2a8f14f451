#pragma once
#include "core/film/film.h"
#include "core/kernel/kernels.h"

#include <cstddef>
#include <vector>

namespace tyndall {

/// A sample that a film left out, in full-image coordinates.
struct RejectedSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  bool operator==(const RejectedSample&) const = default;
};

/// The first `most` of a film's rejected samples, by pixel, row by row, and by index: the pixels that count some are
/// sampled once more, by the kernels that made the film. So they take no memory and do not depend on who was first.
std::vector<RejectedSample> find_rejected(const Kernels& kernels, const SceneView& scene, const Film& film,
                                          std::size_t most = 4);

}  // namespace tyndall
