#include "app/window/object_tools.h"

#include "app/window/edit/arrange.h"
#include "app/window/edit/material_edits.h"
#include "app/window/handles/handles.h"
#include "app/window/overlays.h"
#include "app/window/tools/camera_control.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr Action add_actions[] = {Action::add_sphere, Action::add_hollow_sphere, Action::add_box,
                                  Action::add_quad,   Action::add_triangle,      Action::add_disk,
                                  Action::add_light,  Action::add_medium};
constexpr Action object_actions[] = {Action::grab,       Action::duplicate,         Action::remove,
                                     Action::rename,     Action::own_material,      Action::frame,
                                     Action::add_sphere, Action::add_hollow_sphere, Action::add_box,
                                     Action::add_quad,   Action::add_triangle,      Action::add_disk,
                                     Action::add_light,  Action::add_medium};

}  // namespace

void ObjectTools::select_all(const ObjectPaths& paths) {
  session_.editor().select(paths);
  set_selected(panels_, paths);
  pacing_.on_event();
}

/// The pixel is one of the picture that is rendered, which may have another size than the scene's file asks for.
PictureClick ObjectTools::click_in(const Scene& scene, const Rect& image, float x, float y) const {
  const PictureSize size = session_.picture_size().value_or(PictureSize{scene.width, scene.height});
  return click_at(image, x, y, size.width, size.height);
}

void ObjectTools::look_under_mouse() {
  const Scene& scene = session_.editor().scene();
  const Rect& image = layout_.image;
  if (!(image.width() > 0)) return;  // nothing was drawn yet
  const bool over = image.contains(mouse_.x, mouse_.y);
  const float at_x = over ? mouse_.x : (image.x0 + image.x1) / 2, at_y = over ? mouse_.y : (image.y0 + image.y1) / 2;
  const PictureClick click = click_in(scene, image, at_x, at_y);
  const Renderer::Pick pick = session_.renderers().pick(click.x, click.y);
  spot_ = spot_at(scene, click.at, find_object(scene, pick.object) ? pick.object : ObjectPath{}, pick.point);
}

void ObjectTools::open_menu(const std::string& title, std::span<const Action> list) {
  std::vector<MenuItem> items;
  const bool none = selected().empty();
  for (const ActionEntry& entry : actions()) {
    if (std::find(list.begin(), list.end(), entry.action) == list.end()) continue;
    const bool on_objects = !is_addition(entry.action) && entry.action != Action::frame;
    std::string why_not = none && (on_objects || entry.action == Action::frame) ? "select an object first" : "";
    const bool first_addition = entry.action == Action::add_sphere && !items.empty();
    items.push_back({"menu." + log_name(entry.name),
                     entry.name,
                     text_of(entry.key),
                     std::move(why_not),
                     first_addition,
                     {entry.action}});
  }
  menu_.open(mouse_.x, mouse_.y, title, std::move(items));
  pacing_.on_event();
}

bool ObjectTools::act(Action action) {
  if (is_addition(action)) {
    add(static_cast<Addition>(static_cast<int>(action) - static_cast<int>(Action::add_sphere)));
    return true;
  }
  if (action == Action::add) {
    look_under_mouse();
    open_menu("Add here", add_actions);
    return true;
  }
  constexpr Action of_selection[] = {Action::grab, Action::duplicate, Action::remove, Action::rename,
                                     Action::own_material};
  if (std::count(std::begin(of_selection), std::end(of_selection), action) == 0) return false;
  if (selected().empty()) return session_.messages().say("select an object first: click on it"), true;
  if (action == Action::grab) handles_.grab(mouse_, selected(), session_.editor().scene());
  if (action == Action::duplicate) duplicate();
  if (action == Action::remove) remove();
  if (action == Action::rename) panels_.rename = true;
  if (action == Action::own_material) own_material();
  return true;
}

bool ObjectTools::take_press(const KeyPress& press) {
  const bool taken = press.character != '\0' ? handles_.take_character(press.character)
                                             : menu_.take_key(press.key) || handles_.take_key(press.key);
  if (!taken) return false;
  pacing_.on_event();
  return true;
}

bool ObjectTools::escape() {
  if (menu_.is_open()) return menu_.close(), true;
  if (!handles_.active()) return false;
  handles_.cancel();
  pacing_.on_event();
  return true;
}

void ObjectTools::add(Addition what) {
  Scene scene = session_.editor().scene();
  const ObjectPaths added = add_object(scene, what, spot_);
  session_.editor().edit(std::move(scene), gestures_.begin());
  select_all({added.front()});
  const ActionEntry* entry =
      find_action(static_cast<Action>(static_cast<int>(Action::add_sphere) + static_cast<int>(what)));
  session_.messages().say("added: " + title_of(session_.editor().scene(), added.front()) + " (" + entry->name + ")");
}

void ObjectTools::duplicate() {
  Scene scene = session_.editor().scene();
  const ObjectPaths copies = duplicate_objects(scene, selected());
  session_.editor().edit(std::move(scene), gestures_.begin());
  select_all(copies);
  session_.messages().say("duplicated: the copy is in the same place, and is selected");
}

void ObjectTools::remove() {
  Scene scene = session_.editor().scene();
  const std::string title = title_of(scene, panels_.selected);
  const int count = delete_objects(scene, selected(), session_.editor().document().origin->saved.materials);
  session_.editor().edit(std::move(scene), gestures_.begin());
  select_all({});
  session_.messages().say("deleted " + (count == 1 ? title : std::to_string(count) + " objects") + "; Ctrl + Z: undo");
}

void ObjectTools::own_material() {
  Scene scene = session_.editor().scene();
  for (const ObjectPath& path : selected()) make_single_user(scene, path);
  if (scene == session_.editor().scene()) return session_.messages().say("nothing else has its material");
  session_.editor().edit(std::move(scene), gestures_.begin());
  pacing_.on_event();
}

bool ObjectTools::use_mouse(const Mouse& mouse, const Layout& layout, float scale, bool free) {
  mouse_ = mouse, layout_ = layout, scale_ = scale;
  const bool was_active = handles_.active();
  const bool taken = handles_.update(mouse, layout, scale, free && !shows_menu(), selected(), panels_.scene);
  if (handles_.clicked_through()) click(layout, mouse, PressedButton::left);
  if (was_active != handles_.active()) pacing_.on_event();
  return taken;
}

void ObjectTools::click(const Layout& layout, const Mouse& mouse, PressedButton button) {
  if (!layout.image.contains(mouse.x, mouse.y)) return;
  const Scene& scene = panels_.scene;
  const PictureClick click = click_in(scene, layout.image, mouse.x, mouse.y);
  const Renderer::Pick pick = session_.renderers().pick(click.x, click.y);
  if (button == PressedButton::left) {
    const bool again = clicks_.again(mouse.x, mouse.y, scale_, scene.camera);
    return mouse.shift ? focus_on(pick, mouse.control) : select(click, pick, mouse.control, again);
  }
  if (button != PressedButton::right) return;
  const ObjectPaths now = selected();
  if (std::find(now.begin(), now.end(), pick.object) == now.end()) select(click, pick, false, false);
  look_under_mouse();
  open_menu(selected().empty() ? "Add here" : title_of(scene, panels_.selected), object_actions);
}

void ObjectTools::select(const PictureClick& click, const Renderer::Pick& pick, bool more, bool again) {
  pacing_.on_event();
  const ObjectPath found = clicked_object(panels_.scene, pick, click.at, panels_.selected, again && !more);
  if (!more) {
    select_all(found.empty() ? ObjectPaths{} : ObjectPaths{found});
  } else if (!found.empty()) {
    ObjectPaths all = selected();
    const auto had = std::find(all.begin(), all.end(), found);
    if (had != all.end())
      all.erase(had);
    else
      all.insert(all.begin(), found);
    select_all(all);
  }
  if (!found.empty())
    handles_.clicked(panels_.scene, found, found == pick.object ? pick.point : middle_of(panels_.scene, found));
}

void ObjectTools::focus_on(const Renderer::Pick& pick, bool keep_blur) {
  if (pick.object.empty() || !(pick.depth > 0)) return session_.messages().say("nothing to focus on there");
  panels_.scene.camera = focus(panels_.scene.camera, pick.depth, keep_blur);
}

void ObjectTools::draw(Ui& ui, const Layout& layout) {
  const ObjectPaths all = selected();
  for (const ObjectPath& path : all) draw_outline(ui, layout.image, outline(panels_.scene, path));
  if (!all.empty() && layout.image.width() > 0) {
    const PictureFrame frame = frame_of(panels_.scene, layout.image, static_cast<double>(ui.scale));
    const auto handles = handles_of(panels_.scene, frame, all, handles_.origin(panels_.scene, frame, all));
    draw_handles(frame, handles, handles_.hovered(), handles_.active());
    draw_handle_text(frame, handles_.said());
    if (ui.log) {
      std::vector<std::string> names;
      for (const Handle& handle : handles) names.push_back(name_of_handle(panels_.scene, all, handle));
      log_handles(*ui.log, handles, names, frame.scale);
    }
  }
  shows_menu_ = menu_.is_open();
  if (auto chosen = menu_.draw(ui, layout.area)) panels_.requests.push_back(std::move(*chosen));
}

}  // namespace tyndall
