#pragma once
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <optional>

namespace tyndall {

/// The first broken rule of a scene, or nothing. Rules that no single value shows: degenerate quads, boxes with
/// min >= max, media with moving or inward boundaries, image textures on media, camera without a direction or parallel
/// to vup, shutter backwards, lights without light are allowed, indices in range, every number finite and in its
/// fields() range. So a scene that was edited in memory can be checked like one that was read.
std::optional<Broken> check(const Scene& scene);

}  // namespace tyndall
