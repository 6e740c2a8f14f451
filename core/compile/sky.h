#pragma once
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

/// The sky's picture as kernels read it, and the distribution by which they sample it as a light.
namespace tyndall {

/// The columns of a picture of the sky. They are empty for other backgrounds. before: those of an earlier scene, whose
/// distribution is taken over if the picture is the same; or null. is_sampled: the integrator samples lights.
SkyColumns sky_columns(const Background& background, bool is_sampled, const SkyColumns* before);

}  // namespace tyndall
