#pragma once
#include "core/scene/scene.h"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

/// Parts of small scenes, for tests of what the window does with them.
namespace tyndall::test {

inline Object solid(decltype(Solid3d::shape) shape, Transform transform = {}, int material = 0) {
  return {"", Solid3d{std::move(shape), material}, std::move(transform)};
}
inline Object ball(const std::string& name, Vec3d center, double radius = 1, int material = 0) {
  return {name, Solid3d{Sphere<>{center, radius, {}}, material}, {}};
}
inline Object fog(decltype(Volume::boundary) boundary, Transform transform = {}) {
  return {"", Volume{std::move(boundary), std::move(transform), {}, {}}, {}};
}
/// Of two materials: grey, which is matt, and glass.
inline Scene scene_of(std::vector<Object> objects) {
  Scene scene;
  scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}, {"glass", {}, Dielectric<>{}}};
  scene.objects = std::move(objects);
  return scene;
}
/// The same in a picture of this size, whose camera looks along -z.
inline Scene seen_scene(int width, int height, Vec3d eye, double vfov, std::vector<Object> objects) {
  Scene scene = scene_of(std::move(objects));
  scene.width = width, scene.height = height;
  scene.camera.look_from = eye;
  scene.camera.look_at = {eye.x, eye.y, eye.z - 10};
  scene.camera.vfov = vfov;
  return scene;
}
template <class Shape = Sphere<>>
Shape& shape(Scene& scene, std::size_t k = 0) {
  return std::get<Shape>(std::get<Solid3d>(scene.objects[k].kind).shape);
}
template <class Shape = Sphere<>>
const Shape& shape(const Scene& scene, std::size_t k = 0) {
  return std::get<Shape>(std::get<Solid3d>(scene.objects[k].kind).shape);
}

/// A number that may differ by this fraction of itself.
inline doctest::Approx about(double value, double fraction = 1e-4) {
  return doctest::Approx(value).epsilon(fraction).scale(0);
}

}  // namespace tyndall::test
