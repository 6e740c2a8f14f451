#include "app/files/open_scene.h"

#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/scene/check.h"

namespace tyndall {

LoadedScene open_scene(const SceneRequest& request) {
  LoadedScene loaded = load_scene(request.what, request.overrides);
  if (request.size) loaded.scene.width = request.size->width, loaded.scene.height = request.size->height;
  apply(request.render, loaded.scene.render);
  apply(request.display, loaded.scene.display);
  if (const auto error = check(loaded.scene))
    throw SceneError(loaded.name, error->where, error->found, error->expected);
  for (const std::string& remark : texture_remarks(loaded.scene)) complain(remark);
  return loaded;
}

}  // namespace tyndall
