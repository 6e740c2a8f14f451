#include "app/window/picture_view.h"

#include "core/base/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {

PictureView::PictureView(Session& session) : session_(session) { right_.display = std::make_unique<FrameDisplay>(); }

std::shared_ptr<const Frame> PictureView::unseen() const {
  auto latest = session_.renderers().latest(Half::current), kept = session_.renderers().latest(Half::kept);
  const bool new_kept = kept && kept != left_.frame;
  if (latest && latest != right_.frame && (latest->finished || !new_kept)) return latest;
  return new_kept ? kept : nullptr;
}

void PictureView::take() {
  const auto take_half = [this](Half half, Side& side) {
    const auto latest = session_.renderers().latest(half);
    if (latest && latest != side.frame) session_.shown(half, side.frame = latest);
  };
  take_half(Half::current, right_);
  take_half(Half::kept, left_);
}

bool PictureView::shows_halves() const { return session_.renderers().split() && !session_.accuracy().map(); }

/// "mis · sobol   1,024 spp   est. error 1.2 %".
std::string PictureView::text_of(Half half) const {
  const Frame* frame = (half == Half::kept ? left_ : right_).frame.get();
  std::string method = session_.method(half);
  if (!frame || frame->spp == 0) return method;
  std::string text = method + "   " + format_count(frame->spp) + " spp";
  const ErrorCurve& curve = session_.accuracy().curves(half).current();
  if (curve.edit != frame->edit || curve.points.empty()) return text;
  const char* kind = session_.accuracy().is_true() ? "true" : "est.";
  return text + fmt::format("   {} error {:.2g} %", kind, 100 * std::sqrt(curve.points.back().rel_mse));
}

void PictureView::draw_halves(Ui& ui, const Rect& image) const {
  if (!shows_halves()) return;
  if (ui.log && left_.frame && right_.frame)
    ui.log->changed("halves", fmt::format("A {:.2f} B {:.2f}", left_.frame->seconds, right_.frame->seconds));
  draw_split(ui, image, divider_, {text_of(Half::kept), text_of(Half::current)});
}

bool PictureView::drag_divider(Ui& ui, const Rect& image, const Mouse& mouse, bool free) {
  bool has_it = false;
  if (shows_halves())
    has_it = divider_.follow(mouse, image, free, 6 * ui.scale);
  else
    divider_.hovered = divider_.dragged = false;
  const bool shown = has_it || divider_.hovered;
  if (shown) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ui.log) ui.log->changed("cursor", shown ? "divider" : "plain");
  return has_it;
}

void PictureView::upload() {
  if (!session_.renderers().split()) left_ = {};
  const auto map = session_.accuracy().map();
  const auto& frame = right_.frame;
  if (map && map != right_.uploaded) right_.display->upload(map->width, map->height, map->rgba);
  if (!map && frame && frame != right_.uploaded) right_.display->upload(frame->width, frame->height, frame->rgba);
  right_.uploaded = map ? std::shared_ptr<const void>(map) : frame;
  if (!shows_halves() || !left_.frame || left_.frame == left_.uploaded) return;
  if (!left_.display) left_.display = std::make_unique<FrameDisplay>();
  left_.display->upload(left_.frame->width, left_.frame->height, left_.frame->rgba);
  left_.uploaded = left_.frame;
}

void PictureView::show(Platform& platform, const Rect& image) {
  try {
    upload();
  } catch (const IoError& error) {
    session_.messages().say(error.what(), true);
  }
  platform.clear();
  const WindowSize window = platform.size();
  const float dots = static_cast<float>(window.framebuffer_width) / static_cast<float>(std::max(1, window.width));
  const Rect whole{image.x0 * dots, image.y0 * dots, image.x1 * dots, image.y1 * dots};
  const int height = window.framebuffer_height;
  const Display& display = session_.editor().scene().display;
  const auto look = [&](const Frame* frame) {
    const bool plain = session_.accuracy().map() || (frame && frame->view != View::beauty);
    return plain ? Look{} : Look{display.exposure, display.tone_map};
  };
  right_.display->draw(whole, height, look(right_.frame.get()), whole);
  if (shows_halves() && left_.display) {
    Rect left = whole;
    left.x1 = std::round(divider_.x(image)) * dots;
    left_.display->draw(whole, height, look(left_.frame.get()), left);
  }
  platform.end_frame();
}

}  // namespace tyndall
