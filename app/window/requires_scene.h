#pragma once
#include "app/window/actions/actions.h"

namespace tyndall {

/// Whether a request is about a scene, or about rendering it: a picture without one has nothing to answer.
bool requires_scene(const Request& request);

}  // namespace tyndall
