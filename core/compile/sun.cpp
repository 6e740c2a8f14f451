#include "core/compile/sun.h"

#include "core/base/math.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double max_tangent = 0.12;        // of half the angle that the sun fills; BSDF sampling finds wider suns well
constexpr double min_fraction = 0.05;       // of the sky's light that comes from the sun
constexpr double min_brightness = 1 / 8.0;  // of the sun's texels, over that of its brightest one

struct Texel {
  int x, y;
  double luminance;
};

class SunFinder {
 public:
  SunFinder(const Image::Pixels& pixels, double irradiance) : pixels_(pixels), irradiance_(irradiance) {}

  SkySun find() {
    if (!list_bright_texels()) return {};
    Vec3d sum{0, 0, 0};
    double light = 0, squares = 0;
    for (const Texel& t : texels_) {
      const double sine = sine_of_row(t.y), own = largest_component(t);
      sum = sum + t.luminance * sine * towards(t.x, t.y);
      light += own * sine, squares += own * own * sine;
    }
    const double texel_angle = 2 * pi * pi / pixels_.width / pixels_.height;  // times the sine, in steradians
    SkySun sun;
    sun.irradiance = light * texel_angle, sun.squares = squares * texel_angle;
    if (sun.irradiance < min_fraction * irradiance_) return {};
    sun.axis = normalize(sum);
    const Vec3d level = cross(Vec3d{0, 1, 0}, sun.axis);
    sun.edge_v = normalize(cross(sun.axis, length(level) > 1e-3 ? level : Vec3d{1, 0, 0}));
    sun.edge_u = cross(sun.edge_v, sun.axis);
    for (const Texel& t : texels_) sun.tangent = std::max(sun.tangent, reach(sun, t));
    return sun.tangent <= max_tangent ? sun : SkySun{};
  }

 private:
  const float* rgb(int x, int y) const {
    return &pixels_.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels_.width) +
                             static_cast<std::size_t>(x))];
  }
  double luminance(int x, int y) const {
    const float* c = rgb(x, y);
    return static_cast<double>(sky_luminance(Vec3<double>{c[0], c[1], c[2]}, 1.0));
  }
  double largest_component(const Texel& t) const {
    const float* c = rgb(t.x, t.y);
    return static_cast<double>(std::max({c[0], c[1], c[2]}));
  }
  double sine_of_row(int y) const { return from_top_of(y).sin; }
  SinCos<double> from_top_of(int y) const { return sin_cos_of(0.5 * (y + 0.5) / pixels_.height); }
  static SinCos<double> sin_cos_of(double part) {
    const SinCos<float> a = sin_cos_2pi(static_cast<float>(part));
    return {static_cast<double>(a.sin), static_cast<double>(a.cos)};
  }
  Vec3d towards(int x, int y) const {
    const SinCos<double> around = sin_cos_of((x + 0.5) / pixels_.width), from_top = from_top_of(y);
    return {-from_top.sin * around.sin, from_top.cos, from_top.sin * around.cos};
  }

  /// The bright texels near the brightest one. False: there are so many that they are no sun.
  bool list_bright_texels() {
    Texel peak{0, 0, 0};
    for (int y = 0; y < pixels_.height; ++y)
      for (int x = 0; x < pixels_.width; ++x)
        if (luminance(x, y) > peak.luminance) peak = {x, y, luminance(x, y)};
    if (!(peak.luminance > 0)) return false;
    const std::size_t texels = pixels_.rgb.size() / 3, too_many = texels / 64 + 9;
    const Vec3d middle = towards(peak.x, peak.y);
    for (int y = 0; y < pixels_.height; ++y)
      for (int x = 0; x < pixels_.width; ++x) {
        const double own = luminance(x, y);
        if (own < min_brightness * peak.luminance || length(towards(x, y) - middle) > 2 * max_tangent) continue;
        texels_.push_back({x, y, own});
        if (texels_.size() > too_many) return false;
      }
    return true;
  }

  /// The largest tangent, by either edge, at which a texel still adds to the sky's bilinear radiance.
  double reach(const SkySun& sun, const Texel& t) const {
    double largest = 0;
    for (int y = std::max(t.y - 1, 0); y <= std::min(t.y + 1, pixels_.height - 1); ++y)
      for (int x = t.x - 1; x <= t.x + 1; ++x) {
        const Vec3d d = towards((x + pixels_.width) % pixels_.width, y);
        const double ahead = dot(d, sun.axis);
        if (!(ahead > 0.5)) return 1;
        largest = std::max({largest, std::abs(dot(d, sun.edge_u)) / ahead, std::abs(dot(d, sun.edge_v)) / ahead});
      }
    return largest;
  }

  const Image::Pixels& pixels_;
  double irradiance_;
  std::vector<Texel> texels_;
};

}  // namespace

SkySun find_sun(const Image::Pixels& pixels, double irradiance) { return SunFinder(pixels, irradiance).find(); }

}  // namespace tyndall
