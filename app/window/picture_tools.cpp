#include "app/window/picture_tools.h"

#include "app/window/accuracy/views.h"
#include "app/window/system/imgui_compat.h"

#include <fmt/core.h>

#include <cmath>

namespace tyndall {

void PictureTools::find_path() {
  inspector.set_on(true);
  inspector.find_path(session_.renderers, session_.wanted.scene);
}

void PictureTools::store_camera() {
  const Scene& scene = session_.editor.scene();
  tyndall::store_camera(panels_.cameras[panels_.now.origin->title], scene.camera, panels_.now.frame.get(),
                        scene.display);
}

void PictureTools::look_through_next() {
  const CameraSlots& slots = panels_.cameras[panels_.now.origin->title];
  const auto next = next_slot(slots, session_.editor.scene().camera);
  if (!next) return session_.messages.say("no camera is stored yet");
  session_.editor.change([&](Scene& scene) { scene.camera = slots[*next].camera; });
}

void PictureTools::refine() {
  Region& part = session_.wanted.refine_first;
  if (rectangle_.cancel()) return session_.messages.dismiss();
  if (part.width() > 0) {
    part = {};
    return session_.messages.say("the whole picture is refined again");
  }
  if (session_.editor.scene().render.adaptive)
    return session_.messages.say("adaptive sampling says by itself where samples go: switch it off first");
  rectangle_.begin();
  session_.messages.say("drag over the part of the picture to be refined first");
}

bool PictureTools::escape() {
  session_.pacing.on_event();
  if (rectangle_.cancel()) return session_.messages.dismiss(), true;
  if (inspector.drop_path()) return true;
  if (!inspector.on()) return false;
  inspector.set_on(false);
  return true;
}

/// Alt + wheel and Alt + drag, and without Alt where there is no camera to move.
bool PictureTools::drag_picture(const Mouse& mouse, bool free) {
  const bool over =
      free && (mouse.alt || session_.shows_picture()) && panels_.now.layout.area.contains(mouse.x, mouse.y);
  if (over && mouse.wheel != 0) zoom_.enlarge(std::pow(1.25f, mouse.wheel), mouse.x, mouse.y);
  for (int button = 0; button < 3 && over && button_ < 0; ++button)
    if (mouse.clicked[button]) button_ = button;
  if (button_ < 0) return over;
  zoom_.move(mouse.dx, mouse.dy);
  if (!mouse.down[button_]) button_ = -1;
  return true;
}

bool PictureTools::use_mouse(const Mouse& mouse, bool free) {
  mouse_ = mouse;
  const Rect& image = panels_.now.layout.image;
  const Frame* frame = panels_.now.frame.get();
  const bool over = frame && !mouse.taken && panels_.now.visible.contains(mouse.x, mouse.y);
  inspector.point_at(over ? std::optional(click_at(image, mouse.x, mouse.y, frame->width, frame->height))
                          : std::nullopt);
  if (drag_picture(mouse, free)) {
    if (mouse.any_down() || mouse.wheel != 0) session_.pacing.on_event();
    return true;
  }
  if (!frame || !rectangle_.active()) return false;
  const auto drawn = rectangle_.update(mouse, image, free, frame->width, frame->height);
  if (drawn) {
    session_.wanted.refine_first = *drawn;
    session_.pacing.on_event();
  }
  return true;
}

std::string PictureTools::said_of_rectangle() const {
  const Frame* frame = panels_.now.frame.get();
  if (session_.editor.scene().render.adaptive) return "not refined first: adaptive sampling is on";
  if (!frame || frame->max_spp <= frame->spp) return "refined first";
  return fmt::format("refined first: {} spp", format_count(frame->max_spp));
}

/// Says how large the picture is shown, in a corner.
void PictureTools::draw_zoom(Ui& ui, const Rect& visible) const {
  if (zoom_.fits()) return;
  const float s = ui.scale;
  const std::string text = fmt::format("{:.0f} %   0: all of it", 100 * static_cast<double>(zoom_.dots_a_pixel()));
  compat::push_font(ui.fonts.small);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const Rect box{visible.x1 - size.x - 30 * s, visible.y0 + 10 * s, visible.x1 - 10 * s, visible.y0 + size.y + 18 * s};
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({box.x0, box.y0}, {box.x1, box.y1}, shade(palette::panel, 0.9f), 4 * s);
  draw.AddText({box.x0 + 10 * s, box.y0 + 4 * s}, shade(palette::text), text.c_str());
  ImGui::PopFont();
  if (ui.log) ui.log->widget("zoom", box, text);
}

void PictureTools::draw(Ui& ui) {
  const Context& context = panels_.now;
  const Rect &image = context.layout.image, &visible = context.visible;
  const Frame* frame = context.frame.get();
  if (visible.width() <= 0 || visible.height() <= 0 || !frame) return;
  rectangle_.draw(ui, image, visible, session_.wanted.refine_first, frame->width, frame->height, said_of_rectangle());
  const bool as_chosen = frame->view == view_entry(context.view).view;
  if (as_chosen) draw_legend(ui, visible, legend_of(context.view, frame->white));
  draw_zoom(ui, visible);
  inspector.draw(ui, context, *panels_.scene, session_.renderers);
}

}  // namespace tyndall
