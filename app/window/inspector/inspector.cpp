#include "app/window/inspector/inspector.h"

#include "app/window/inspector/draw_path.h"
#include "app/window/system/clock.h"
#include "app/window/tools/selection.h"
#include "core/compile/compile.h"
#include "core/render/prepare.h"
#include "core/scene/change.h"

#include <algorithm>

namespace tyndall {
namespace {

constexpr std::uint32_t max_followed = 4096;  // samples of a pixel
constexpr double longest_search = 0.5;        // seconds

}  // namespace

void Inspector::set_on(bool on) {
  on_ = on;
  if (!on) drop_path();
}

bool Inspector::drop_path() {
  ++wanted_;
  return std::exchange(path_, nullptr) != nullptr;
}

std::shared_ptr<Inspector::Shown> Inspector::noisy_path(const std::shared_ptr<const Scene>& scene,
                                                        const PictureClick& at, std::uint32_t samples) {
  const double end = clock_seconds() + longest_search;
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  const RenderScene& compiled = prepared->columns();
  if (at.x >= compiled.width || at.y >= compiled.height) return nullptr;
  auto shown = std::make_shared<Shown>();
  shown->scene = scene;
  shown->found = find_noisy_path(prepared->view(), at.x, at.y, samples, [end] { return clock_seconds() > end; });
  const Vec3f eye = shown->found.path.origin;
  shown->eye = Vec3d{eye.x, eye.y, eye.z} + compiled.origin;
  shown->stops = stops_of(*scene, compiled, shown->found.path);
  return shown;
}

void Inspector::find_path(const RendererPair& renderers, const std::shared_ptr<const Scene>& scene) {
  const auto frame = renderers.latest(Half::current);
  if (!at_ || !scene || !frame) return;
  const bool known = report_ && report_->x == at_->x && report_->y == at_->y;
  const std::uint32_t samples = std::clamp(known ? report_->samples : frame->spp, 1u, max_followed);
  jobs_.run([this, at = *at_, scene, samples, wanted = ++wanted_]() -> JobQueue::Result {
    std::shared_ptr<Shown> shown;
    try {
      shown = noisy_path(scene, at, samples);
    } catch (const std::bad_alloc&) {
      return {};  // no memory is left to find one
    }
    return [this, shown, wanted] {
      if (shown && wanted == wanted_) path_ = shown;
    };
  });
}

bool Inspector::collect(const RendererPair& renderers) {
  const bool found = jobs_.collect();
  const auto report = on_ ? renderers.reply().pixel : nullptr;
  return std::exchange(report_, report) != report || found;
}

/// Finds out what is seen at the pixel, once for each pixel and edit.
void Inspector::look(const Scene& scene, const RendererPair& renderers) {
  const std::pair<int, int> pixel{at_->x, at_->y};
  const std::uint64_t edit = renderers.edit(Half::current);
  if (pixel == seen_at_ && edit == seen_edit_) return;
  seen_at_ = pixel, seen_edit_ = edit;
  seen_ = {};
  const Renderer::Pick pick = renderers.pick(pixel.first, pixel.second);
  const Object* object = find_object(scene, pick.object);
  if (pick.object.empty() || !object) return;
  seen_.object = title_of(scene, pick.object);
  if (const Material* material = material_of(scene, *object)) seen_.material = material->name;
  seen_.depth = pick.depth;
}

void Inspector::draw(Ui& ui, const View& view, const RendererPair& renderers) {
  if (path_ && view.sent && path_->checked != renderers.edit(Half::current)) {
    path_->checked = renderers.edit(Half::current);
    if (change_between(*path_->scene, *view.sent).others) drop_path();  // the camera may look from elsewhere
  }
  if (path_) tyndall::draw_path(ui, view.scene, view.image, view.visible, path_->eye, path_->stops);
  PixelReadout model;
  const bool pixel = on_ && at_ && view.frame;
  if (pixel) {
    look(view.scene, renderers);
    const bool known = report_ && report_->x == at_->x && report_->y == at_->y;
    model =
        pixel_readout(*view.frame, known ? *report_ : PixelReport{.x = at_->x, .y = at_->y}, seen_, view.scene.display);
  }
  std::vector<std::string> lines = model.lines;
  if (path_) {
    const std::vector<std::string> told = path_lines(path_->found, path_->stops);
    if (!lines.empty()) lines.emplace_back();
    lines.insert(lines.end(), told.begin(), told.end());
  } else if (busy()) {
    lines.emplace_back("following the pixel's samples …");
  } else if (on_ && lines.empty()) {
    lines.emplace_back("point at the picture");
  }
  if (!lines.empty()) draw_lines(ui, view.visible, lines, pixel ? &model.shown : nullptr);
}

}  // namespace tyndall
