#include "app/window/handles/handle_tool.h"

#include "app/text/numbers.h"
#include "app/window/edit/arrange.h"

#include <cmath>
#include <string_view>

namespace tyndall {
namespace {

// GLFW's numbers of keys.
constexpr int key_enter = 257, key_backspace = 259, key_keypad_enter = 335;
constexpr double click_distance = 4;   // units of the design; a press that goes less far is a click
constexpr double fine_fraction = 0.1;  // of the mouse's way that counts while Shift is held

}  // namespace

Vec3d HandleTool::origin(const Scene& scene, const PictureFrame& frame, const ObjectPaths& selected) const {
  const Vec3d middle = middle_of(scene, selected.front());
  const auto at = frame.point(middle);
  const bool seen = at && frame.image.contains(static_cast<float>(at->x), static_cast<float>(at->y));
  return !seen && clicked_ == selected.front() ? middle + click_ : middle;
}

void HandleTool::clicked(const Scene& scene, const ObjectPath& object, Vec3d point) {
  clicked_ = object;
  if (!object.empty()) click_ = point - middle_of(scene, object);
}

void HandleTool::grab(const Mouse& mouse, const ObjectPaths& selected, const Scene& scene) {
  if (selected.empty() || drag_) return;
  const WindowPoint at{static_cast<double>(mouse.x), static_cast<double>(mouse.y)};
  drag_ = HandleDrag{{}, selected, {}, at, at, false, false, {}};
  drag_->origin = middle_of(scene, selected.front());
  start_ = scene.objects, materials_ = scene.materials;
  grabbed_ = moved_ = true;
}

void HandleTool::choose_axis(HandleKind kind) {
  drag_->handle.kind = drag_->handle.kind == kind ? HandleKind::plane : kind;  // the same key again: free once more
}

bool HandleTool::take_key(int key) {
  if (!drag_) return false;
  if (grabbed_ && key >= 'X' && key <= 'Z')
    choose_axis(static_cast<HandleKind>(static_cast<int>(HandleKind::along_x) + key - 'X'));
  else if (key == key_enter || key == key_keypad_enter)
    confirmed_ = true;
  else if (key == key_backspace && !typed_.empty())
    typed_.pop_back();
  else
    return false;
  read_typed();
  return true;
}

bool HandleTool::take_character(char character) {
  const bool in_number = std::string_view("0123456789.,+-*/^()").find(character) != std::string_view::npos;
  const bool in_name = !typed_.empty() && std::string_view("pisqrt").find(character) != std::string_view::npos;
  if (!drag_ || drag_->handle.kind == HandleKind::plane || !(in_number || in_name)) return false;
  typed_ += character;
  read_typed();
  return true;
}

void HandleTool::read_typed() {
  double number = 0;
  drag_->typed = parse_number(typed_, "", number) ? std::optional(number) : std::nullopt;
}

void HandleTool::end() {
  drag_.reset();
  start_.clear();
  materials_.clear();
  said_.clear();
  typed_.clear();
  grabbed_ = moved_ = confirmed_ = cancelled_ = false;
}

void HandleTool::follow_mouse(const Mouse& mouse, const PictureFrame& frame, Scene& scene) {
  const double fraction = mouse.shift ? fine_fraction : 1.0;
  drag_->to.x += fraction * static_cast<double>(mouse.dx);
  drag_->to.y += fraction * static_cast<double>(mouse.dy);
  drag_->snap = mouse.control, drag_->fine = mouse.shift;
  const double moved = std::hypot(drag_->to.x - drag_->from.x, drag_->to.y - drag_->from.y);
  moved_ = moved_ || drag_->typed || moved > click_distance * frame.scale;
  if (!moved_) return;
  scene.objects = start_;
  said_ = apply_drag(scene, frame, *drag_).said;
  if (!typed_.empty()) said_ += "  (typed: " + typed_ + ")";
}

bool HandleTool::begin(const Mouse& mouse, const PictureFrame& frame, const ObjectPaths& selected, const Scene& scene) {
  const WindowPoint at{static_cast<double>(mouse.x), static_cast<double>(mouse.y)};
  const Vec3d from = origin(scene, frame, selected);
  hovered_ = handle_at(handles_of(scene, frame, selected, from), at, frame.scale);
  if (!hovered_ || !mouse.clicked[0]) return false;
  const WindowPoint pressed{static_cast<double>(mouse.pressed_x[0]), static_cast<double>(mouse.pressed_y[0])};
  drag_ = HandleDrag{*hovered_, selected, from, pressed, at, false, false, {}};
  start_ = scene.objects, materials_ = scene.materials;
  return true;
}

bool HandleTool::update(const Mouse& mouse, const Layout& layout, float scale, bool free, const ObjectPaths& selected,
                        Scene& scene) {
  const PictureFrame frame = frame_of(scene, layout.image, static_cast<double>(scale));
  clicked_through_ = false;
  if (waits_for_release_) return waits_for_release_ = mouse.any_down();
  const bool other = drag_ && (scene.materials != materials_ || scene.objects.size() != start_.size());
  if (other) end();  // another scene came meanwhile
  if (!drag_) {
    hovered_.reset();
    const bool over = free && layout.area.contains(mouse.x, mouse.y);
    if (selected.empty() || !over || !begin(mouse, frame, selected, scene)) return false;
  } else {
    follow_mouse(mouse, frame, scene);
  }
  hovered_ = drag_->handle;
  const bool gone = (grabbed_ && mouse.clicked[1]) || cancelled_;
  if (gone) scene.objects = start_;
  const bool done = grabbed_ ? confirmed_ || mouse.clicked[0] : confirmed_ || !mouse.down[0];
  clicked_through_ = done && !gone && !moved_;
  if (gone || done) {
    waits_for_release_ = mouse.any_down();
    end();
  }
  return true;
}

}  // namespace tyndall
