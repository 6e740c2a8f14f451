#pragma once
#include "core/base/math.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tyndall {

/// A picture, sRGB 8-bit, looked up by uv: bilinear, v up, u wraps, v ends at the edge rows.
struct Image {
  static constexpr const char* type = "image";
  struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3·width·height, top row first
    bool operator==(const Pixels&) const = default;
  };
  std::string file;                      ///< as written in the scene file
  std::shared_ptr<const Pixels> pixels;  ///< shared by copies of the scene; never null after reading
  bool operator==(const Image& other) const {
    return file == other.file &&
           (pixels == other.pixels || (pixels && other.pixels && *pixels == *other.pixels));
  }
};

/// texels: 3·width·height linear floats, top row first.
template <class F>
TYNDALL_INLINE Vec3<F> image_colour(const float* texels, int width, int height, F u, F v) {
  using I = IntOf<F>;
  const F w = splat<F>(static_cast<float>(width)), h = splat<F>(static_cast<float>(height));
  const F x = mul_add(u - floor(u), w, F(-0.5f));
  const F y = min(max(mul_add(F(1.0f) - v, h, F(-0.5f)), F(0.0f)), h - F(1.0f));
  const F x0 = floor(x), y0 = floor(y);
  const F fx = x - x0, fy = y - y0;
  const I columns = I(width), last_row = I(height - 1);
  const I left_raw = to_int(x0);
  const I left = select(less(left_raw, I(0)), left_raw + columns, left_raw);
  const I right_raw = left + I(1);
  const I right = select(less(right_raw, columns), right_raw, right_raw - columns);
  const I top = to_int(y0), bottom_raw = top + I(1);
  const I bottom = select(less(last_row, bottom_raw), last_row, bottom_raw);
  const auto texel = [&](I column, I row) {
    const I at = (row * columns + column) * I(3);
    return Vec3<F>{gather<F>(texels, at), gather<F>(texels + 1, at), gather<F>(texels + 2, at)};
  };
  const auto mix = [](Vec3<F> a, Vec3<F> b, F t) { return along(a, t, b - a); };
  return mix(mix(texel(left, top), texel(right, top), fx), mix(texel(left, bottom), texel(right, bottom), fx), fy);
}

/// uv of a sphere from the outward unit direction in its own frame.
/// The Next Week, section 4.4 "Texture Coordinates for Spheres".
template <class F>
TYNDALL_INLINE void sphere_uv(Vec3<F> outward, F& u, F& v) {
  u = (atan2(-outward.z, outward.x) + F(static_cast<float>(pi))) * F(static_cast<float>(0.5 / pi));
  v = acos(min(max(-outward.y, F(-1.0f)), F(1.0f))) * F(static_cast<float>(1 / pi));
}

}  // namespace tyndall
