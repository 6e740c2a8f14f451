#include "app/window/inspector/pixel_readout.h"

#include "core/image/tonemap.h"

#include <fmt/core.h>

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
  switch (frame.view) {
    case View::noise:
      return fmt::format("noise    {:.2g} %{}", 100 * value, value >= 1 ? " or more" : "");
    case View::cost:
      return fmt::format("cost     {:.3g} rays a path", value);
    default:
      return "";
  }
}

std::array<float, 3> on_screen(Vec3f light, const Display& display) {
  const auto bytes = tone_map({light.x, light.y, light.z}, display.exposure, display.tone_map);
  return {static_cast<float>(bytes[0]) / 255, static_cast<float>(bytes[1]) / 255, static_cast<float>(bytes[2]) / 255};
}

}  // namespace

PixelReadout pixel_readout(const Frame& frame, const PixelReport& report, const SeenThing& seen,
                           const Display& display) {
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
      lines.push_back(fmt::format("clean    {:.4g} {:.4g} {:.4g}", static_cast<double>(clean[0]),
                                  static_cast<double>(clean[1]), static_cast<double>(clean[2])));
    }
    model.shown = on_screen(light, display);
    const auto byte = [&](std::size_t c) { return static_cast<int>(std::lround(255 * model.shown[c])); };
    lines.push_back(fmt::format("shown    {} {} {}", byte(0), byte(1), byte(2)));
  }
  const std::string view = value_of_view(frame, pixel);
  if (!view.empty()) lines.push_back(view);
  lines.push_back("object   " + (seen.object.empty() ? std::string("nothing") : seen.object));
  if (!seen.material.empty()) lines.push_back("material " + seen.material);
  if (!seen.object.empty()) lines.push_back(fmt::format("depth    {:.4g}", seen.depth));
  return model;
}

}  // namespace tyndall
