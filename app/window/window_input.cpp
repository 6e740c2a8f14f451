#include "app/window/document/open_document.h"
#include "app/window/main_window.h"
#include "app/window/system/clock.h"
#include "app/window/tools/camera_control.h"
#include "app/window/tools/medium_pick.h"
#include "core/base/math.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {

void MainWindow::take_input(const InputEvents& events) {
  for (const KeyPress& press : events.keys) {
    const auto action = action_of(press.key, press.modifiers);
    const bool asked = dialog_.kind != Dialog::Kind::none;
    if (!action || (press.typing && !asked) || (asked && action != Action::deselect)) continue;
    act(*action);
  }
  for (const std::filesystem::path& file : events.dropped) session_.open_dropped(std::filesystem::absolute(file));
}

void MainWindow::act(Action action) {
  switch (action) {
    case Action::help:
      help_ = !help_;
      break;
    case Action::deselect:
      escape();
      break;
    case Action::pause:
      session_.pause(!session_.paused());
      break;
    case Action::restart:
      session_.restart();
      pacing_.on_new_start(clock_seconds());
      break;
    case Action::panels:
      columns_ = !columns_;
      break;
    case Action::full_screen:
      platform_.toggle_full_screen();
      break;
    case Action::quit:
      platform_.close();
      break;
    default:
      act_on_document(action);
  }
}

void MainWindow::act_on_document(Action action) {
  switch (action) {
    case Action::frame:
      return frame_selection();
    case Action::reset_camera:
      return reset_camera();
    case Action::undo:
      return session_.undo();
    case Action::redo:
      return session_.redo();
    case Action::save:
      return save();
    case Action::save_as:
      return save_as();
    case Action::snapshot:
      return session_.snapshot();
    default:
      return select_view(static_cast<int>(action) - static_cast<int>(Action::view_beauty));
  }
}

void MainWindow::reset_camera() {
  Scene scene = session_.scene();
  scene.camera = session_.document().origin->saved.camera;
  session_.edit(std::move(scene), ++gesture_);
}

void MainWindow::save_as() {
  const Origin& origin = *session_.document().origin;
  if (origin.file.empty())
    ask_name(dialog_, stem_of(origin.title) + ".json");
  else
    ask_name(dialog_, origin.file);
}

void MainWindow::save() {
  const Origin& origin = *session_.document().origin;
  if (origin.file.empty())
    save_as();
  else if (origin.comments)
    ask_comments(dialog_);
  else
    session_.save(origin.file);
}

void MainWindow::select_view(int view) {
  if (view >= error_view && !session_.can_show_errors())
    return session_.say("load a reference first: see Speed and accuracy");
  panels_.view = view;
  if (view == shown_view_) return;
  shown_view_ = view;
  const ErrorView error = view == error_view ? ErrorView::error : view == flip_view ? ErrorView::flip : ErrorView::none;
  session_.set_view(view < error_view ? static_cast<View>(view) : View::beauty, error);
  pacing_.on_new_start(clock_seconds());
}

void MainWindow::frame_selection() {
  const auto ball = ball_around(session_.scene(), panels_.selected);
  if (!ball) return session_.say("select an object first: click on it");
  Scene scene = session_.scene();
  scene.camera = frame_ball(scene.camera, ball->center, ball->radius, static_cast<double>(scene.width) / scene.height);
  session_.edit(std::move(scene), ++gesture_);
}

void MainWindow::escape() {
  if (dialog_.kind != Dialog::Kind::none)
    dialog_.kind = Dialog::Kind::none;
  else if (help_)
    help_ = false;
  else if (session_.message().error)
    session_.dismiss();
  else
    panels_.selected.clear();
}

void MainWindow::count_gestures(double now) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool flying =
      std::any_of(platform_.held().begin(), platform_.held().end(), [](int key) { return fly_key(key).has_value(); });
  const bool held = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2] || flying || now < wheel_time_ + 0.5;
  if (!held || !was_held_) ++gesture_;
  was_held_ = held;
}

void MainWindow::pointer(const Layout& layout, double now) {
  if (drag_divider(layout)) return;
  const ImGuiIO& io = ImGui::GetIO();
  const bool over = !io.WantCaptureMouse && layout.area.contains(io.MousePos.x, io.MousePos.y);
  if (pointer_.button < 0 && over && dialog_.kind == Dialog::Kind::none)
    for (int button = 0; button < 3; ++button)
      if (ImGui::IsMouseClicked(button)) pointer_ = {button, false};
  if (over) wheel(now);
  if (pointer_.button < 0) return;
  const ImVec2 start = io.MouseClickedPos[pointer_.button];
  ImVec2 way = io.MouseDelta;
  if (!pointer_.moved) {
    way = {io.MousePos.x - start.x, io.MousePos.y - start.y};
    pointer_.moved = std::hypot(way.x, way.y) > 4 * ui_.scale;
  }
  if (pointer_.moved) drag(layout, way.x, way.y);
  if (io.MouseDown[pointer_.button]) return;
  if (!pointer_.moved && pointer_.button == 0) click(layout);
  pointer_ = {};
}

/// Whether the mouse has the divider of a split view; it is then no one else's.
bool MainWindow::drag_divider(const Layout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool free = pointer_.button < 0 && !io.WantCaptureMouse && dialog_.kind == Dialog::Kind::none;
  const bool at = shows_halves() && free && divider_.is_at(layout.image, io.MousePos.x, io.MousePos.y, 6 * ui_.scale);
  // Where drawing is slow, the mouse may have left when its press is seen.
  if ((at || divider_.hovered) && free && ImGui::IsMouseClicked(0)) divider_.dragged = true;
  divider_.hovered = at;
  if (divider_.dragged && io.MouseDown[0]) divider_.drag_to(layout.image, io.MousePos.x);
  if (at || divider_.dragged) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ui_.log) ui_.log->changed("cursor", at || divider_.dragged ? "divider" : "plain");
  const bool has_it = divider_.dragged;
  divider_.dragged = divider_.dragged && io.MouseDown[0] && shows_halves();
  return has_it;
}

void MainWindow::drag(const Layout& layout, float dx, float dy) {
  const double height = std::max(1.0, static_cast<double>(layout.image.height()));
  const double x = static_cast<double>(dx) / height, y = static_cast<double>(dy) / height;
  if (x == 0 && y == 0) return;
  Camera& camera = panels_.scene.camera;
  if (pointer_.button == 0) camera = orbit(camera, pi * x, pi * y);
  if (pointer_.button == 1) camera = dolly(camera, std::exp(3 * y));
  if (pointer_.button == 2) camera = pan(camera, -x, y);
}

void MainWindow::click(const Layout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  const Rect& image = layout.image;
  if (!image.contains(io.MousePos.x, io.MousePos.y)) return;
  const auto pixel = [](float at, float low, float size, int count) {
    return std::clamp(static_cast<int>((at - low) / size * static_cast<float>(count)), 0, count - 1);
  };
  const Renderer::Pick pick = session_.pick(pixel(io.MousePos.x, image.x0, image.width(), panels_.scene.width),
                                            pixel(io.MousePos.y, image.y0, image.height(), panels_.scene.height));
  if (!io.KeyShift) {
    // Fog is seen through: it is selected where nothing else is, or by a second click.
    const bool again = !pick.object.empty() && pick.object == panels_.selected;
    const double behind = pick.object.empty() ? std::numeric_limits<double>::infinity() : pick.depth;
    const ImagePoint at{static_cast<double>((io.MousePos.x - image.x0) / image.width()),
                        static_cast<double>((io.MousePos.y - image.y0) / image.height())};
    const ObjectPath medium = medium_at(panels_.scene, at, behind);
    panels_.selected = (again || pick.object.empty()) && !medium.empty() ? medium : pick.object;
    pacing_.on_event();
  } else if (pick.object.empty() || !(pick.depth > 0)) {
    session_.say("nothing to focus on there");
  } else {
    panels_.scene.camera = focus(panels_.scene.camera, pick.depth, io.KeyCtrl);
  }
}

void MainWindow::wheel(double now) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel == 0) return;
  wheel_time_ = now;
  Camera& camera = panels_.scene.camera;
  const double steps = static_cast<double>(io.MouseWheel);
  camera = io.KeyCtrl ? zoom(camera, std::pow(0.95, steps)) : dolly(camera, std::pow(0.9, steps));
}

void MainWindow::fly(double now) {
  double way[3] = {0, 0, 0};
  for (const int key : platform_.held())
    if (const auto direction = fly_key(key)) way[direction->axis] += direction->sign;
  const bool moving = (way[0] != 0 || way[1] != 0 || way[2] != 0) && !ImGui::GetIO().KeyCtrl;
  if (moving && fly_time_ >= 0) {
    const double speed = (platform_.shift_held() ? 3.0 : 0.75) * target_distance(panels_.scene.camera);
    const double step = speed * std::min(now - fly_time_, 0.1);
    panels_.scene.camera = tyndall::fly(panels_.scene.camera, step * way[0], step * way[1], step * way[2]);
  }
  fly_time_ = moving ? now : -1;
  if (moving) pacing_.wake_at(now + least_frame_interval);
}

}  // namespace tyndall
