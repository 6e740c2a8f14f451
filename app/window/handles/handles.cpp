#include "app/window/handles/handles.h"

#include "app/window/system/style.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

// Units of the design.
constexpr double arrow_start = 14, arrow = 50, short_arrow_end = 34, ring_radius = 82, min_grip = 26, reach = 9,
                 grip_room = 16;
constexpr double min_seen = 0.05;  // of PictureFrame::seen_direction(): with less, it has no direction
constexpr int ring_points = 64;

double distance(WindowPoint a, WindowPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

double distance_to_line(WindowPoint p, WindowPoint a, WindowPoint b) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
  return distance(p, {a.x + t * dx, a.y + t * dy});
}

/// An arrow that is seen from its end is short; it is not drawn at all only where it has no direction in the picture.
void add_arrow(const PictureFrame& frame, Vec3d origin, WindowPoint middle, HandleKind kind, std::vector<Handle>& out) {
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3d axis = axes[static_cast<int>(kind) - static_cast<int>(HandleKind::along_x)];
  const WindowPoint direction = frame.seen_direction(origin, axis);
  const double seen = std::hypot(direction.x, direction.y);
  if (seen < min_seen) return;
  const double to = seen < PictureFrame::min_followed ? short_arrow_end : arrow_start + arrow * seen;
  const auto at = [&](double distance) {
    return WindowPoint{middle.x + distance * frame.scale / seen * direction.x,
                       middle.y + distance * frame.scale / seen * direction.y};
  };
  out.push_back({kind, 0, {at(arrow_start), at(to)}});
}

void add_ring(const PictureFrame& frame, Vec3d origin, std::vector<Handle>& out) {
  const double radius = ring_radius * frame.scale * frame.unit_at(origin);
  Handle ring{HandleKind::rotate, 0, {}};
  for (int k = 0; k < ring_points; ++k) {
    const double angle = 2 * pi * k / ring_points;
    const auto point = frame.point(origin + radius * Vec3d{std::cos(angle), 0, std::sin(angle)});
    if (!point) return;
    ring.points.push_back(*point);
  }
  out.push_back(std::move(ring));
}

/// Where a grip can be taken: at its place, or as far outside along its way as it needs to keep off the middle and the
/// arrows. A grip that is seen from its end stays. Nothing where it is not in front of the camera.
std::optional<WindowPoint> place_of_grip(const PictureFrame& frame, const SizeGrip& grip, WindowPoint middle,
                                         const std::vector<Handle>& handles) {
  const auto free = [&](WindowPoint at) {
    const auto near = [&](const Handle& other) {
      return other.points.size() == 2 &&
             distance_to_line(at, other.points[0], other.points[1]) < grip_room * frame.scale;
    };
    return distance(at, middle) >= min_grip * frame.scale && std::none_of(handles.begin(), handles.end(), near);
  };
  const double step = frame.scale * frame.unit_at(grip.at);  // a unit of the design, across the line of sight
  for (double outside = 0; outside <= arrow_start + arrow + grip_room; ++outside)
    if (const auto at = frame.point(grip.at + outside * step * grip.pull); at && free(*at)) return at;
  return frame.point(grip.at);
}

void add_grips(const Scene& scene, const PictureFrame& frame, const ObjectPath& path, std::vector<Handle>& out) {
  const CameraAxes axes = axes_of(scene.camera);
  const std::vector<SizeGrip> grips = size_grips(scene, path, normalize(axes.right - axes.up));
  const auto middle = frame.point(middle_of(scene, path));
  for (std::size_t k = 0; middle && k < grips.size(); ++k)
    if (const auto at = place_of_grip(frame, grips[k], *middle, out)) out.push_back({HandleKind::size, k, {*at}});
}

Tone colour_of(HandleKind kind) {
  constexpr Tone red{0.94f, 0.33f, 0.31f, 1}, green{0.47f, 0.78f, 0.31f, 1}, blue{0.33f, 0.56f, 0.98f, 1};
  if (kind == HandleKind::along_x) return red;
  if (kind == HandleKind::along_y || kind == HandleKind::rotate) return green;
  return kind == HandleKind::along_z ? blue : Tone(palette::text);
}

ImVec2 at(WindowPoint p) {
  const auto limited = [](double v) { return static_cast<float>(std::clamp(v, -2e4, 2e4)); };
  return {limited(p.x), limited(p.y)};
}

void draw_arrow(ImDrawList& draw, const Handle& handle, ImU32 colour, float scale) {
  const ImVec2 from = at(handle.points[0]), to = at(handle.points[1]);
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::max(1.0f, std::hypot(dx, dy));
  const ImVec2 direction{dx / length, dy / length}, head{11 * scale * direction.x, 11 * scale * direction.y};
  const ImVec2 side{-4.5f * scale * direction.y, 4.5f * scale * direction.x};
  draw.AddLine(from, {to.x - head.x, to.y - head.y}, colour, 2.5f * scale);
  draw.AddTriangleFilled(to, {to.x - head.x + side.x, to.y - head.y + side.y},
                         {to.x - head.x - side.x, to.y - head.y - side.y}, colour);
}

void draw_handle(ImDrawList& draw, const Handle& handle, Tone tone, float scale) {
  const ImU32 colour = shade(tone), dark = shade(palette::ink, 0.8f);
  const ImVec2 first = at(handle.points[0]);
  if (handle.points.size() == 2) return draw_arrow(draw, handle, colour, scale);
  if (handle.kind == HandleKind::rotate) {
    std::vector<ImVec2> ring;
    for (const WindowPoint& p : handle.points) ring.push_back(at(p));
    return draw.AddPolyline(ring.data(), static_cast<int>(ring.size()), colour, ImDrawFlags_Closed, 2 * scale);
  }
  if (handle.kind == HandleKind::plane) {
    draw.AddCircleFilled(first, 7 * scale, dark, 24);
    return draw.AddCircle(first, 6 * scale, colour, 24, 2 * scale);
  }
  const float half = 5 * scale;
  draw.AddRectFilled({first.x - half, first.y - half}, {first.x + half, first.y + half}, colour, 2 * scale);
  draw.AddRect({first.x - half, first.y - half}, {first.x + half, first.y + half}, dark, 2 * scale);
}

}  // namespace

PictureFrame frame_of(const Scene& scene, const Rect& image, double scale) { return {Projection(scene), image, scale}; }

std::optional<WindowPoint> PictureFrame::point(Vec3d p) const {
  const auto at = projection.point(p);
  if (!at) return {};
  return WindowPoint{image.x0 + at->x * image.width(), image.y0 + at->y * image.height()};
}

ViewRay PictureFrame::view_ray(WindowPoint at) const {
  return projection.view_ray({(at.x - image.x0) / image.width(), (at.y - image.y0) / image.height()});
}

double PictureFrame::unit_at(Vec3d p) const {
  const double minimum = 1e-3 * target_distance(projection.camera);
  return projection.height_at(std::max(projection.depth_of(p), minimum)) /
         std::max(1.0, static_cast<double>(image.height()));
}

WindowPoint PictureFrame::seen_direction(Vec3d p, Vec3d direction) const {
  const double step = 1e-3 * image.height();
  const auto from = point(p), to = point(p + (step * unit_at(p)) * direction);
  if (!from || !to) return {};
  return {(to->x - from->x) / step, (to->y - from->y) / step};
}

std::vector<Handle> handles_of(const Scene& scene, const PictureFrame& frame, const ObjectPaths& selected,
                               Vec3d origin) {
  std::vector<Handle> handles;
  if (selected.empty() || frame.image.width() <= 0) return handles;
  if (const auto middle = frame.point(origin)) {
    handles.push_back({HandleKind::plane, 0, {*middle}});
    for (const HandleKind kind : {HandleKind::along_x, HandleKind::along_y, HandleKind::along_z})
      add_arrow(frame, origin, *middle, kind, handles);
    const auto is_sphere = [&](const ObjectPath& p) { return shape_of<Sphere<>>(*find_object(scene, p)) != nullptr; };
    if (std::none_of(selected.begin(), selected.end(), is_sphere)) add_ring(frame, origin, handles);
  }
  if (selected.size() == 1) add_grips(scene, frame, selected.front(), handles);
  return handles;
}

std::optional<Handle> handle_at(const std::vector<Handle>& handles, WindowPoint at, double scale) {
  const Handle* best = nullptr;
  double minimum = reach * scale;
  for (const Handle& handle : handles) {
    double away = 1e9;
    for (std::size_t k = 0; k < handle.points.size(); ++k)  // a point alone is a line from and to itself
      away = std::min(away, distance_to_line(at, handle.points[k], handle.points[(k + 1) % handle.points.size()]));
    if (handle.kind == HandleKind::size) away -= 2 * scale;  // a grip on an arrow is meant
    if (handle.kind == HandleKind::rotate) away += 3 * scale;
    if (away < minimum) minimum = away, best = &handle;
  }
  return best ? std::optional(*best) : std::nullopt;
}

void draw_handles(const PictureFrame& frame, const std::vector<Handle>& handles, const std::optional<Handle>& hovered,
                  bool only) {
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const Rect& image = frame.image;
  draw.PushClipRect({image.x0, image.y0}, {image.x1, image.y1}, true);
  for (const Handle& handle : handles) {
    const bool on = hovered && *hovered == handle;
    if (!only || on)
      draw_handle(draw, handle, on ? palette::amber : colour_of(handle.kind), static_cast<float>(frame.scale));
  }
  draw.PopClipRect();
}

void draw_handle_text(const PictureFrame& frame, const std::string& text) {
  if (text.empty()) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const auto scale = static_cast<float>(frame.scale);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 from{(frame.image.x0 + frame.image.x1 - size.x) / 2, frame.image.y0 + 14 * scale};
  draw.AddRectFilled({from.x - 10 * scale, from.y - 5 * scale},
                     {from.x + size.x + 10 * scale, from.y + size.y + 5 * scale}, shade(palette::panel, 0.9f),
                     5 * scale);
  draw.AddText(from, shade(palette::text), text.c_str());
}

void log_handles(UiLog& log, const Scene& scene, const ObjectPath& first, const std::vector<Handle>& handles,
                 double scale) {
  static constexpr const char* names[] = {"move", "x", "y", "z", "turn", "size."};
  for (const Handle& handle : handles) {
    std::string name = names[static_cast<int>(handle.kind)];
    if (handle.kind == HandleKind::size) name += size_grips(scene, first, {1, 0, 0})[handle.grip].name;
    // Of an arrow its head, of the ring its point that is nearest to the viewer.
    const auto lowest = std::max_element(handle.points.begin(), handle.points.end(),
                                         [](const WindowPoint& a, const WindowPoint& b) { return a.y < b.y; });
    const WindowPoint p = handle.kind == HandleKind::rotate ? *lowest : handle.points.back();
    const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y), half = static_cast<float>(5 * scale);
    log.widget("handle." + name, {x - half, y - half, x + half, y + half}, "handle");
  }
}

}  // namespace tyndall
