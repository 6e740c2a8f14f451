#include "core/accuracy/finite.h"

#include "core/base/text.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// The pixel's position as "X,Y", and its first value that is not finite.
std::string place_text(const LinearImage& image, std::size_t pixel) {
  constexpr const char* channels[] = {"red", "green", "blue"};
  const float* rgb = image.rgb.data() + 3 * pixel;
  const float* wrong = std::find_if_not(rgb, rgb + 3, [](float v) { return std::isfinite(v); });
  const int width = image.width, x = static_cast<int>(pixel % static_cast<std::size_t>(width)),
            y = static_cast<int>(pixel / static_cast<std::size_t>(width));
  const Region at = image.frame ? image.frame->data : Region{};
  return std::to_string(at.x0 + x) + "," + std::to_string(at.y0 + y) + " (" + channels[wrong - rgb] + " is " +
         number_text(static_cast<double>(*wrong)) + ")";
}

}  // namespace

bool is_finite(const LinearImage& image, std::size_t pixel) {
  const float* rgb = image.rgb.data() + 3 * pixel;
  return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

std::string not_finite_text(const LinearImage& image) {
  const std::size_t pixels = image.rgb.size() / 3;
  std::size_t wrong = 0, first = 0;
  for (std::size_t i = 0; i < pixels; ++i)
    if (!is_finite(image, i) && wrong++ == 0) first = i;
  if (wrong == 0) return "";
  return std::to_string(wrong) + " of " + std::to_string(pixels) + " pixels " + (wrong == 1 ? "is" : "are") +
         " not finite, the first at " + place_text(image, first);
}

}  // namespace tyndall
