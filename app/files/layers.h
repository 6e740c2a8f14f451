#pragma once
#include "core/image/image_io.h"
#include "core/render/prepare.h"
#include "core/targets/kernels.h"

#include <vector>

/// What an EXR file holds beside the picture.
namespace tyndall {

/// The layers that an EXR gets beside a picture. Of what is seen first through the middle of each pixel: albedo, normal
/// (towards the outside of the shape), and depth along the camera's axis; 0, 0 and infinity where nothing is seen. From
/// the film's halves: the variance of each pixel's mean, by channel; infinite if a half has no sample.
std::vector<Layer> layers_of(const PreparedScene& scene, const Film& film, const Kernels& kernels);

}  // namespace tyndall
