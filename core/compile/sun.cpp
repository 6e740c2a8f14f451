#include "core/compile/sun.h"

#include "core/base/elementary.h"

#include <cmath>

namespace tyndall {
namespace {

constexpr double max_tangent = 0.12;        // of half the angle that the sun fills; BSDF sampling finds wider suns well
constexpr double min_brightness = 1 / 8.0;  // of the sun's texels, over that of its brightest one

struct Texel {
  int x = 0, y = 0;
  double luminance = 0;
};

double luminance_of(const SkyTexels& texels, int x, int y) {
  const Vec3f rgb = texels.rgb(x, y);
  return sky_luminance(Vec3d{static_cast<double>(rgb.x), static_cast<double>(rgb.y), static_cast<double>(rgb.z)}, 1.0);
}

void each_texel(const SkyTexels& texels, const auto& visit) {
  for (int y = 0; y < texels.height; ++y)
    for (int x = 0; x < texels.width; ++x) visit(Texel{x, y, luminance_of(texels, x, y)});
}

/// The bright texels around the brightest one; none if the picture is black.
std::vector<Texel> list_bright_texels(const SkyTexels& texels) {
  Texel brightest;
  each_texel(texels, [&](const Texel& t) {
    if (t.luminance > brightest.luminance) brightest = t;
  });
  std::vector<Texel> list;
  if (!(brightest.luminance > 0)) return list;
  const Vec3d middle = texels.towards(brightest.x, brightest.y);
  each_texel(texels, [&](const Texel& t) {
    if (t.luminance < min_brightness * brightest.luminance) return;
    if (length(texels.towards(t.x, t.y) - middle) < 2 * max_tangent) list.push_back(t);
  });
  return list;
}

/// The largest tangent, by either edge, at which a texel still adds to the sky's bilinear radiance.
double reach_of(const SkySun& sun, const SkyTexels& texels, const Texel& t) {
  double largest = 0;
  for (int y = std::max(t.y - 1, 0); y <= std::min(t.y + 1, texels.height - 1); ++y)
    for (int x = t.x - 1; x <= t.x + 1; ++x) {
      const Vec3d d = texels.towards((x + texels.width) % texels.width, y);
      const double ahead = dot(d, sun.axis);
      if (!(ahead > 0.5)) return 1;
      largest = std::max({largest, std::abs(dot(d, sun.edge_u)) / ahead, std::abs(dot(d, sun.edge_v)) / ahead});
    }
  return largest;
}

}  // namespace

SkySun find_sun(const SkyTexels& texels) {
  const std::vector<Texel> bright = list_bright_texels(texels);
  if (bright.empty()) return {};
  Vec3d sum{0, 0, 0};
  for (const Texel& t : bright) sum = sum + t.luminance * texels.solid_angle(t.y) * texels.towards(t.x, t.y);
  SkySun sun;
  sun.axis = normalize(sum);
  const Vec3d level = cross(Vec3d{0, 1, 0}, sun.axis);
  sun.edge_v = normalize(cross(sun.axis, length(level) > 1e-3 ? level : Vec3d{1, 0, 0}));
  sun.edge_u = cross(sun.edge_v, sun.axis);
  for (const Texel& t : bright) {
    sun.tangent = std::max(sun.tangent, reach_of(sun, texels, t));
    if (sun.tangent > max_tangent) return {};
  }
  return sun;
}

bool row_has_sun(const SkySun& sun, int row, int rows) {
  // The square's corners are at most atan(sqrt(2) tangent) from its middle.
  return sun.tangent > 0 && std::abs(arc_cosine(sun.axis.y) - pi * (row + 0.5) / rows) < 1.5 * sun.tangent;
}

}  // namespace tyndall
