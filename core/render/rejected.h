#pragma once
#include "core/film/film.h"
#include "core/kernel/kernels.h"

#include <cstddef>
#include <vector>

/// Names the samples that had to be left out, so that a user can look at their paths (--replay).
namespace tyndall {

/// A sample that a film left out because it was not finite or out of range. In full-image coordinates.
struct RejectedSample {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
  bool operator==(const RejectedSample&) const = default;
};

/// The first `most` of a film's rejected samples, ordered by row, pixel and index. A film only counts them, so the
/// pixels that have some are sampled once more, by the kernels that made the film: that needs no memory while
/// rendering, and which samples are named does not depend on the order in which threads met them.
std::vector<RejectedSample> find_rejected(const Kernels& kernels, const SceneView& scene, const Film& film,
                                          std::size_t most = 4);

}  // namespace tyndall
