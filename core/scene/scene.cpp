#include "core/scene/scene.h"

namespace tyndall {
namespace {

/// Whether both cameras see the same. A camera without a lens has everything in focus, wherever it is focused.
bool same_view(const Camera& a, Camera b) {
  if (a.defocus_angle == 0 && b.defocus_angle == 0) b.focus_distance = a.focus_distance;
  return a == b;
}

}  // namespace

SceneChange change_between(const Scene& before, const Scene& after) {
  // By name and one by one, because a copy of a large scene costs more than the comparison. A member that is added to
  // Scene does not compile here until it was decided whether samples depend on it.
  const auto& [name_a, width_a, height_a, camera_a, background_a, render_a, display_a, animation_a, textures_a,
               materials_a, objects_a] = before;
  const auto& [name_b, width_b, height_b, camera_b, background_b, render_b, display_b, animation_b, textures_b,
               materials_b, objects_b] = after;
  RenderSettings render = render_b;
  render.spp = render_a.spp;
  const bool same_things =
      background_a == background_b && textures_a == textures_b && materials_a == materials_b && objects_a == objects_b;
  const bool same = width_a == width_b && height_a == height_b && render_a == render && same_things;
  render.seed = render_a.seed, render.sampler = render_a.sampler;
  const bool same_light = same_things && render_a == render && camera_a.shutter_open == camera_b.shutter_open &&
                          camera_a.shutter_close == camera_b.shutter_close;
  return {!same_view(camera_a, camera_b), !same, !same_light};
}

}  // namespace tyndall
