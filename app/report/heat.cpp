#include "app/report/heat.h"

#include "core/image/tonemap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tyndall {

std::array<float, 3> heat(float value) {
  static constexpr std::array<std::array<float, 3>, 5> stops = {
      {{0, 0, 0}, {0.30f, 0.07f, 0.45f}, {0.78f, 0.20f, 0.34f}, {0.98f, 0.60f, 0.25f}, {1, 1, 0.85f}}};
  if (std::isnan(value)) return {0, 1, 0};
  const float at = std::clamp(value, 0.0f, 1.0f) * 4;
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const float part = at - static_cast<float>(i);
  std::array<float, 3> colour{};
  for (std::size_t k = 0; k < 3; ++k) colour[k] = srgb_decode(stops[i][k] + part * (stops[i + 1][k] - stops[i][k]));
  return colour;
}

}  // namespace tyndall
