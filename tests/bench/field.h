#pragma once
#include "core/scene/scene.h"
#include "core/targets/kernels.h"

#include <vector>

/// A scene of many spheres, and rays to trace in it as a path tracer meets them.
namespace tyndall::bench {

/// A field of `count` >= 500 or so lambertian spheres like that of the books' cover: a ground, three large ones, small
/// ones strewn around them, all apart, under the sky. A pure function of the count.
Scene field_of_spheres(int count);

/// `count` rays in the order in which the kernels would trace them: groups of `kernels.lanes` paths that start at the
/// camera, tile by tile, and bounce as if all surfaces were lambertian; a path that leaves is followed by the next one.
/// The scene must consist of spheres at rest. Repeatable.
std::vector<TraceRay> rays_in_path_order(const RenderScene& scene, const Kernels& kernels, std::size_t count);

/// The same rays in random order. Repeatable.
std::vector<TraceRay> shuffled(std::vector<TraceRay> rays);

}  // namespace tyndall::bench
