#include "app/window/panels/panels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr std::size_t max_counted = 16384;

std::string percent_of(double part) { return part == 0 ? "0 %" : fmt::format("{:.2g} %", 100 * part); }

void draw_bars(ImDrawList& draw, const Rect& frame, const Histogram& histogram) {
  constexpr Tone tones[3] = {{1, 0.35f, 0.3f, 1}, {0.35f, 0.9f, 0.4f, 1}, {0.4f, 0.55f, 1, 1}};
  const double maximum = std::log1p(static_cast<double>(histogram.pixels));
  const float step = frame.width() / static_cast<float>(Histogram::bins);
  for (std::size_t channel = 0; channel < 3; ++channel)
    for (std::size_t bin = 0; bin < Histogram::bins; ++bin) {
      const double part = std::log1p(static_cast<double>(histogram.counts[channel][bin])) / std::max(maximum, 1e-9);
      const float x = frame.x0 + step * static_cast<float>(bin),
                  top = frame.y1 - static_cast<float>(part) * frame.height();
      draw.AddRectFilled({x, top}, {x + step, frame.y1}, shade(tones[channel], 0.4f));
    }
}

}  // namespace

Histogram histogram_of(const std::vector<float>& rgba, const Display& display) {
  const std::size_t pixels = rgba.size() / 4, stride = std::max<std::size_t>(1, pixels / max_counted) | 1;
  std::vector<float> rgb;
  for (std::size_t i = 0; i < pixels; i += stride) rgb.insert(rgb.end(), &rgba[4 * i], &rgba[4 * i + 3]);
  const std::vector<std::uint8_t> shown = tone_map(rgb, display.exposure, display.tone_map);
  Histogram found;
  for (std::size_t i = 0; i + 2 < shown.size(); i += 3) {
    const std::uint8_t brightest = std::max({shown[i], shown[i + 1], shown[i + 2]});
    found.white += brightest == 255, found.black += brightest == 0;
    for (std::size_t c = 0; c < 3; ++c) ++found.counts[c][shown[i + c] * Histogram::bins / 256];
    ++found.pixels;
  }
  const std::uint32_t all = std::max(found.pixels, 1u);
  found.white /= all, found.black /= all;
  return found;
}

const Histogram& LiveHistogram::of(const Frame& frame, const Display& display) {
  if (frame.pass == pass_ && frame.clean.get() == clean_ && display == display_) return histogram_;
  pass_ = frame.pass, clean_ = frame.clean.get(), display_ = display;
  const bool beauty = frame.view == View::beauty;
  const std::vector<float>& picture = !beauty ? frame.beauty : frame.clean ? frame.clean->rgba : frame.rgba;
  if (beauty || !picture.empty()) histogram_ = histogram_of(picture, display);
  return histogram_;
}

void histogram_panel(Ui& ui, PanelState& state) {
  if (!section(ui, "Histogram", "what is shown, logarithmic") || !state.now.frame) return;
  const Histogram& histogram = state.histogram.of(*state.now.frame, state.scene->display);
  const float s = ui.scale, width = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX();
  const ImVec2 at = ImGui::GetCursorScreenPos(), size{std::max(width, 1.0f), 64 * s};
  ImGui::InvisibleButton("histogram", size);
  const std::string said =
      "white, clipped: " + percent_of(histogram.white) + " of the pixels; black: " + percent_of(histogram.black);
  log_item(ui, "histogram", said);
  tooltip(ui, "values on the screen from black to white; heights are logarithms of how many pixels have them");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, shade(palette::ink), 4 * s);
  draw_bars(draw, {at.x + 4 * s, at.y + 4 * s, at.x + size.x - 4 * s, at.y + size.y - 2 * s}, histogram);
  note(ui, said, false, histogram.white > 0.01 ? palette::amber : palette::dim);
}

}  // namespace tyndall
