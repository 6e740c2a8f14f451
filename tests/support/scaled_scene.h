#pragma once
#include "core/scene/scene.h"

/// The same scene in other units, and elsewhere.
namespace tyndall::test {

/// Multiplies every length of a scene by `scale`; densities, which count per length, are divided by it.
class Scaled {
 public:
  Scaled(Scene scene, double scale) : scene_(std::move(scene)), scale_(scale) {
    Camera& camera = scene_.camera;
    grow(camera.look_from), grow(camera.look_at);
    if (camera.focus_distance) *camera.focus_distance *= scale;
    for (Texture& texture : scene_.textures) {
      if (auto* checker = std::get_if<Checker<>>(&texture.kind)) checker->scale *= scale;
      if (auto* noise = std::get_if<Noise<>>(&texture.kind)) noise->scale /= scale;
    }
    grow(scene_.objects);
  }
  const Scene& scene() const { return scene_; }

 private:
  void grow(Vec3d& v) const { v = scale_ * v; }
  void grow(Sphere<>& s) const {
    grow(s.center);
    if (s.center_end) grow(*s.center_end);
    s.radius *= scale_;
  }
  void grow(Quad<>& q) const { grow(q.corner), grow(q.u), grow(q.v); }
  void grow(Triangle<>& t) const { grow(t.corner), grow(t.u), grow(t.v); }
  void grow(Disk<>& d) const { grow(d.center), grow(d.u), grow(d.v); }
  void grow(Box<>& b) const { grow(b.min), grow(b.max); }
  void grow(Transform& transform) const {
    for (auto& part : transform)
      if (auto* shift = std::get_if<Translate>(&part)) grow(shift->offset);
  }
  void grow(std::vector<Object>& objects) const {
    for (Object& object : objects) {
      grow(object.transform);
      if (auto* group = std::get_if<Group>(&object.kind)) grow(group->objects);
      if (auto* solid = std::get_if<Solid3d>(&object.kind)) std::visit([&](auto& shape) { grow(shape); }, solid->shape);
      if (auto* volume = std::get_if<Volume>(&object.kind)) {
        std::visit([&](auto& shape) { grow(shape); }, volume->boundary);
        grow(volume->boundary_transform);
        volume->medium.density /= scale_;
      }
    }
  }

  Scene scene_;
  double scale_;
};

inline Scene scaled(const Scene& scene, double scale) { return Scaled(scene, scale).scene(); }

/// Everything shifted by `direction`; textures in space stay where they are.
inline Scene moved(Scene scene, Vec3d direction) {
  scene.camera.look_from = scene.camera.look_from + direction;
  scene.camera.look_at = scene.camera.look_at + direction;
  scene.objects = {{"", Group{scene.objects}, {Translate{direction}}}};
  return scene;
}

}  // namespace tyndall::test
