#include "app/window/object_tools.h"

#include "app/window/edit/material_edits.h"
#include "app/window/inspector/inspector.h"
#include "app/window/tools/camera_control.h"

#include <algorithm>
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

}  // namespace tyndall
