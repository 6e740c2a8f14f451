#include "tests/bench/scenes.h"

#include "core/scene/load.h"

#include <cmath>
#include <random>

namespace tyndall::bench {
namespace {

Scene book_scene(const std::string& name, int width, int height) {
  Scene scene = built_in(name, width, height);
  scene.render.max_depth = 50;
  return scene;
}

/// Grey in place of every texture.
Scene without_textures(Scene scene) {
  for (Material& material : scene.materials)
    if (std::holds_alternative<TextureIndex>(material.colour)) material.colour = Vec3d{0.5, 0.5, 0.5};
  return scene;
}

Object sphere(Vec3d center, double radius) {
  Object object;
  object.kind = Solid3d{Sphere<>{center, radius, std::nullopt}, 0};
  return object;
}

/// In [0, 1); the standard distributions differ between libraries.
double uniform(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// Small spheres, one in each cell of a square of edge² cells, as far as they keep clear of the large ones.
std::vector<Object> small_spheres(int edge, std::size_t maximum) {
  std::mt19937 random(7);
  std::vector<Object> spheres;
  for (int i = 0; i < edge; ++i)
    for (int j = 0; j < edge; ++j) {
      const double x = i - edge / 2 + 0.9 * uniform(random), z = j - edge / 2 + 0.9 * uniform(random);
      const bool clear = std::abs(z) > 1.3 || std::abs(x) > 5.3;
      if (clear && spheres.size() < maximum) spheres.push_back(sphere({x, 0.2, z}, 0.2));
    }
  return spheres;
}

}  // namespace

Scene built_in(const std::string& name, int width, int height) {
  Scene scene = load_scene(name).scene;
  scene.width = width;
  scene.height = height;
  return scene;
}

std::vector<NamedScene> book_scenes() {
  return {{"cornell-box", book_scene("cornell-box", 256, 256)},
          {"cornell-smoke", book_scene("cornell-smoke", 256, 256)},
          {"cover", book_scene("cover", 400, 225)},
          {"simple-light", book_scene("simple-light", 400, 225)},
          {"simple-light-grey", without_textures(book_scene("simple-light", 400, 225))},
          {"hollow-glass", book_scene("hollow-glass", 400, 225)}};
}

Scene forty_six_spheres() {
  Scene scene;
  scene.width = 640, scene.height = 360;
  scene.camera = {.look_from = {0, 2, 3}, .look_at = {0, 0, 0}, .vfov = 60, .defocus_angle = 2};
  scene.background = Gradient{{0.15, 0.21, 0.3}, {0.05, 0.07, 0.1}};
  scene.render.max_depth = 10;
  const auto matt = [](double r, double g, double b) { return Material{"", Vec3d{r, g, b}, Lambertian<>{}}; };
  const auto metal = [](double fuzz) { return Material{"", Vec3d{0.8, 0.7, 0.6}, Metal<>{fuzz}}; };
  scene.materials = {matt(0.8, 0.8, 0.8),
                     matt(0.8, 0.4, 0.4),
                     matt(0.4, 0.8, 0.4),
                     matt(0.4, 0.4, 0.8),
                     metal(0),
                     metal(0.2),
                     metal(0.6),
                     Material{"", Vec3d{1, 1, 1}, Dielectric<>{1.5}},
                     Material{"", Vec3d{30, 25, 15}, Light<>{}}};
  scene.objects = {sphere({0, -100.5, -1}, 100)};
  const int light = static_cast<int>(scene.materials.size()) - 1;
  for (int i = 0; i < 45; ++i) {
    scene.objects.push_back(sphere({i % 9 - 4.0, 0, 1.0 - i / 9}, 0.45));
    std::get<Solid3d>(scene.objects.back().kind).material = i == 3 || i == 32 ? light : i % light;
  }
  return scene;
}

Scene field_of_spheres(int count) {
  Scene scene;
  scene.width = 400, scene.height = 225;
  scene.camera = {.look_from = {13, 2, 3}, .look_at = {0, 0, 0}, .vfov = 20};
  scene.background = Gradient{};
  scene.render.max_depth = 50;
  scene.materials = {Material{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  scene.objects = {sphere({0, -1000, 0}, 1000), sphere({0, 1, 0}, 1), sphere({-4, 1, 0}, 1), sphere({4, 1, 0}, 1)};
  const auto small = static_cast<std::size_t>(count) - scene.objects.size();
  std::vector<Object> strewn;
  for (int edge = static_cast<int>(std::sqrt(static_cast<double>(small))); strewn.size() < small; ++edge)
    strewn = small_spheres(edge, small);
  scene.objects.insert(scene.objects.end(), strewn.begin(), strewn.end());
  return scene;
}

Scene floor_beneath_lights(int count) {
  Scene scene;
  scene.width = 160, scene.height = 90;
  scene.camera = {.look_from = {0, 1.1, 9}, .look_at = {0, 0, 7}, .vfov = 50};
  scene.background = Vec3d{0, 0, 0};
  scene.render.max_depth = 3;
  scene.materials = {Material{"floor", Vec3d{0.6, 0.6, 0.6}, Lambertian<>{}}};
  for (int k = 0; k < 4; ++k)
    scene.materials.push_back(Material{"", std::ldexp(1.0, k) * Vec3d{30, 25, 20}, Light<>{}});
  Object floor;
  floor.kind = Solid3d{Quad<>{{-10, 0, -10}, {20, 0, 0}, {0, 0, 20}}, 0};
  scene.objects = {floor};
  std::mt19937 random(7);
  const auto place = [&](double height) {
    const double x = 18 * uniform(random) - 9, z = 18 * uniform(random) - 9;
    return Vec3d{x, height, z};
  };
  for (int i = 0; i < 12; ++i) scene.objects.push_back(sphere(place(0.5), 0.5));
  for (int i = 0; i < count; ++i) {
    const double height = 1.2 + 1.5 * uniform(random), size = 0.5 + uniform(random);
    scene.objects.push_back(sphere(place(height), 0.3 * size / std::sqrt(count)));
    std::get<Solid3d>(scene.objects.back().kind).material = 1 + i % 4;
  }
  return scene;
}

}  // namespace tyndall::bench
