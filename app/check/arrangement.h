#pragma once
#include "app/check/reading.h"
#include "app/files/open_scene.h"
#include "core/scene/load.h"

#include <functional>
#include <string>

namespace tyndall {

/// A program's scene with its balls where they lie in a picture.
struct Arrangement {
  LoadedScene loaded;
  std::string words;  ///< which compiler puts them there; "": the one that the program is compiled with
};

/// Programs place balls at random, and where depends on the order in which a compiler computes arguments. If the
/// picture clearly differs from the scene as it was loaded, the program is compiled by other compilers, and the scene
/// that fits is taken. Other scenes are returned as they are. Throws what open_scene() throws where the user interrupts
/// a compiler; go_on: false ends the search.
Arrangement find_arrangement(const PictureNumbers& picture, const SceneRequest& request, LoadedScene loaded,
                             const std::function<bool()>& go_on);

}  // namespace tyndall
