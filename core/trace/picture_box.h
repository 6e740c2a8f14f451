#pragma once
#include "core/compile/render_scene.h"

#include <algorithm>
#include <cstdint>

/// Parts of the picture in which the camera sees a small light.
namespace tyndall {

/// In pixels, from the picture's upper left corner.
struct PictureBox {
  float left = 1e30f, top = 1e30f, right = -1e30f, bottom = -1e30f;
  std::int32_t route = 0;  ///< see SubpixelLight
  float throughput = 0;    ///< fraction of radiance from the light's middle that the surfaces send this way

  void include(Pair<float> at) {
    left = std::min(left, at.x), right = std::max(right, at.x);
    top = std::min(top, at.y), bottom = std::max(bottom, at.y);
  }
  bool empty() const { return right < left; }
};

/// Where a direction from the camera meets the picture, in pixels. Returns false for a direction behind the camera.
inline bool project(const CameraColumns& c, Vec3f direction, Pair<float>& at) {
  const Vec3f normal = cross(c.du, c.dv);
  const float scale = dot(c.corner, normal) / dot(direction, normal);
  if (!(scale > 0)) return false;
  const Vec3f place = scale * direction - c.corner;
  at = {dot(place, c.du) / dot(c.du, c.du), dot(place, c.dv) / dot(c.dv, c.dv)};
  return true;
}

}  // namespace tyndall
