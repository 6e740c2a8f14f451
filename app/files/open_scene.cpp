#include "app/files/open_scene.h"

#include "core/base/error.h"
#include "core/scene/check.h"

namespace tyndall {
namespace {

void apply(const SceneRequest& request, Scene& scene) {
  if (request.size) {
    scene.width = request.size->width;
    scene.height = request.size->height;
  }
  if (request.max_depth) scene.render.max_depth = *request.max_depth;
  if (request.integrator) scene.render.integrator = *request.integrator;
  if (request.sampler) scene.render.sampler = *request.sampler;
  if (request.fresnel) scene.render.fresnel = *request.fresnel;
  if (request.seed) scene.render.seed = *request.seed;
  if (request.adaptive) scene.render.adaptive = true;
  if (request.exposure) scene.display.exposure = *request.exposure;
  if (request.tone_map) scene.display.tone_map = *request.tone_map;
}

}  // namespace

LoadedScene open_scene(const SceneRequest& request) {
  LoadedScene loaded = load_scene(request.what, request.overrides);
  apply(request, loaded.scene);
  if (const auto broken = check(loaded.scene))
    throw SceneError(loaded.name, broken->where, broken->found, broken->expected);
  return loaded;
}

}  // namespace tyndall
