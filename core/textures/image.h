#pragma once
#include "core/base/math.h"
#include "core/textures/point.h"

#include <memory>
#include <string>
#include <vector>

/// Pictures as textures: what the scene holds, and their colour at a point.
namespace tyndall {

/// A picture, laid on a surface by its uv coordinates and interpolated between pixels. v points up.
/// Outside of [0, 1] v gives the colour of the first or last row. u does the same with columns, except on spheres: they
/// are closed in that direction, so the picture goes on from its last column to its first.
struct Image {
  static constexpr const char* type = "image";
  static constexpr const char* about =
      "A picture laid on the surface by its uv coordinates, bilinear; v is up. u wraps around spheres and ends at the "
      "edge of flat shapes and boxes. An alpha channel is not looked at: what is hidden beneath it is shown. Not for "
      "media.";
  struct Pixels {
    int width = 0, height = 0;
    std::vector<float> rgb;              ///< 3·width·height linear numbers, top row first; in [0, 1] but for skies
    bool has_alpha = false;              ///< some pixel of the file is not opaque, which is not looked at
    std::vector<std::string> remarks{};  ///< what a user should know of how the file was read, a line each
    float largest = 1;                   ///< of these numbers, or more
    bool operator==(const Pixels&) const = default;
  };
  std::string file;                      ///< as written in the scene file
  std::shared_ptr<const Pixels> pixels;  ///< shared by copies of the scene; never null after reading
  bool operator==(const Image& other) const {
    return file == other.file && (pixels == other.pixels || (pixels && other.pixels && *pixels == *other.pixels));
  }
};

/// Colour at a point of the picture. texels: 3·width·height linear floats, top row first.
template <class F>
TYNDALL_INLINE Vec3<F> image_colour(const float* texels, int width, int height, const TextureUv<F>& uv) {
  using I = IntOf<F>;
  const F zero = F(0.0f), one = F(1.0f);
  const F last_column = splat<F>(static_cast<float>(width - 1)), last_row = splat<F>(static_cast<float>(height - 1));
  const F across = mul_add(select(uv.wraps, uv.u - floor(uv.u), uv.u), last_column + one, F(-0.5f));
  const F x = select(uv.wraps, across, min(max(across, zero), last_column));
  const F y = min(max(mul_add(one - uv.v, last_row + one, F(-0.5f)), zero), last_row);
  const F x0 = floor(x), y0 = floor(y);
  const F fx = x - x0, fy = y - y0;
  // Clamped as well as wrapped: lanes that are not used may hold any number and still must not read beyond the table.
  const F left_column = min(max(select(less(x0, zero), last_column, x0), zero), last_column);
  const F right_column = select(less(left_column, last_column), left_column + one, zero);
  const I left = to_int(left_column), right = to_int(right_column);
  const I top = to_int(y0), bottom = to_int(min(y0 + one, last_row));
  const auto texel = [&](I column, I row) {
    const I at = (row * I(width) + column) * I(3);
    return Vec3<F>{gather<F>(texels, at), gather<F>(texels + 1, at), gather<F>(texels + 2, at)};
  };
  const auto mix = [](Vec3<F> a, Vec3<F> b, F t) { return point_at(a, t, b - a); };
  return mix(mix(texel(left, top), texel(right, top), fx), mix(texel(left, bottom), texel(right, bottom), fx), fy);
}

/// uv of a sphere from the outward unit direction in its own frame.
/// The Next Week, section 4.4 "Texture Coordinates for Spheres".
template <class F>
TYNDALL_INLINE void sphere_uv(Vec3<F> outward, F& u, F& v) {
  u = (atan2(-outward.z, outward.x) + F(static_cast<float>(pi))) * F(static_cast<float>(0.5 / pi));
  v = acos(min(max(-outward.y, F(-1.0f)), F(1.0f))) * F(static_cast<float>(1 / pi));
}

template <class F, class Uv>
TYNDALL_INLINE Vec3<F> colour_at(const Image*, const auto& columns, const TexturePoint<F, Uv>& at) {
  return image_colour(columns.texels, columns.width, columns.height, at.uv());
}

}  // namespace tyndall
