#include "core/compile/sky.h"

#include "core/base/math.h"
#include "core/compile/flatten.h"
#include "core/compile/sun.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr int min_rows = 128;  // so that few rows of texels still follow the sine of the polar angle

/// Shares SkyDistribution::draws among cells in proportion to their weights. Returns where each cell's draws begin, and
/// behind the last cell where all end. A cell of positive weight gets at least one draw, so that it can be drawn; the
/// rest of the division goes to the largest one.
void append_ends(const std::vector<double>& weights, std::vector<std::int32_t>& out) {
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

double sine_of_row(int row, int rows) {
  return static_cast<double>(sin_cos_2pi(0.5f * (static_cast<float>(row) + 0.5f) / static_cast<float>(rows)).sin);
}

class DistributionBuilder {
 public:
  explicit DistributionBuilder(const Image::Pixels& pixels) : pixels_(pixels) {
    const int height = pixels.height;
    out_.rows_per_texel = 2 * std::max(1, (min_rows + 2 * height - 1) / (2 * height));
    out_.rows = height * out_.rows_per_texel;
  }

  SkyDistribution build() {
    const float largest = *std::max_element(pixels_.rgb.begin(), pixels_.rgb.end());
    if (!(largest > 0)) return {};
    int exponent = 0;
    std::frexp(largest, &exponent);
    out_.to_one = std::ldexp(1.0f, -std::clamp(exponent, -126, 126));
    std::vector<double> rows, columns(static_cast<std::size_t>(pixels_.width));
    out_.column_ends.reserve(static_cast<std::size_t>(out_.rows) * (columns.size() + 1));
    for (int row = 0; row < out_.rows; ++row) {
      weigh_columns(row, columns);
      double sum = 0;
      for (const double w : columns) sum += w;
      rows.push_back(sum * sine_of_row(row, out_.rows));
      append_ends(columns, out_.column_ends);
    }
    append_ends(rows, out_.row_ends);
    add_up();
    out_.sun = find_sun(pixels_, out_.irradiance);
    out_.spread = spread_of(out_.irradiance, out_.squares);
    out_.spread_without_sun = spread_of(out_.irradiance - out_.sun.irradiance, out_.squares - out_.sun.squares);
    return std::move(out_);
  }

 private:
  const float* texel(int x, int y) const {
    return &pixels_.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels_.width) +
                             static_cast<std::size_t>(x))];
  }
  double luminance(int x, int y) const {
    const float* rgb = texel(x, y);
    return static_cast<double>(sky_luminance(Vec3f{rgb[0], rgb[1], rgb[2]}, out_.to_one));
  }

  /// The mean luminance of each cell of a row: that in its middle, because luminance is bilinear in it.
  void weigh_columns(int row, std::vector<double>& columns) const {
    const double y = (row + 0.5) / out_.rows_per_texel - 0.5, above = std::floor(y), part = y - above;
    const int last = pixels_.height - 1;
    const int top = std::clamp(static_cast<int>(above), 0, last),
              bottom = std::clamp(static_cast<int>(above) + 1, 0, last);
    const auto at = [&](int x) { return luminance(x, top) + part * (luminance(x, bottom) - luminance(x, top)); };
    const double first = at(0);
    double left = first;
    for (int x = 0; x < pixels_.width; ++x) {
      const double right = x + 1 < pixels_.width ? at(x + 1) : first;
      columns[static_cast<std::size_t>(x)] = 0.5 * (left + right);
      left = right;
    }
  }

  void add_up() {
    double sum = 0, squares = 0;  // of the largest components, in units
    for (int y = 0; y < pixels_.height; ++y) {
      double row = 0, row_squares = 0;
      for (int x = 0; x < pixels_.width; ++x) {
        const float* rgb = texel(x, y);
        const double own = static_cast<double>(out_.to_one) * static_cast<double>(std::max({rgb[0], rgb[1], rgb[2]}));
        row += own, row_squares += own * own;
      }
      const double sine = sine_of_row(y, pixels_.height);
      sum += row * sine, squares += row_squares * sine;
    }
    const double texel_angle = 2 * pi * pi / pixels_.width / pixels_.height;  // times the sine, in steradians
    const auto to_one = static_cast<double>(out_.to_one);
    out_.irradiance = sum * texel_angle / to_one, out_.squares = squares * texel_angle / to_one / to_one;
  }

  static double spread_of(double irradiance, double squares) {
    return squares > 0 ? std::min(1.0, irradiance * irradiance / (squares * 4 * pi)) : 1;
  }

  const Image::Pixels& pixels_;
  SkyDistribution out_;
};

}  // namespace

SkyColumns sky_columns(const Background& background, bool is_sampled, const SkyColumns* before) {
  SkyColumns out;
  const auto* sky = std::get_if<SkyPicture>(&background);
  if (!sky) return out;
  out.pixels = sky->pixels;
  const Vec3d rotated = rotate({sky->rotate_y, {}}, {1, 0, 0});  // as objects rotate: exact at multiples of 90 degrees
  out.cos = static_cast<float>(rotated.x), out.sin = static_cast<float>(-rotated.z);
  out.scale = static_cast<float>(sky->scale);
  if (!is_sampled) return out;
  const bool kept = before && before->distribution && before->pixels == out.pixels;
  out.distribution =
      kept ? before->distribution : std::make_shared<const SkyDistribution>(DistributionBuilder(*sky->pixels).build());
  out.irradiance = static_cast<float>(out.distribution->irradiance * sky->scale);
  return out;
}

}  // namespace tyndall
