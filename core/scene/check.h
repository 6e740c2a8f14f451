#pragma once
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <optional>

/// The rules that every scene must keep before it is rendered, whether it was read from a file or edited in the window.
namespace tyndall {

/// The first rule that a scene breaks, or nothing. Every number must be finite and in the range of its field, also
/// after rounding to single precision; indices must name something; and there are rules between values: a flat shape
/// spans an area, a box has min < max, a medium's boundary rests and faces outward, an image texture lies on no medium,
/// the camera has a direction that is not parallel to vup, the shutter does not close before it opens. It needs no
/// file: a scene that was edited in memory is checked like one that was read.
std::optional<ParseError> check(const Scene& scene);
/// The scene if it breaks none; else throws that ParseError.
Scene checked(Scene scene);

}  // namespace tyndall
