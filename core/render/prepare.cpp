#include "core/render/prepare.h"

#include "core/compile/compile.h"
#include "core/render/caustics.h"
#include "core/specular/find_subpixel_lights.h"
#include "core/targets/scalar.h"

#include <utility>

namespace tyndall {

PreparedScene::PreparedScene(std::shared_ptr<const Scene> scene, RenderScene columns)
    : scene_(std::move(scene)),
      columns_(std::move(columns)),
      textures_(texture_views(columns_)),
      view_(view_of(columns_, textures_)) {
  subpixel_lights_ = find_subpixel_lights(view_);
  view_.subpixel_light_count = static_cast<int>(subpixel_lights_.size());
  view_.subpixel_lights = subpixel_lights_.data();
  if (columns_.may_reuse_paths) reuse_gain_ = probe_reuse(view_, trace_groups);
  view_.reuses_paths = columns_.may_reuse_paths && is_worthwhile(reuse_gain_);
}

double PreparedScene::caustic_chance() const {
  std::call_once(caustic_chance_found_, [this] { caustic_chance_ = chance_of_caustics(*scene_, columns_); });
  return caustic_chance_;
}

std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before) {
  RenderScene columns = compile(*scene, before ? &before->columns() : nullptr);
  return std::make_shared<const PreparedScene>(std::move(scene), std::move(columns));
}

std::shared_ptr<const PreparedScene> prepare(const Scene& scene) {
  return prepare(std::make_shared<const Scene>(scene));
}

}  // namespace tyndall
