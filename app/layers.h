#pragma once
#include "core/compile/render_scene.h"
#include "core/film/image_io.h"
#include "core/kernel/kernels.h"

#include <vector>

namespace tyndall {

/// What is seen first through the middle of each pixel, for EXR: albedo, normal (towards the outside of the shape), and
/// depth along the camera's axis. Where nothing is seen: 0, 0 and infinity.
std::vector<Layer> first_hit_layers(const RenderScene& scene, const Region& region, const Kernels& kernels);

}  // namespace tyndall
