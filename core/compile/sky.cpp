#include "core/base/math.h"
#include "core/compile/columns.h"
#include "core/compile/sky_texels.h"
#include "core/compile/sun.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tyndall {
namespace {

constexpr int min_rows = 128;  // so that few rows of texels still follow the sine of the polar angle

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

constexpr double min_sun = 0.05;  // fraction of the sky's light from which on specular paths look for the sun

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
      const bool has_sun = row_has_sun(out_.sun, y, texels_.height);
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
