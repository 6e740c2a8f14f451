#include "core/compile/near_lamps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

// The conditions in near_lamps.h, as numbers.
constexpr float nearness = 1.5f;      // largest distance of a light from the medium's centre, in half widths of it
constexpr float small_lamp = 0.1f;    // largest radius of the light over the half width and over its camera distance
constexpr float most_free_paths = 4;  // largest half width of the medium, in mean free paths

struct Place {
  float outside;     // distance from the medium's centre, in half widths
  float half_width;  // the smallest of the three axes
};

Place place_of(const MediumColumns& m, Vec3f point) {
  if (!m.box) return {length(point - m.center) / m.radius, m.radius};
  Place place{0, std::numeric_limits<float>::infinity()};
  for (int i = 0; i < 3; ++i) {
    place.outside = std::max(place.outside, std::abs(affine_point<float>(m.map, i, point)));
    place.half_width = std::min(place.half_width, 1 / length(m.map.row[i]));
  }
  return place;
}

bool pays(const MediumColumns& m, Vec3f light, float reach, Vec3f camera) {
  const Place place = place_of(m, light);
  const bool scatters = m.texture >= 0 || !(m.albedo == Vec3f{0, 0, 0});
  return scatters && m.density * place.half_width <= most_free_paths && place.outside <= nearness &&
         reach <= small_lamp * std::min(place.half_width, length(light - camera));
}

}  // namespace

NearLamps find_near_lamps(const RenderScene& s) {
  NearLamps near;
  for (std::size_t m = 0; m < s.media.size(); ++m)
    for (std::size_t k = 0; k < s.lights.kind.size(); ++k) {
      const Vec3f center{s.lights.center[0][k], s.lights.center[1][k], s.lights.center[2][k]};
      if (!pays(s.media[m], center, std::sqrt(s.lights.reach2[k]), s.camera.center)) continue;
      near.medium.push_back(static_cast<std::int32_t>(m));
      near.light.push_back(static_cast<std::int32_t>(k));
    }
  if (near.medium.empty()) return near;
  near.probability.assign(s.media.size() * s.lights.kind.size(), 0);
  for (std::size_t i = 0; i < near.medium.size(); ++i)
    near.probability[static_cast<std::size_t>(near.medium[i]) * s.lights.kind.size() +
                     static_cast<std::size_t>(near.light[i])] = 1 / static_cast<float>(near.medium.size());
  return near;
}

}  // namespace tyndall
