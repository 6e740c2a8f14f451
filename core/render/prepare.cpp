#include "core/render/prepare.h"

#include "core/compile/compile.h"
#include "core/render/caustics.h"

#include <utility>

namespace tyndall {

PreparedScene::PreparedScene(std::shared_ptr<const Scene> scene, RenderScene columns)
    : scene_(std::move(scene)),
      columns_(std::move(columns)),
      textures_(texture_views(columns_)),
      view_(view_of(columns_, textures_)) {
  glints_ = find_glints(view_);
  view_.glint_count = static_cast<int>(glints_.size());
  view_.glints = glints_.data();
  if (columns_.may_share) sharing_gain_ = probe_sharing(view_);
  view_.shares = columns_.may_share && is_worthwhile(sharing_gain_);
}

double PreparedScene::chance_of_caustics() const {
  std::call_once(chance_found_, [this] { chance_ = tyndall::chance_of_caustics(*scene_, columns_); });
  return chance_;
}

std::shared_ptr<const PreparedScene> prepare(std::shared_ptr<const Scene> scene, const PreparedScene* before) {
  RenderScene columns = compile(*scene, before ? &before->columns() : nullptr);
  return std::make_shared<const PreparedScene>(std::move(scene), std::move(columns));
}

std::shared_ptr<const PreparedScene> prepare(const Scene& scene) {
  return prepare(std::make_shared<const Scene>(scene));
}

}  // namespace tyndall
