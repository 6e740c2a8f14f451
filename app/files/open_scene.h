#pragma once
#include "app/files/scene_request.h"
#include "core/scene/load.h"

/// This room reads and writes files: scenes as the user asks for them, pictures, films and figures.
namespace tyndall {

/// Loads a scene and applies the options to it: overrides before it is checked, the others after that, and checks
/// again. Tells on standard error how pictures of textures were read, where that should be known. Throws SceneError.
LoadedScene open_scene(const SceneRequest& request);

}  // namespace tyndall
