#include "app/window/tools/projection.h"

#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <cmath>

namespace tyndall {

Projection::Projection(const Scene& scene)
    : camera_(scene.camera),
      height_(2 * std::tan(scene.camera.vfov * (pi / 360))),
      width_(height_ * scene.width / scene.height),
      near_(1e-3 * target_distance(scene.camera)) {}

ImagePoint Projection::seen(Vec3d p) const { return {0.5 + p.x / (p.z * width_), 0.5 - p.y / (p.z * height_)}; }

std::optional<ImagePoint> Projection::point(Vec3d p) const {
  const Vec3d in_frame = in_camera_frame(camera_, p);
  if (in_frame.z < near_) return {};
  return seen(in_frame);
}

std::optional<ImageLine> Projection::line(Vec3d from, Vec3d to) const {
  Vec3d a = in_camera_frame(camera_, from), b = in_camera_frame(camera_, to);
  if (a.z < near_ && b.z < near_) return {};
  const auto cut = [&](Vec3d behind, Vec3d ahead) {
    return behind + ((near_ - behind.z) / (ahead.z - behind.z)) * (ahead - behind);
  };
  if (a.z < near_) a = cut(a, b);
  if (b.z < near_) b = cut(b, a);
  return ImageLine{seen(a), seen(b)};
}

ViewRay Projection::view_ray(ImagePoint at) const {
  const CameraAxes axes = axes_of(camera_);
  const double x = (at.x - 0.5) * width_, y = (0.5 - at.y) * height_;
  return {camera_.look_from, normalize(x * axes.right + y * axes.up + axes.forward)};
}

double Projection::depth_of(Vec3d p) const { return in_camera_frame(camera_, p).z; }

}  // namespace tyndall
