#pragma once
#include "core/trace/scene_view.h"

/// Finds the guide of a scene.
namespace tyndall {

/// The least Guide::expected_variance with which a guide is made.
inline constexpr double worthwhile_variance = 2;

/// Makes the guide of a scene: a pure function of its geometry, materials and lights. It has lobes only where it pays.
Guide find_guide(const SceneView& scene);

/// Boxes around the images of lights that the camera sees straight, or by way of mirrors and metal of little fuzz: as
/// far as the light's size and the fuzz let a path to the light's middle stray. What hides the middle of an image hides
/// it. Of the first max_guide_lights lights, and at most 64 boxes. Empty without a guide, and for a camera with a lens
/// or with motion blur.
std::vector<PictureBox> find_camera_images(const SceneView& scene);

}  // namespace tyndall
