#pragma once

/// Whether sharing second vertices between pixels (share.h) pays in a scene.
namespace tyndall {

struct SceneView;

/// What sharing changes in a scene, found from a thousand paths. A pure function of the scene without its seed.
struct SharingGain {
  bool probed = false;  ///< false: too few paths have a second vertex that could be shared
  double variance = 1;  ///< of a sample, over that without sharing
  /// Time of a sample, over that without sharing, as told by the rays: those between the paths count half, because they
  /// only ask whether something is in the way.
  double time = 1;
};
SharingGain probe_sharing(const SceneView& scene);

/// Sharing is worth it where the probe promises at most this product of variance and time. The rest is for what the
/// probe does not count, and for its chance.
inline constexpr double worthwhile_product = 0.8;
inline bool is_worthwhile(const SharingGain& gain) { return gain.variance * gain.time <= worthwhile_product; }

}  // namespace tyndall
