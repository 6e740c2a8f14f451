#pragma once
#include "core/trace/scene_view.h"

#include <vector>

/// The guide of a scene: directions from which diffuse surfaces are lit by way of glass, mirrors and metal of little
/// fuzz.
namespace tyndall {

/// The least Guide::expected_variance with which a guide is made.
inline constexpr double worthwhile_variance = 2;

/// Columns of a GuideView, which explains them. Empty where a scene needs no guide.
struct Guide {
  std::int32_t slot_mask = 0;
  float inverse_size[guide_levels] = {};
  std::vector<std::int32_t> cells, events, thing_of;
  std::vector<float> query_probability, weights, lobe, images;
  /// Variance times samples, relative to the squared radiance, that BSDF sampling is expected to have without a guide.
  double expected_variance = 0;
  int light_paths = 0;      ///< how many were traced
  double milliseconds = 0;  ///< taken to make it

  int lobes() const { return static_cast<int>(lobe.size()) / numbers_of_lobe; }
  /// Valid as long as this object.
  GuideView view() const {
    GuideView v;
    v.lobes = lobes(), v.slot_mask = slot_mask;
    for (int level = 0; level < guide_levels; ++level) v.inverse_size[level] = inverse_size[level];
    v.cells = cells.data(), v.query_probability = query_probability.data(), v.events = events.data();
    v.weights = weights.data(), v.lobe = lobe.data(), v.images = images.data(), v.thing_of = thing_of.data();
    return v;
  }
};

}  // namespace tyndall
