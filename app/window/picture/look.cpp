#include "app/window/picture/look.h"

#include "app/window/picture/stops.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

/// The bands' colours in bytes.
std::array<Pixel, stop_colours.size()> stop_pixels() {
  std::array<Pixel, stop_colours.size()> pixels;
  const auto byte = [](float v) { return static_cast<std::uint8_t>(std::lround(255 * v)); };
  std::transform(stop_colours.begin(), stop_colours.end(), pixels.begin(), [&](const ScreenColour& c) {
    return Pixel{byte(c.r), byte(c.g), byte(c.b), 255};
  });
  return pixels;
}

void put_stops(const std::vector<float>& rgba, double exposure, std::vector<std::uint8_t>& bytes) {
  const auto pixels = stop_pixels();
  const float gain = std::exp2(static_cast<float>(exposure));
  const auto light = [&](std::size_t i) { return rgba[i] > 0 ? std::min(gain * rgba[i], 1e30f) : 0.0f; };
  bytes.resize(rgba.size());
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const float luminance = 0.2126f * light(i) + 0.7152f * light(i + 1) + 0.0722f * light(i + 2);  // Rec.709
    const float band = std::floor(std::log2(luminance / middle_grey) + 0.5f) - darkest_stop;
    const Pixel pixel =
        luminance > 0 ? pixels[static_cast<std::size_t>(std::clamp(band, 0.0f, static_cast<float>(pixels.size() - 1)))]
                      : Pixel{0, 0, 0, 255};
    std::copy(pixel.begin(), pixel.end(), bytes.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

void screen_bytes(const std::vector<float>& rgba, int width, const Look& look, std::vector<std::uint8_t>& bytes) {
  if (look.stops) return put_stops(rgba, look.exposure, bytes);
  tone_map_rgba(rgba, look.exposure, look.tone_map, width, look.dither, bytes);
}

}  // namespace tyndall
