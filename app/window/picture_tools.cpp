#include "app/window/picture_tools.h"

#include "app/window/accuracy/views.h"
#include "app/window/edit/material_edits.h"
#include "app/window/system/imgui_compat.h"
#include "app/window/tools/camera_control.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

void ObjectTools::select_all(const ObjectPaths& paths) {
  session_.editor.select(paths);
  set_selected(panels_, paths);
  session_.pacing.on_event();
}

/// The pixel is one of the picture that is rendered, which may have another size than the scene's file asks for.
PictureClick ObjectTools::click_in(const Scene& scene, float x, float y) const {
  const PictureSize size = session_.picture_size().value_or(PictureSize{scene.width, scene.height});
  return click_at(panels_.now.layout.image, x, y, size.width, size.height);
}

void ObjectTools::look_under_mouse() {
  const Scene& scene = session_.editor.scene();
  const Rect& image = panels_.now.layout.image;
  if (!(image.width() > 0)) return;  // nothing was drawn yet
  const bool over = image.contains(mouse_.x, mouse_.y);
  const float at_x = over ? mouse_.x : (image.x0 + image.x1) / 2, at_y = over ? mouse_.y : (image.y0 + image.y1) / 2;
  const PictureClick click = click_in(scene, at_x, at_y);
  const Renderer::Pick pick = session_.renderers.pick(click.x, click.y);
  spot_ = spot_at(scene, click.at, find_object(scene, pick.object) ? pick.object : ObjectPath{}, pick.point);
}

void ObjectTools::grab() { handles_.grab(mouse_, selected(), session_.editor.scene()); }

bool ObjectTools::take_press(const KeyPress& press) {
  const bool typed = press.character != '\0';
  const bool taken = typed ? handles_.take_character(press.character) : handles_.take_key(press.key);
  if (taken) session_.pacing.on_event();
  return taken;
}

bool ObjectTools::escape() {
  if (!handles_.active()) return false;
  handles_.cancel();
  session_.pacing.on_event();
  return true;
}

void ObjectTools::add(const Addition& what) {
  ObjectPaths added;
  session_.editor.change([&](Scene& scene) { added = what.add(scene, spot_); });
  select_all({added.front()});
  session_.messages.say("added: " + title_of(session_.editor.scene(), added.front()) + " (add " + what.name + ")");
}

void ObjectTools::duplicate() {
  ObjectPaths copies;
  session_.editor.change([&](Scene& scene) { copies = duplicate_objects(scene, selected()); });
  select_all(copies);
  session_.messages.say("duplicated: the copy is in the same place, and is selected");
}

void ObjectTools::remove() {
  const std::string title = title_of(session_.editor.scene(), panels_.selected);
  const auto& kept = session_.editor.document().origin->saved.materials;
  int count = 0;
  session_.editor.change([&](Scene& scene) { count = delete_objects(scene, selected(), kept); });
  select_all({});
  session_.messages.say("deleted " + (count == 1 ? title : std::to_string(count) + " objects") + "; Ctrl + Z: undo");
}

void ObjectTools::own_material() {
  Scene scene = session_.editor.scene();
  for (const ObjectPath& path : selected()) make_single_user(scene, path);
  if (scene == session_.editor.scene()) return session_.messages.say("nothing else has its material");
  session_.editor.edit(std::move(scene), session_.editor.gestures.begin());
  session_.pacing.on_event();
}

bool ObjectTools::use_mouse(const Mouse& mouse, float scale, bool free) {
  mouse_ = mouse, scale_ = scale;
  const bool was_active = handles_.active();
  const bool taken = handles_.update(mouse, panels_.now.layout, scale, free, selected(), panels_.scene);
  if (handles_.clicked_through()) click(mouse, PressedButton::left);
  if (was_active != handles_.active()) session_.pacing.on_event();
  return taken;
}

bool ObjectTools::click(const Mouse& mouse, PressedButton button) {
  if (!panels_.now.layout.image.contains(mouse.x, mouse.y)) return false;
  const Scene& scene = *panels_.scene;
  const PictureClick click = click_in(scene, mouse.x, mouse.y);
  const Renderer::Pick pick = session_.renderers.pick(click.x, click.y);
  if (button == PressedButton::left) {
    const bool again = clicks_.again(mouse.x, mouse.y, scale_, scene.camera);
    mouse.shift ? focus_on(pick, mouse.control) : select(click, pick, mouse.control, again);
  }
  if (button != PressedButton::right) return false;
  const ObjectPaths now = selected();
  if (std::find(now.begin(), now.end(), pick.object) == now.end()) select(click, pick, false, false);
  look_under_mouse();
  return true;
}

void ObjectTools::select(const PictureClick& click, const Renderer::Pick& pick, bool more, bool again) {
  session_.pacing.on_event();
  const ObjectPath found = clicked_object(*panels_.scene, pick, click.at, panels_.selected, again && !more);
  if (!more) {
    select_all(found.empty() ? ObjectPaths{} : ObjectPaths{found});
  } else if (!found.empty()) {
    ObjectPaths all = selected();
    if (std::erase(all, found) == 0) all.insert(all.begin(), found);
    select_all(all);
  }
  if (!found.empty())
    handles_.clicked(*panels_.scene, found, found == pick.object ? pick.point : middle_of(*panels_.scene, found));
}

void ObjectTools::focus_on(const Renderer::Pick& pick, bool keep_blur) {
  if (pick.object.empty() || !(pick.depth > 0)) return session_.messages.say("nothing to focus on there");
  panels_.scene.change().camera = focus(panels_.scene->camera, pick.depth, keep_blur);
}

void ObjectTools::draw(Ui& ui) {
  const Rect& image = panels_.now.layout.image;
  const ObjectPaths all = selected();
  if (all.empty() || image.width() <= 0) return;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({image.x0, image.y0}, {image.x1, image.y1}, true);
  for (const ObjectPath& path : all)
    for (const ImageLine& line : outline(*panels_.scene, path))
      draw->AddLine(in_window(image, line.a), in_window(image, line.b), shade(palette::blue, 0.95f), 2 * ui.scale);
  draw->PopClipRect();
  const PictureFrame frame = frame_of(*panels_.scene, image, static_cast<double>(ui.scale));
  const auto handles = handles_of(*panels_.scene, frame, all, handles_.origin(*panels_.scene, frame, all));
  draw_handles(frame, handles, handles_.hovered(), handles_.active());
  draw_handle_text(frame, handles_.said());
  if (ui.log) log_handles(*ui.log, *panels_.scene, all.front(), handles, frame.scale);
}

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
