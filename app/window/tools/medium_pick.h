#pragma once
#include "app/window/tools/outline.h"

/// Selecting fog with the mouse.
namespace tyndall {

/// The medium that a ray through a point of the image enters first, if it does so before `depth` along the camera's
/// axis; empty: none. A medium that holds the eye is not entered.
ObjectPath medium_at(const Scene& scene, ImagePoint at, double depth);

}  // namespace tyndall
