#pragma once
#include "core/scene/scene.h"
#include "tests/support/random_draws.h"

#include <cmath>

/// Random rooms, for statements that must hold for every picture and not only for the built-in scenes.
namespace tyndall::test {

/// A floor with 3 to 9 spheres and boxes of all materials, one to three lights, sometimes walls, a sky or media. A pure
/// function of the seed.
class RandomRoom : RandomDraws {
 public:
  explicit RandomRoom(unsigned seed) : RandomDraws(seed) {}

  Scene scene() {
    scene_.width = 192, scene_.height = 108;
    scene_.camera.look_from = {between(-3, 3), between(1, 4), between(5, 8)};
    scene_.camera.look_at = {between(-0.5, 0.5), between(0.5, 1.2), 0};
    scene_.camera.vfov = between(30, 55);
    const bool walls = chance(0.4);
    if (!walls && chance(0.6)) scene_.background = Gradient{grey(0.05, 1), {between(0, 0.6), 0.5, between(0.2, 1)}};
    add(Quad<>{{-20, 0, -20}, {40, 0, 0}, {0, 0, 40}}, matt());
    if (walls) add(Quad<>{{-8, 0, -4}, {16, 0, 0}, {0, 8, 0}}, matt());
    if (walls) add(Quad<>{{-5, 0, -4}, {0, 0, 9}, {0, 8, 0}}, matt());
    for (int i = 3 + below(7); i > 0; --i) add_thing();
    for (int i = 1 + below(3); i > 0; --i) add_light();
    if (chance(0.3)) add_medium();
    return scene_;
  }

 private:
  Scene scene_;

  Vec3d grey(double low, double high) {
    const double level = between(low, high);
    return {level, level, level};
  }
  Material matt() { return {"", colour(), Lambertian<>{}}; }
  Material any_material() {
    const double kind = between(0, 1);
    if (kind < 0.55) return matt();
    if (kind < 0.8) return {"", colour(), Metal<>{chance(0.3) ? 0 : between(0.02, 1)}};
    return {"", Vec3d{1, 1, 1}, Dielectric<>{between(1.2, 2)}};
  }
  template <class Shape>
  void add(const Shape& shape, Material material) {
    const auto index = static_cast<int>(scene_.materials.size());
    material.name = "m" + std::to_string(index);
    scene_.materials.push_back(std::move(material));
    scene_.objects.push_back({"", Solid3d{shape, index}, {}});
  }
  void add_thing() {
    const double size = between(0.2, 0.9), x = between(-3, 3), z = between(-3, 2);
    if (chance(0.6)) return add(Sphere<>{{x, size, z}, size, {}}, any_material());
    add(Box<>{{x - size, 0, z - size}, {x + size, between(0.3, 2), z + size}}, any_material());
  }
  /// Adds a light; all have about the same power, however small they are.
  void add_light() {
    const double size = std::exp(between(std::log(0.2), std::log(1.0))), radiance = between(1, 6) / (size * size);
    const Vec3d at{between(-3, 3), between(2.5, 5), between(-3, 3)};
    const Material lamp{"", Vec3d{radiance, between(0.6, 1) * radiance, between(0.4, 1) * radiance}, Light<>{}};
    if (chance(0.5)) return add(Sphere<>{at, size, {}}, lamp);
    add(Quad<>{at, {2 * size, 0, 0}, {0, 0, 2 * size}}, lamp);
  }
  void add_medium() {
    Volume fog;
    fog.boundary = Box<>{{-6, 0, -6}, {6, 6, 6}};
    fog.medium = {between(0.01, 0.15), between(-0.5, 0.8)};
    fog.albedo = grey(0.6, 1);
    scene_.objects.push_back({"", fog, {}});
  }
};

}  // namespace tyndall::test
