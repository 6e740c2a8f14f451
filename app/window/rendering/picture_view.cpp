#include "app/window/rendering/picture_view.h"

#include "app/window/accuracy/views.h"
#include "app/window/system/imgui_compat.h"
#include "core/base/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// What a half is, on a dark ground in the half's upper outer corner; in several lines where the half is narrow.
void draw_label(Ui& ui, const Rect& half, const std::string& text, bool right) {
  const float s = ui.scale, pad = 8 * s, mark = ImGui::CalcTextSize("A").x + pad;
  const float room = std::max(half.width() - mark - 4 * pad, 40 * s);
  const ImVec2 words = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
  const float width = mark + words.x + 2 * pad, height = words.y + 2 * pad;
  const float x = right ? half.x1 - width - pad : half.x0 + pad, y = half.y0 + pad;
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->PushClipRect({half.x0, half.y0}, {half.x1, half.y1}, true);
  draw->AddRectFilled({x, y}, {x + width, y + height}, shade(palette::ink, 0.85f), 5 * s);
  draw->AddText({x + pad, y + pad}, shade(right ? palette::blue : palette::amber), right ? "B" : "A");
  draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x + pad + mark, y + pad}, shade(palette::text), text.c_str(),
                nullptr, room);
  draw->PopClipRect();
  if (ui.log) ui.log->widget(right ? "split.b" : "split.a", half, text);
}

/// The clean view that a frame shows; null: it shows something else.
std::shared_ptr<const CleanFrame> clean_of(const std::shared_ptr<const Frame>& frame) {
  return frame && frame->view == View::beauty ? frame->clean : nullptr;
}

}  // namespace

bool Divider::is_at(const Rect& image, float mouse_x, float mouse_y, float reach) const {
  return image.width() > 0 && mouse_y >= image.y0 && mouse_y < image.y1 && std::abs(mouse_x - x(image)) <= reach;
}

bool Divider::follow(const Mouse& mouse, const Rect& image, bool free, float reach) {
  const bool at = free && is_at(image, mouse.x, mouse.y, reach);
  // If drawing is slow, the mouse may have left the divider by the time its press is seen.
  if ((at || hovered) && free && mouse.clicked[0]) dragged = true;
  hovered = at;
  if (dragged && mouse.down[0]) drag_to(image, mouse.x);
  const bool has_it = dragged;
  dragged = dragged && mouse.down[0];
  return has_it;
}

void Divider::drag_to(const Rect& image, float mouse_x) {
  if (image.width() > 0) part = std::clamp((mouse_x - image.x0) / image.width(), 0.02f, 0.98f);
}

void draw_split(Ui& ui, const Rect& image, const Divider& divider, const std::string& a, const std::string& b) {
  if (image.width() <= 0 || image.height() <= 0) return;
  const float x = std::round(divider.x(image)), middle = (image.y0 + image.y1) / 2, s = ui.scale;
  compat::push_font(ui.fonts.small);
  draw_label(ui, {image.x0, image.y0, x - 2 * s, image.y1}, a, false);
  draw_label(ui, {x + 2 * s, image.y0, image.x1, image.y1}, b, true);
  ImGui::PopFont();
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  draw->AddRectFilled({x - 2 * s, image.y0}, {x + 2 * s, image.y1}, shade(palette::ink, 0.55f));
  draw->AddLine({x, image.y0}, {x, image.y1}, shade(palette::text, 0.9f), s);
  draw->AddRectFilled({x - 5 * s, middle - 18 * s}, {x + 5 * s, middle + 18 * s}, shade(palette::text), 5 * s);
  for (const float way : {-1.5f, 1.5f})
    draw->AddLine({x + way * s, middle - 7 * s}, {x + way * s, middle + 7 * s}, shade(palette::ink, 0.6f), s);
  if (ui.log) ui.log->widget("divider", {x - 4 * s, image.y0, x + 4 * s, image.y1}, "");
}

std::shared_ptr<const Frame> PictureView::unseen() const {
  auto latest = renderers_.latest(Half::current), kept = renderers_.latest(Half::kept);
  const bool new_kept = kept && kept != left_.frame;
  if (latest && latest != right_.frame && (latest->finished || !new_kept)) return latest;
  return new_kept ? kept : nullptr;
}

std::shared_ptr<const Frame> PictureView::take(Half half) {
  Side& side = half == Half::current ? right_ : left_;
  const auto latest = renderers_.latest(half);
  return latest && latest != side.frame ? side.frame = latest : nullptr;
}

void PictureView::note_shown() {
  if (right_.frame) renderers_.note_shown(Half::current, right_.frame->pass);
  if (left_.frame) renderers_.note_shown(Half::kept, left_.frame->pass);
}

bool PictureView::shows_halves(const Context& context) const {
  return (context.split && !accuracy_.map()) || shows_raw_beside(context);
}

/// The left side is then the right one's picture as it is.
bool PictureView::shows_raw_beside(const Context& context) const {
  return context.clean == 2 && !accuracy_.map() && clean_of(right_.frame);
}

/// "mis · sobol   1,024 spp   est. error 1.2 %".
std::string PictureView::text_of(Half half, std::string method) const {
  const Frame* frame = (half == Half::kept ? left_ : right_).frame.get();
  if (frame && frame->clean) method += " · clean";
  if (!frame || frame->spp == 0) return method;
  std::string text = method + "   " + format_count(frame->spp) + " spp";
  const ErrorCurve& curve = accuracy_.curves(half, frame->clean ? Kind::clean : Kind::raw).current();
  if (curve.edit != frame->edit || curve.points.empty()) return text;
  const char* kind = accuracy_.is_true() ? "true" : "est.";
  return text + fmt::format("   {} error {:.2g} %", kind, 100 * std::sqrt(curve.points.back().rel_mse));
}

void PictureView::draw_halves(Ui& ui, const Context& context) const {
  if (ui.log && right_.frame) {
    const Frame& frame = *right_.frame;
    ui.log->changed("pictures", fmt::format("{} of {} x {}{}", left_.frame || left_.display ? 2 : 1, frame.width,
                                            frame.height, frame.clean ? " clean" : ""));
  }
  if (!shows_halves(context)) return;
  if (ui.log && left_.frame && right_.frame)
    ui.log->changed("halves", fmt::format("A {:.2f} B {:.2f}", left_.frame->seconds, right_.frame->seconds));
  if (!shows_raw_beside(context))
    return draw_split(ui, context.visible, divider_, text_of(Half::kept, context.kept_method),
                      text_of(Half::current, context.method));
  const auto text = [](const char* name, const auto& picture) {
    if (picture.spp == 0) return std::string(name) + "   coarse at first";
    return fmt::format("{}   {} spp   est. error {:.2g} %", name, format_count(picture.spp),
                       100 * picture.relative_error);
  };
  draw_split(ui, context.visible, divider_, text("raw", *right_.frame), text("clean", *right_.frame->clean));
}

bool PictureView::drag_divider(Ui& ui, const Mouse& mouse, bool free, const Context& context) {
  bool has_it = false;
  if (shows_halves(context))
    has_it = divider_.follow(mouse, context.visible, free, 6 * ui.scale);
  else
    divider_.hovered = divider_.dragged = false;
  const bool shown = has_it || divider_.hovered;
  if (shown) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ui.log) ui.log->changed("cursor", shown ? "divider" : "plain");
  return has_it;
}

/// Puts a picture on a side's display, unless it is there.
void PictureView::upload(Side& side, const std::shared_ptr<const void>& what, const ShownPicture& picture,
                         const Look& look) {
  if (what == side.uploaded && look == side.look) return;
  if (!side.display) side.display = std::make_unique<FrameDisplay>();
  side.display->upload(picture, look);
  side.uploaded = what;
  side.look = look;
}

/// Puts what a frame shows on a side's display. clean: its clean view, if it has one. Views that are not the picture
/// are shown as they are.
void PictureView::upload_frame(Side& side, const std::shared_ptr<const Frame>& frame, bool clean, const Look& look) {
  const Look own = frame->view == View::beauty ? look : Look{};
  if (const auto filtered = clean ? clean_of(frame) : nullptr)
    upload(side, filtered, {filtered->rgba, filtered->grid, frame->width, frame->height}, own);
  else
    upload(side, frame, {frame->rgba, frame->grid, frame->width, frame->height}, own);
}

void PictureView::upload_all(const Context& context, const Display& display) {
  const Look look{display.exposure, display.tone_map, display.dither, view_entry(context.view).stops};
  if (!context.split && !shows_raw_beside(context)) left_ = {};
  if (const auto map = accuracy_.map())
    upload(right_, map, {map->rgba, {map->width, map->height}, map->width, map->height}, {});
  else if (right_.frame)
    upload_frame(right_, right_.frame, true, look);
  if (!shows_halves(context)) return;
  const bool beside = shows_raw_beside(context);
  const auto& left = beside ? right_.frame : left_.frame;
  if (left) upload_frame(left_, left, !beside, look);
}

std::string PictureView::show(Platform& platform, const Context& context, const Display& display) {
  std::string problem;
  try {
    upload_all(context, display);
  } catch (const IoError& error) {
    problem = error.what();
  }
  const WindowSize window = platform.size();
  const auto in_dots = [dots = context.dots](const Rect& r) {
    return Rect{r.x0 * dots, r.y0 * dots, r.x1 * dots, r.y1 * dots};
  };
  const Rect whole = in_dots(context.layout.image), clip = in_dots(context.visible);
  const auto draw = [&](const FrameDisplay& shown, const Rect& within) {
    shown.draw(whole, window.framebuffer_width, window.framebuffer_height, within, context.squares);
  };
  platform.clear();
  draw(*right_.display, clip);
  if (shows_halves(context) && left_.display) {
    Rect left = clip;
    left.x1 = std::round(divider_.x(context.visible)) * context.dots;
    draw(*left_.display, left);
  }
  platform.end_frame();
  return problem;
}

}  // namespace tyndall
