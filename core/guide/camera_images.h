#pragma once
#include "core/trace/picture_box.h"
#include "core/trace/scene_view.h"

#include <vector>

namespace tyndall {

/// Boxes around the images of lights that the camera sees straight, or by way of metal of little fuzz after events that
/// the scene's guide knows: as far as the light's size and the fuzz let a path from the light's middle stray. Images in
/// flats and in one sphere are found; what hides their middle hides them. Empty without a guide.
std::vector<PictureBox> find_camera_images(const SceneView& scene);

}  // namespace tyndall
