#include "app/window/tools/pointer.h"

#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {

PressedButton PointerTool::update(const Mouse& mouse, const Layout& layout, float scale, bool free, double now,
                                  Camera& camera) {
  const bool over = is_over(mouse, layout);
  if (button_ < 0 && over && free)
    for (int button = 0; button < 3; ++button)
      if (mouse.clicked[button]) button_ = button, moved_ = false;
  if (over && mouse.wheel != 0) {
    wheel_time_ = now;
    const double notches = static_cast<double>(mouse.wheel);
    camera = mouse.control ? zoom(camera, std::pow(0.95, notches)) : dolly(camera, std::pow(0.9, notches));
  }
  if (button_ < 0) return PressedButton::none;
  float dx = mouse.dx, dy = mouse.dy;
  if (!moved_) {
    dx = mouse.x - mouse.pressed_x[button_], dy = mouse.y - mouse.pressed_y[button_];
    moved_ = std::hypot(dx, dy) > 4 * scale;
  }
  if (moved_) drag(layout, static_cast<double>(dx), static_cast<double>(dy), camera);
  if (mouse.down[button_]) return PressedButton::none;
  const PressedButton clicked = moved_ ? PressedButton::none : static_cast<PressedButton>(button_ + 1);
  button_ = -1, moved_ = false;
  return clicked;
}

void PointerTool::drag(const Layout& layout, double dx, double dy, Camera& camera) const {
  const double height = std::max(1.0, static_cast<double>(layout.image.height()));
  const double x = dx / height, y = dy / height;
  if (x == 0 && y == 0) return;
  if (button_ == 0) camera = orbit(camera, pi * x, pi * y);
  if (button_ == 1) camera = dolly(camera, std::exp(3 * y));
  if (button_ == 2) camera = pan(camera, -x, y);
}

PictureClick click_at(const Rect& image, float mouse_x, float mouse_y, int width, int height) {
  const float x = (mouse_x - image.x0) / image.width(), y = (mouse_y - image.y0) / image.height();
  const auto pixel = [](float part, int count) {
    return std::clamp(static_cast<int>(part * static_cast<float>(count)), 0, count - 1);
  };
  return {{static_cast<double>(x), static_cast<double>(y)}, pixel(x, width), pixel(y, height)};
}

ObjectPath clicked_object(const Scene& scene, const Renderer::Pick& pick, ImagePoint at, const ObjectPath& selected,
                          bool again) {
  std::vector<ObjectUnder> order = objects_under(scene, at);
  // What is seen comes first, then all fog, then the rest from near to far.
  std::stable_partition(order.begin(), order.end(), [](const ObjectUnder& object) { return object.medium; });
  std::stable_partition(order.begin(), order.end(), [&](const ObjectUnder& o) { return o.path == pick.object; });
  const auto now = std::find_if(order.begin(), order.end(), [&](const ObjectUnder& o) { return o.path == selected; });
  if (again && now != order.end()) return now + 1 == order.end() ? order.front().path : (now + 1)->path;
  if (!pick.object.empty()) return pick.object;
  return !order.empty() && order.front().medium ? order.front().path : ObjectPath{};
}

bool ClickPlace::again(float x, float y, float scale, const Camera& camera) {
  const bool same = std::hypot(x - x_, y - y_) <= 6 * scale && camera == camera_;
  x_ = x, y_ = y, camera_ = camera;
  return same;
}

}  // namespace tyndall
