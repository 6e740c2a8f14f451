#pragma once
#include "maths.h"

#include <algorithm>
#include <cmath>

/// What the loop in main() of editions 1 to 3 has answered: see loop.h.
namespace tyndall_book {

enum Pixel { up, down, sideways, slanted, backwards, mirrors, dimmed, shining, dimmed_light, pixel_count };

inline vec3 direction_of(int pixel) {
  if (pixel == down) return vec3(0, -1, 0);
  if (pixel == sideways) return vec3(1, 0, 0);
  if (pixel == slanted) return vec3(0, 1.2, 1.6);  // of length 2: the sky must not depend on that
  if (pixel == backwards) return vec3(0, 0, -1);
  return vec3(0, 1, 0);
}

/// What the loop has shown. Numbers that main() wrote as 8 bits are coarse; they may be by any of the usual curves.
struct LoopAnswers {
  vec3 mean[pixel_count];
  bool coarse = false;
  double gamma = 2;

  /// A channel of a pixel's light, linear.
  double light(int pixel, int channel) const {
    const double value = mean[pixel][channel];
    return coarse ? std::pow(value, gamma) : value;
  }
  bool near(double a, double b) const {
    return std::fabs(a - b) <= (coarse ? 0.02 : 1e-6) * std::max(1.0, std::fabs(b));
  }
  bool takes_light() const { return light(shining, 0) > 0; }
  /// The largest channel of the sky.
  double brightest() const {
    double largest = 0;
    for (int pixel = up; pixel < mirrors; ++pixel)
      for (int k = 0; k < 3; ++k) largest = std::max(largest, light(pixel, k));
    return largest;
  }
  void find_gamma();
  bool adds_up() const;
  vec3 sky(int pixel) const;
  bool sky_is_constant() const;
  bool sky_is_gradient() const;
};

/// The curve, from two values of which one is a quarter of the other.
inline void LoopAnswers::find_gamma() {
  const double whole = mean[takes_light() ? shining : up][0], part = mean[takes_light() ? dimmed_light : dimmed][0];
  if (!coarse || part <= 0 || part >= whole) return;
  const double found = std::log(0.25) / std::log(part / whole);
  for (const double known : {1.0, 2.0, 2.2})
    if (std::fabs(found - known) < 0.1) gamma = known;
}

/// Whether ray_color() multiplies and adds light as the books' does.
inline bool LoopAnswers::adds_up() const {
  for (int k = 0; k < 3; ++k) {
    const bool lit = near(light(shining, k), 0.5) && near(light(dimmed_light, k), 0.125);
    if (!near(light(dimmed, k), light(up, k) / 4) || (takes_light() && !lit)) return false;
  }
  return true;
}

/// The sky's colour, without the last digits of sums; of those that 8 bits cannot tell apart the one with the fewest.
inline vec3 LoopAnswers::sky(int pixel) const {
  vec3 colour;
  for (int k = 0; k < 3; ++k) {
    const double value = light(pixel, k);
    colour[k] = std::round(value * 1e9) / 1e9;
    for (double scale = 100; coarse && scale >= 10; scale /= 10) {
      const double rounded = std::round(value * scale) / scale;
      const double step = std::fabs(std::pow(rounded, 1 / gamma) - std::pow(value, 1 / gamma));
      if (step < 0.75 / 255) colour[k] = rounded;
    }
  }
  return colour;
}

inline bool LoopAnswers::sky_is_constant() const {
  for (int pixel = up; pixel < mirrors; ++pixel)
    for (int k = 0; k < 3; ++k)
      if (!near(light(pixel, k), light(up, k))) return false;
  return true;
}

inline bool LoopAnswers::sky_is_gradient() const {
  for (int k = 0; k < 3; ++k) {
    const double top = light(up, k), bottom = light(down, k), middle = (top + bottom) / 2;
    if (!near(light(sideways, k), middle) || !near(light(backwards, k), middle)) return false;
    if (!near(light(slanted, k), bottom + 0.8 * (top - bottom))) return false;
  }
  return true;
}

}  // namespace tyndall_book
