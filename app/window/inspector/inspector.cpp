#include "app/window/inspector/inspector.h"

#include "app/window/system/pacing.h"
#include "app/window/tools/camera_control.h"
#include "app/window/tools/selection.h"
#include "core/base/text.h"
#include "core/compile/compile.h"
#include "core/image/tonemap.h"
#include "core/render/prepare.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

std::string channel(const char* name, float mean, float error) {
  const std::string value = fmt::format("{} {:<9.4g}", name, static_cast<double>(mean));
  return std::isfinite(error) ? value + fmt::format("± {:.2g}", static_cast<double>(error)) : value;
}

double sum_of(Vec3f v) { return static_cast<double>(v.x) + static_cast<double>(v.y) + static_cast<double>(v.z); }

/// The error of the three channels together, over their mean.
std::string relative_error(const PixelReport& report) {
  const Vec3f e = report.standard_error;
  const double error = std::sqrt(sum_of(e * e) / 3), level = sum_of(report.mean) / 3;
  if (!std::isfinite(error)) return "error    not known before two samples";
  return level > 0 ? fmt::format("error    {:.2g} %", 100 * error / level) : "error    black";
}

/// What the view shows at the pixel, as a number; "": it shows colours.
std::string value_of_view(const Frame& frame, std::size_t pixel) {
  if (frame.grid.spacing > 1 || frame.rgba.size() <= 4 * pixel) return "";
  const double value = static_cast<double>(frame.rgba[4 * pixel]) * frame.white;
  if (frame.view == View::noise) return fmt::format("noise    {:.2g} %{}", 100 * value, value >= 1 ? " or more" : "");
  return frame.view == View::cost ? fmt::format("cost     {:.3g} rays a path", value) : "";
}

constexpr std::uint32_t max_followed = 4096;  // samples of a pixel
constexpr double longest_search = 0.5;        // seconds

constexpr std::size_t max_told = 18;  // stops of a path

void draw_number(Ui& ui, ImDrawList& draw, ImVec2 at, std::size_t number, bool light) {
  const float s = ui.scale;
  draw.AddCircleFilled(at, 4 * s, shade(light ? palette::amber : palette::blue), 16);
  draw.AddCircle(at, 4.5f * s, shade(palette::ink, 0.8f), 16, s);
  const std::string text = std::to_string(number);
  const ImVec2 from{at.x + 7 * s, at.y - 7 * s};
  draw.AddText({from.x + s, from.y + s}, shade(palette::ink, 0.9f), text.c_str());
  draw.AddText(from, shade(palette::text), text.c_str());
}

/// Draws a path over the picture: lines between its stops, each with its number. visible: the part of the window in
/// which the picture is seen.
void draw_path(Ui& ui, const Scene& scene, const Rect& image, const Rect& visible, Vec3d eye,
               const std::vector<PathStop>& stops) {
  if (image.width() <= 0) return;
  const Projection projection(scene);
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.PushClipRect({visible.x0, visible.y0}, {visible.x1, visible.y1}, true);
  const WithFont small(ui.fonts.small);
  std::vector<Vec3d> points;
  for (const PathStop& stop : stops) {
    const Vec3d from = stop.before < 0 ? eye : points[static_cast<std::size_t>(stop.before)];
    const Vec3d to = stop.away ? from + 2 * target_distance(scene.camera) * stop.point : stop.point;
    points.push_back(to);
    const auto line = projection.line(from, to);
    if (!line) continue;
    const ImVec2 a = in_window(image, line->a), b = in_window(image, line->b);
    draw.AddLine(a, b, shade(palette::ink, 0.7f), 4 * ui.scale);
    draw.AddLine(a, b, shade(stop.away ? palette::dim : palette::amber), 1.8f * ui.scale);
  }
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const auto at = stops[k].away ? std::nullopt : projection.point(points[k]);
    if (!at) continue;
    const ImVec2 place = in_window(image, *at);
    draw_number(ui, draw, place, k + 1, stops[k].light);
    const float half = 4 * ui.scale;
    if (ui.log)
      ui.log->widget("path." + std::to_string(k + 1), {place.x - half, place.y - half, place.x + half, place.y + half},
                     stops[k].text);
  }
  draw.PopClipRect();
}

/// Draws lines of text in a corner of the picture, away from the mouse. swatch: a colour beside the first line; null:
/// none.
void draw_lines(Ui& ui, const Rect& visible, const std::vector<std::string>& lines,
                const std::array<float, 3>* swatch) {
  const float s = ui.scale, pad = 10 * s;
  const WithFont mono(ui.fonts.mono);
  float width = 0;
  for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
  const float step = ImGui::GetTextLineHeight() + 2 * s, height = step * static_cast<float>(lines.size()) + 2 * pad;
  width = std::min(width + 2 * pad, std::max(60 * s, visible.width() - 28 * s));
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  Rect box{visible.x0 + 14 * s, visible.y0 + 14 * s, visible.x0 + 14 * s + width, visible.y0 + 14 * s + height};
  const Rect around{box.x0 - 30 * s, box.y0 - 30 * s, box.x1 + 30 * s, box.y1 + 30 * s};
  if (around.contains(mouse.x, mouse.y)) box.y1 = visible.y1 - 14 * s, box.y0 = box.y1 - height;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  draw.AddRectFilled({box.x0, box.y0}, {box.x1, box.y1}, shade(palette::panel, 0.92f), 6 * s);
  draw.PushClipRect({box.x0, box.y0}, {box.x1 - pad / 2, box.y1}, true);
  ImVec2 at{box.x0 + pad, box.y0 + pad};
  for (const std::string& line : lines) {
    draw.AddText(at, shade(palette::text), line.c_str());
    at.y += step;
  }
  if (swatch) {
    const float edge = step - 3 * s, x = box.x1 - pad - edge, y = box.y0 + pad;
    draw.AddRectFilled({x, y}, {x + edge, y + edge}, shade({(*swatch)[0], (*swatch)[1], (*swatch)[2], 1}));
    draw.AddRect({x, y}, {x + edge, y + edge}, shade(palette::dim));
  }
  draw.PopClipRect();
  if (ui.log) ui.log->widget("inspector", box, joined(lines, " | "));
}

}  // namespace

std::vector<std::string> path_lines(const NoisyPath& found, const std::vector<PathStop>& stops) {
  std::vector<std::string> lines{fmt::format("path of sample {} of pixel {}, {}", found.sample, found.x, found.y),
                                 sentence_of(found)};
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const bool left_out = stops.size() > max_told && k >= max_told - 1 && k + 1 < stops.size();
    if (left_out && k == max_told - 1) lines.push_back(fmt::format("    … {} more", stops.size() - max_told));
    if (!left_out) lines.push_back(fmt::format("{:>2}  {}", k + 1, stops[k].text));
  }
  return lines;
}

PixelReadout pixel_readout(const Frame& frame, const PixelReport& report, const Scene& scene,
                           const Renderer::Pick& seen) {
  PixelReadout model;
  std::vector<std::string>& lines = model.lines;
  const auto pixel =
      static_cast<std::size_t>(report.y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(report.x);
  lines.push_back(fmt::format("pixel    {}, {}", report.x, report.y));
  if (report.samples == 0) {
    lines.emplace_back("no samples yet");
  } else {
    lines.push_back(channel("red     ", report.mean.x, report.standard_error.x));
    lines.push_back(channel("green   ", report.mean.y, report.standard_error.y));
    lines.push_back(channel("blue    ", report.mean.z, report.standard_error.z));
    lines.push_back(relative_error(report));
    lines.push_back(fmt::format("samples  {}", report.samples) +
                    (report.rejected > 0 ? fmt::format(", {} rejected", report.rejected) : ""));
    Vec3f light = report.mean;
    const bool clean_known = frame.clean && frame.clean->spp > 0 && frame.clean->rgba.size() > 4 * pixel + 2;
    if (clean_known && frame.view == View::beauty) {
      const float* clean = frame.clean->rgba.data() + 4 * pixel;
      light = {clean[0], clean[1], clean[2]};
      lines.push_back(fmt::format("clean    {:.4g} {:.4g} {:.4g}", light.x, light.y, light.z));
    }
    const std::vector<std::uint8_t> bytes =
        tone_map({light.x, light.y, light.z}, scene.display.exposure, scene.display.tone_map);
    for (std::size_t c = 0; c < 3; ++c) model.shown[c] = static_cast<float>(bytes[c]) / 255;
    lines.push_back(fmt::format("shown    {} {} {}", bytes[0], bytes[1], bytes[2]));
  }
  const std::string view = value_of_view(frame, pixel);
  if (!view.empty()) lines.push_back(view);
  const Object* object = find_object(scene, seen.object);
  const Material* material = object ? material_of(scene, *object) : nullptr;
  lines.push_back("object   " + (object ? title_of(scene, seen.object) : "nothing"));
  if (material) lines.push_back("material " + material->name);
  if (object) lines.push_back(fmt::format("depth    {:.4g}", seen.depth));
  return model;
}

void Inspector::set_on(bool on) {
  on_ = on;
  if (!on) drop_path();
}

bool Inspector::drop_path() {
  ++wanted_;
  return std::exchange(path_, nullptr) != nullptr;
}

void Inspector::find_path(const RendererPair& renderers, const std::shared_ptr<const Scene>& scene) {
  const auto frame = renderers.latest(Half::current);
  if (!at_ || !scene || !frame) return;
  const bool known = report_ && report_->x == at_->x && report_->y == at_->y;
  const std::uint32_t samples = std::clamp(known ? report_->samples : frame->spp, 1u, max_followed);
  jobs_.run([this, at = *at_, scene, samples, wanted = ++wanted_]() -> JobQueue::Result {
    const auto shown = std::make_shared<Shown>();
    try {
      const double end = clock_seconds() + longest_search;
      const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
      const RenderScene& compiled = prepared->columns();
      if (at.x >= compiled.width || at.y >= compiled.height) return {};
      shown->scene = scene;
      shown->found = find_noisy_path(prepared->view(), at.x, at.y, samples, [end] { return clock_seconds() > end; });
      const Vec3f eye = shown->found.path.origin;
      shown->eye = Vec3d{eye.x, eye.y, eye.z} + compiled.origin;
      shown->stops = stops_of(*scene, compiled, shown->found.path);
    } catch (const std::bad_alloc&) {
      return {};  // no memory is left to find one
    }
    return [this, shown, wanted] {
      if (wanted == wanted_) path_ = shown;
    };
  });
}

bool Inspector::collect(const RendererPair& renderers) {
  const bool found = jobs_.collect();
  const auto report = on_ ? renderers.reply().pixel : nullptr;
  return std::exchange(report_, report) != report || found;
}

void Inspector::draw(Ui& ui, const Context& context, const Scene& scene, const RendererPair& renderers) {
  const std::shared_ptr<const Scene>& sent = context.wanted.scene;
  if (path_ && sent && sent != path_->scene) {
    if (change_between(*path_->scene, *sent).others)
      drop_path();
    else
      path_->scene = sent;  // the camera may look from elsewhere
  }
  if (path_) draw_path(ui, scene, context.layout.image, context.visible, path_->eye, path_->stops);
  PixelReadout model;
  const bool pixel = on_ && at_ && context.frame;
  if (pixel) {
    const bool known = report_ && report_->x == at_->x && report_->y == at_->y;
    model = pixel_readout(*context.frame, known ? *report_ : PixelReport{.x = at_->x, .y = at_->y}, scene,
                          renderers.pick(at_->x, at_->y));
  }
  std::vector<std::string> lines = model.lines;
  if (path_) {
    const std::vector<std::string> told = path_lines(path_->found, path_->stops);
    if (!lines.empty()) lines.emplace_back();
    lines.insert(lines.end(), told.begin(), told.end());
  } else if (busy()) {
    lines.emplace_back("following the pixel's samples …");
  } else if (on_ && lines.empty()) {
    lines.emplace_back("point at the picture");
  }
  if (!lines.empty()) draw_lines(ui, context.visible, lines, pixel ? &model.shown : nullptr);
}

}  // namespace tyndall
