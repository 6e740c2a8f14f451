#include "core/accuracy/error.h"

#include "core/base/vec.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

namespace tyndall {
namespace {

constexpr double pixels_per_degree = 67;

/// One channel of a picture.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;
};
using Planes = std::array<Plane, 3>;

/// Weights of a row of pixels, from -radius to radius.
using Line = std::vector<double>;

/// weight(x) for whole x in -radius … radius.
Line line_of(int radius, const std::function<double(double)>& weight) {
  Line line;
  for (int x = -radius; x <= radius; ++x) line.push_back(weight(x));
  return line;
}

/// Scales a row so that the positive weights add up to 1, and the negative ones, if any, to -1.
Line normalized(Line line) {
  double positive = 0, negative = 0;
  for (const double w : line) (w > 0 ? positive : negative) += w;
  for (double& w : line) w /= w > 0 ? positive : -negative;
  return line;
}

/// Convolution along x; pixels outside of the picture are those of its edge.
Plane convolve_rows(const Plane& in, const Line& line) {
  const std::size_t width = static_cast<std::size_t>(in.width), radius = line.size() / 2;
  Plane out{in.width, in.height, std::vector<double>(in.values.size())};
  std::vector<double> wide(width + 2 * radius);
  for (std::size_t y = 0; y < static_cast<std::size_t>(in.height); ++y) {
    const double* row = &in.values[y * width];
    double* to = &out.values[y * width];
    std::fill_n(wide.begin(), radius, row[0]);
    std::copy_n(row, width, wide.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(wide.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
    for (std::size_t i = 0; i < line.size();
         ++i)  // the loop over pixels is inside, so that the compiler can vectorise it
      for (std::size_t x = 0; x < width; ++x) to[x] += line[i] * wide[x + i];
  }
  return out;
}

Plane transposed(const Plane& in) {
  Plane out{in.height, in.width, std::vector<double>(in.values.size())};
  constexpr std::size_t block = 16;  // blocks of 16 x 16 numbers stay in the cache while they are read and written
  const auto w = static_cast<std::size_t>(in.width), h = static_cast<std::size_t>(in.height);
  for (std::size_t top = 0; top < h; top += block)
    for (std::size_t left = 0; left < w; left += block)
      for (std::size_t x = left; x < std::min(left + block, w); ++x)
        for (std::size_t y = top; y < std::min(top + block, h); ++y) out.values[x * h + y] = in.values[y * w + x];
  return out;
}

Plane convolve(const Plane& in, const Line& along_x, const Line& along_y) {
  return transposed(convolve_rows(transposed(convolve_rows(in, along_x)), along_y));
}

/// Linear Rec.709 to CIE XYZ, divided by the white's (IEC 61966-2-1), and back.
Vec3d to_xyz(Vec3d c) {
  return {(0.4124564 * c.x + 0.3575761 * c.y + 0.1804375 * c.z) / 0.95047,
          0.2126729 * c.x + 0.7151522 * c.y + 0.0721750 * c.z,
          (0.0193339 * c.x + 0.1191920 * c.y + 0.9503041 * c.z) / 1.08883};
}
Vec3d from_xyz(Vec3d c) {
  const double x = 0.95047 * c.x, y = c.y, z = 1.08883 * c.z;
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

/// The opponent space in which contrast is filtered (section 4.1.1 of the paper), and back.
Vec3d to_opponent(Vec3d linear) {
  const Vec3d c = to_xyz(linear);
  return {116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}
Vec3d from_opponent(Vec3d o) {
  const double y = (o.x + 16) / 116;
  return from_xyz({y + o.y / 500, y, y - o.z / 200});
}

/// CIE L*a*b* with colourfulness reduced in the dark, after Hunt (section 4.1.2).
Vec3d to_hunt_lab(Vec3d linear) {
  const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (841.0 / 108) * t + 4.0 / 29; };
  const Vec3d c = to_xyz(linear);
  const double x = root(c.x), y = root(c.y), z = root(c.z), lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// HyAB, a distance made for large colour differences, to the power 0.7 (section 4.1.3).
double colour_distance(Vec3d a, Vec3d b) {
  return std::pow(std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z), 0.7);
}

Planes opponent_planes(const std::vector<float>& rgb, int width, int height) {
  const auto clipped = [](float v) { return v > 0 ? std::min(static_cast<double>(v), 1.0) : 0.0; };
  Planes planes;
  for (Plane& plane : planes) plane = {width, height, {}};
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    const Vec3d o = to_opponent({clipped(rgb[i]), clipped(rgb[i + 1]), clipped(rgb[i + 2])});
    planes[0].values.push_back(o.x);
    planes[1].values.push_back(o.y);
    planes[2].values.push_back(o.z);
  }
  return planes;
}

/// a sqrt(π/b) exp(-π² x² / b), x in degrees. The eye's contrast sensitivity is one such bell for lightness and for red
/// against green, and the sum of two for blue against yellow (table 1).
struct Bell {
  double a, b;
};

Plane filter_contrast(const Plane& in, const std::vector<Bell>& bells) {
  constexpr double pi = std::numbers::pi, widest = 0.04;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
  Plane sum{in.width, in.height, std::vector<double>(in.values.size())};
  double total = 0;
  for (const Bell& bell : bells) {
    const Line line = line_of(radius, [&bell](double x) {
      const double degrees = x / pixels_per_degree;
      return std::exp(-pi * pi * degrees * degrees / bell.b);
    });
    double length = 0;
    for (const double w : line) length += w;
    const double fraction = bell.a * std::sqrt(pi / bell.b), volume = fraction * length * length;
    const Plane part = convolve(in, line, line);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += fraction * part.values[i];
    total += volume;
  }
  for (double& v : sum.values) v /= total;
  return sum;
}

/// The picture as an eye perceives it at 67 pixels a degree: filtered by contrast sensitivity, in Hunt-adjusted L*a*b*.
std::vector<Vec3d> seen_colours(const Planes& planes) {
  const Plane light = filter_contrast(planes[0], {{1, 0.0047}});
  const Plane red_green = filter_contrast(planes[1], {{1, 0.0053}});
  const Plane blue_yellow = filter_contrast(planes[2], {{34.1, 0.04}, {13.5, 0.025}});
  std::vector<Vec3d> colours;
  for (std::size_t i = 0; i < light.values.size(); ++i) {
    const Vec3d c = from_opponent({light.values[i], red_green.values[i], blue_yellow.values[i]});
    colours.push_back(to_hunt_lab({std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)}));
  }
  return colours;
}

/// Strength of an edge and of a point at each pixel; 0 where lightness is uniform (section 4.2).
struct Features {
  std::vector<double> edges, points;
};
Features find_features(Plane light) {
  for (double& v : light.values) v = (v + 16) / 116;
  const double deviation = 0.5 * 0.082 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto bell = [deviation](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  const Line smooth = normalized(line_of(radius, bell));
  const Line edge = normalized(line_of(radius, [&](double x) { return -x * bell(x); }));
  const Line point =
      normalized(line_of(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * bell(x); }));
  const auto length = [&](const Line& line) {
    std::vector<double> lengths = convolve(light, line, smooth).values;
    const std::vector<double> other = convolve(light, smooth, line).values;
    for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i] = std::hypot(lengths[i], other[i]);
    return lengths;
  };
  return {length(edge), length(point)};
}

/// Maps a colour distance to an error in [0, 1]: distances up to 0.4 of the largest one to [0, 0.95], larger ones to
/// the rest (section 4.1.4).
double colour_error(double distance) {
  const double largest = colour_distance(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1}));
  const double knee = 0.4 * largest;
  return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (largest - knee);
}

}  // namespace

std::vector<float> flip_map(const std::vector<float>& image, const std::vector<float>& reference, int width,
                            int height) {
  assert(image.size() == reference.size());
  assert(image.size() == std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const Planes a = opponent_planes(image, width, height), b = opponent_planes(reference, width, height);
  const std::vector<Vec3d> colours_a = seen_colours(a), colours_b = seen_colours(b);
  const Features features_a = find_features(a[0]), features_b = find_features(b[0]);
  std::vector<float> map;
  map.reserve(colours_a.size());
  for (std::size_t i = 0; i < colours_a.size(); ++i) {
    const double colour = colour_error(colour_distance(colours_a[i], colours_b[i]));
    const double feature = std::max(std::abs(features_a.edges[i] - features_b.edges[i]),
                                    std::abs(features_a.points[i] - features_b.points[i]));
    map.push_back(static_cast<float>(std::pow(colour, std::max(1 - std::sqrt(feature / std::numbers::sqrt2), 0.0))));
  }
  return map;
}

}  // namespace tyndall
