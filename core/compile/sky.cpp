#include "core/compile/columns.h"

#include "core/base/elementary.h"
#include "core/base/math.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall {
namespace {

constexpr double max_tangent = 0.12;        // of half the angle that the sun fills; BSDF sampling finds wider suns well
constexpr double min_brightness = 1 / 8.0;  // of the sun's texels, over that of its brightest one
constexpr double min_sun = 0.05;            // fraction of the sky's light from which on specular paths look for the sun
constexpr int min_rows = 128;               // so that few rows of texels still follow the sine of the polar angle

/// By the kernels' polynomials, not by the C library, so that all processors compute the same.
SinCos<double> sin_cos_of_revolutions(double revolutions) {
  const SinCos<float> a = sin_cos_2pi(static_cast<float>(revolutions));
  return {static_cast<double>(a.sin), static_cast<double>(a.cos)};
}

/// Sine of the polar angle in the middle of a row, of `rows` from the top.
double sine_of_row(int row, int rows) { return sin_cos_of_revolutions(0.5 * (row + 0.5) / rows).sin; }

/// The texels of a picture of the sky, and the directions of their middles before the sky's turn (core/trace/sky.h).
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

struct Texel {
  int x = 0, y = 0;
  double luminance = 0;
};

void each_texel(const SkyTexels& texels, const auto& visit) {
  for (int y = 0; y < texels.height; ++y)
    for (int x = 0; x < texels.width; ++x) {
      const Vec3f c = texels.rgb(x, y);
      const Vec3d rgb{static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
      visit(Texel{x, y, sky_luminance(rgb, 1.0)});
    }
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

/// Finds the brightest spot of a picture of the sky if it is small; else returns a sun whose tangent is 0. Its
/// irradiance is left at 0.
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

/// Whether a direction (unit, before the sky's turn) lies in the sun's square.
bool is_in_sun(const SkySun& sun, Vec3d direction) {
  const double reach = sun.tangent * dot(direction, sun.axis);
  return std::abs(dot(direction, sun.edge_u)) < reach && std::abs(dot(direction, sun.edge_v)) < reach;
}

/// Shares SkyDistribution::draws among cells in proportion to their weights. Returns where each cell's draws begin, and
/// behind the last cell where all end. A cell of positive weight gets at least one draw, so that it can be drawn; the
/// rest of the division goes to the largest one.
void append_ends(const std::vector<double>& weights, Column<std::int32_t>& out) {
  double total = 0;
  std::int64_t lit = 0;
  for (const double w : weights) total += w, lit += w > 0 ? 1 : 0;
  std::vector<std::int64_t> counts(weights.size(), 0);
  std::int64_t rest = SkyDistribution::draws;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    const double even = std::floor(weights[i] / total * static_cast<double>(SkyDistribution::draws - lit));
    counts[i] = 1 + static_cast<std::int64_t>(even);
    rest -= counts[i];
  }
  if (lit > 0)
    counts[static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin())] += rest;
  std::int64_t end = 0;
  out.push_back(0);
  for (const std::int64_t own : counts) out.push_back(static_cast<std::int32_t>(end += own));
}

/// Integrals over directions of the largest component, and of its square.
struct Light {
  double irradiance = 0, squares = 0;

  void add(double radiance, double solid_angle) {
    irradiance += radiance * solid_angle, squares += radiance * radiance * solid_angle;
  }
  /// See SkyDistribution::spread.
  double spread() const { return squares > 0 ? std::min(1.0, irradiance * irradiance / (squares * 4 * pi)) : 1; }
};

int largest_power_of_two(int up_to) { return static_cast<int>(std::bit_floor(static_cast<unsigned>(up_to))); }

class DistributionBuilder {
 public:
  explicit DistributionBuilder(const Image::Pixels& pixels)
      : texels_(pixels), largest_(*std::max_element(pixels.rgb.begin(), pixels.rgb.end())) {
    const int height = pixels.height;
    out_.rows_per_texel = 2 * std::max(1, (min_rows + 2 * height - 1) / (2 * height));
    out_.rows = height * out_.rows_per_texel;
    out_.row_step = largest_power_of_two(out_.rows), out_.column_step = largest_power_of_two(pixels.width);
  }

  SkyDistribution build() {
    if (!(largest_ > 0)) return {};
    int exponent = 0;
    std::frexp(largest_, &exponent);
    out_.to_one = std::ldexp(1.0f, -std::clamp(exponent, -126, 126));
    std::vector<double> rows, columns(static_cast<std::size_t>(texels_.width));
    out_.column_ends.reserve(static_cast<std::size_t>(out_.rows) * (columns.size() + 1));
    for (int row = 0; row < out_.rows; ++row) {
      weigh_columns(row, columns);
      double sum = 0;
      for (const double w : columns) sum += w;
      rows.push_back(sum * sine_of_row(row, out_.rows));
      append_ends(columns, out_.column_ends);
    }
    append_ends(rows, out_.row_ends);
    out_.sun = find_sun(texels_);
    add_up();
    return std::move(out_);
  }

 private:
  double luminance(int x, int y) const { return static_cast<double>(sky_luminance(texels_.rgb(x, y), out_.to_one)); }

  /// The mean luminance of each cell of a row: that in its middle, because luminance is bilinear in it.
  void weigh_columns(int row, std::vector<double>& columns) const {
    const double y = (row + 0.5) / out_.rows_per_texel - 0.5, above = std::floor(y), part = y - above;
    const int last = texels_.height - 1;
    const int top = std::clamp(static_cast<int>(above), 0, last),
              bottom = std::clamp(static_cast<int>(above) + 1, 0, last);
    const auto at = [&](int x) { return luminance(x, top) + part * (luminance(x, bottom) - luminance(x, top)); };
    const double first = at(0);
    double left = first;
    for (int x = 0; x < texels_.width; ++x) {
      const double right = x + 1 < texels_.width ? at(x + 1) : first;
      columns[static_cast<std::size_t>(x)] = 0.5 * (left + right);
      left = right;
    }
  }

  /// Adds up the light of the sun and that of the rest.
  void add_up() {
    Light sun, rest;
    for (int y = 0; y < texels_.height; ++y) {
      const double solid_angle = texels_.solid_angle(y);
      // The sun's corners are at most atan(sqrt(2) tangent) from its middle.
      const double apart = std::abs(arc_cosine(out_.sun.axis.y) - pi * (y + 0.5) / texels_.height);
      const bool has_sun = out_.sun.tangent > 0 && apart < 1.5 * out_.sun.tangent;
      for (int x = 0; x < texels_.width; ++x)
        (has_sun && is_in_sun(out_.sun, texels_.towards(x, y)) ? sun : rest).add(texels_.largest(x, y), solid_angle);
    }
    out_.irradiance = sun.irradiance + rest.irradiance;
    out_.spread = Light{out_.irradiance, sun.squares + rest.squares}.spread();
    out_.spread_without_sun = rest.spread();
    out_.sun.irradiance = sun.irradiance;
    if (sun.irradiance < min_sun * out_.irradiance) out_.sun = {};
  }

  const SkyTexels texels_;
  const float largest_;
  SkyDistribution out_;
};

}  // namespace

SkyColumns sky_columns(const Background& background, bool is_sampled, const SkyColumns* before) {
  SkyColumns out;
  const auto* sky = std::get_if<SkyPicture>(&background);
  if (!sky) return out;
  out.pixels = sky->pixels;
  out.texels = out.pixels->rgb.data(), out.width = out.pixels->width, out.height = out.pixels->height;
  out.distribution.rows = 2 * out.height;
  const Vec3d rotated = rotate({sky->rotate_y, {}}, {1, 0, 0});  // as objects rotate: exact at multiples of 90 degrees
  out.cos = static_cast<float>(rotated.x), out.sin = static_cast<float>(-rotated.z);
  out.scale = static_cast<float>(sky->scale);
  if (!is_sampled) return out;
  const bool kept = before && !before->distribution.row_ends.empty() && before->pixels == out.pixels;
  const SkyDistribution distribution = kept ? before->distribution : DistributionBuilder(*sky->pixels).build();
  out.irradiance = static_cast<float>(distribution.irradiance * sky->scale);
  if (!out.is_sampled()) return out;
  out.distribution = distribution;
  const auto in_scene = [&](Vec3d v) {
    const auto c = static_cast<double>(out.cos), s = static_cast<double>(out.sin);
    return to_float(Vec3d{c * v.x + s * v.z, v.y, c * v.z - s * v.x});
  };
  const SkySun& sun = distribution.sun;
  out.sun_axis = in_scene(sun.axis), out.sun_edge_u = in_scene(sun.edge_u), out.sun_edge_v = in_scene(sun.edge_v);
  out.sun_tangent = static_cast<float>(sun.tangent);
  return out;
}

}  // namespace tyndall
