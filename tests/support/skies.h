#pragma once
#include "core/scene/scene.h"
#include "tests/support/mixed_scene.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

/// Pictures of skies, made in memory.
namespace tyndall::test {

/// The sky of these pixels (linear RGB, top row first).
inline SkyPicture sky_of(int width, int height, std::vector<float> rgb) {
  SkyPicture sky;
  sky.file = "sky.hdr";
  const float largest = *std::max_element(rgb.begin(), rgb.end());
  sky.pixels = std::make_shared<const Image::Pixels>(Image::Pixels{width, height, std::move(rgb), false, {}, largest});
  return sky;
}
inline SkyPicture uniform_sky(int width, int height, float radiance) {
  return sky_of(width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), radiance));
}
/// Each number even between 0 and 2, every fifth texel black.
inline SkyPicture random_sky(int width, int height, unsigned seed) {
  Engine engine(seed);
  std::vector<float> rgb(static_cast<std::size_t>(3 * width * height));
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = i / 3 % 5 == 0 ? 0.0f : static_cast<float>(uniform(engine, 0, 2));
  return sky_of(width, height, std::move(rgb));
}
/// 64 x 32 texels of radiance 1 with one of `sun`.
inline SkyPicture sunny_sky(float sun, int column = 20, int row = 9) {
  SkyPicture sky = uniform_sky(64, 32, 1);
  std::vector<float> rgb = sky.pixels->rgb;
  for (int c = 0; c < 3; ++c) rgb[static_cast<std::size_t>(3 * (row * 64 + column) + c)] = sun;
  return sky_of(64, 32, std::move(rgb));
}

}  // namespace tyndall::test
