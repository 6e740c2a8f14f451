#pragma once
#include "core/compile/render_scene.h"

#include <algorithm>

/// The texels of a picture of the sky, and the directions of their middles before the sky's turn (core/trace/sky.h).
namespace tyndall {

/// By the kernels' polynomials, not by the C library, so that all processors compute the same.
inline SinCos<double> sin_cos_of_revolutions(double revolutions) {
  const SinCos<float> a = sin_cos_2pi(static_cast<float>(revolutions));
  return {static_cast<double>(a.sin), static_cast<double>(a.cos)};
}

/// Sine of the polar angle in the middle of a row, of `rows` from the top.
inline double sine_of_row(int row, int rows) { return sin_cos_of_revolutions(0.5 * (row + 0.5) / rows).sin; }

class SkyTexels {
 public:
  explicit SkyTexels(const Image::Pixels& pixels) : width(pixels.width), height(pixels.height), rgb_(pixels.rgb) {}

  const int width, height;

  Vec3f rgb(int x, int y) const {
    const float* c =
        &rgb_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
    return {c[0], c[1], c[2]};
  }
  double largest(int x, int y) const { return static_cast<double>(max_component(rgb(x, y))); }

  /// Solid angle of each texel of a row, in steradians.
  double solid_angle(int y) const { return 2 * pi * pi / width / height * sine_of_row(y, height); }

  /// Unit.
  Vec3d towards(int x, int y) const {
    const SinCos<double> around = sin_cos_of_revolutions((x + 0.5) / width),
                         polar = sin_cos_of_revolutions(0.5 * (y + 0.5) / height);
    return {-polar.sin * around.sin, polar.cos, polar.sin * around.cos};
  }

 private:
  const std::vector<float>& rgb_;
};

}  // namespace tyndall
