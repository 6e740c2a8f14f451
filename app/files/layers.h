#pragma once
#include "core/compile/render_scene.h"
#include "core/image/image_io.h"
#include "core/kernel/kernels.h"

#include <vector>

/// What an EXR file holds beside the picture.
namespace tyndall {

/// What goes with a picture into EXR. Seen first through the middle of each pixel: albedo, normal (towards the outside
/// of the shape), and depth along the camera's axis; where nothing is seen 0, 0 and infinity. From the film's halves:
/// variance of each pixel's mean, by channel; infinite before a sample in each half.
std::vector<Layer> layers_of(const RenderScene& scene, const Film& film, const Kernels& kernels);

}  // namespace tyndall
