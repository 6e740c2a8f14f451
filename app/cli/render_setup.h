#pragma once
#include "app/cli/requests.h"
#include "core/kernel/kernels.h"
#include "core/render/render.h"
#include "core/scene/load.h"

/// Turns what the user asked for into what render() is told.
namespace tyndall {

/// The kernels of an instruction set ("": the best). Throws UsageError if this build or CPU has none of that name.
Kernels find_kernels(const std::string& isa);

/// Limits, region and threads of a render. spp is always set; where only time or error end the render, to most_samples.
/// Throws UsageError for a region beyond the image and for adaptive sampling of a range or of a film that is resumed.
RenderOptions render_options(const RenderCommand& command, const LoadedScene& loaded);

/// With --resume, the film in the .exr output if there is that file; else an empty film. Throws UsageError if it is not
/// of this scene, these settings and this region.
Film film_to_resume(const RenderCommand& command, const LoadedScene& loaded, const RenderOptions& options);

}  // namespace tyndall
