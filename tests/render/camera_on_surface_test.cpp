#include "core/base/math.h"
#include "core/compile/flatten.h"
#include "tests/support/mixed_scene.h"
#include "tests/support/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

/// A camera that stands on a surface, at any scale: it never meets the place on which it stands.
namespace tyndall::test::camera_on_surface_test {

namespace {

/// How an object of the size `scale` is placed, and the point of its surface where the camera stands.
struct Place {
  Object object;
  Vec3d point, normal;
};

Transform rotated(Engine& engine, Vec3d to) { return {RotateY{uniform(engine, -180, 180)}, Translate{to}}; }

Place placed(const Object& object, Vec3d point, Vec3d normal) {
  const Placement p = placement_of(object.transform);
  return {object, place(p, point), rotate(p, normal)};
}

Place on_sphere(Engine& engine, double scale, double sign) {
  const Vec3d normal = direction(engine), center = in_cube(engine, 3 * scale);
  return placed({"", Solid3d{Sphere<>{center, sign * scale, {}}, 0}, rotated(engine, in_cube(engine, scale))},
                center + scale * normal, normal);
}
Place on_quad(Engine& engine, double scale) {
  const Vec3d corner = in_cube(engine, 3 * scale), u = scale * direction(engine), v = scale * direction(engine);
  return placed({"", Solid3d{Quad<>{corner, u, v}, 0}, rotated(engine, in_cube(engine, scale))},
                corner + uniform(engine, 0.2, 0.8) * u + uniform(engine, 0.2, 0.8) * v, normalize(cross(u, v)));
}
Place on_box(Engine& engine, double scale) {
  const Vec3d low = in_cube(engine, 3 * scale), high = low + scale * Vec3d{1, uniform(engine, 0.1, 2), 0.5};
  return placed({"", Solid3d{Box<>{low, high}, 0}, rotated(engine, in_cube(engine, scale))},
                {high.x, 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)}, {1, 0, 0});
}

/// The object alone under a white sky, and a camera `height` above the point that looks along `axis`. The picture sees
/// directions up to 79 degrees from the axis.
Scene scene_at(const Place& at, double height, Vec3d axis, Material material) {
  Scene scene;
  scene.width = scene.height = 24;
  scene.render.max_depth = 4;
  scene.background = Vec3d{1, 1, 1};
  material.name = "m";
  scene.materials = {std::move(material)};
  scene.objects = {at.object};
  scene.camera.look_from = at.point + height * at.normal;
  scene.camera.look_at = scene.camera.look_from + axis;
  scene.camera.vup = std::abs(axis.y) < 0.9 * length(axis) ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  scene.camera.vfov = 150;
  return scene;
}

const Material black{"", Vec3d{0, 0, 0}, Lambertian<>{}};

/// Number of values of a picture, of 8 samples a pixel, that are not `expected`, with every instruction set.
int wrong_values(const Scene& scene, float expected) {
  const RenderScene compiled = compile(scene);
  int wrong = 0;
  for (const Kernels& kernels : available_kernels()) {
    const std::vector<float> picture = resolve(render(compiled, {.threads = 1, .isa = kernels.isa, .spp = 8}).film);
    wrong += static_cast<int>(
        std::count_if(picture.begin(), picture.end(), [=](float x) { return std::abs(x - expected) > 1e-5f; }));
  }
  return wrong;
}

FirstHit middle_of(const Scene& scene) {
  FirstHit middle;
  scalar_kernels().first_hits(SceneViewOf(compile(scene)).view(), {12, 12, 13, 13}, &middle);
  return middle;
}

constexpr double scales[] = {1e-4, 0.5, 1, 1000, 1e6};

}  // namespace

TEST_CASE("camera on a surface: whoever stands on a ball, quad or box and looks up sees nothing of it") {
  Engine engine(1);
  for (const double scale : scales)
    for (int round = 0; round < 4; ++round) {
      CAPTURE(scale);
      const double heights[] = {0, 1e-9 * scale, 5e-8 * scale, 1e-5};
      const double height = heights[round] > 1e-2 * scale ? 1e-3 * scale : heights[round];
      for (const double sign : {1.0, -1.0}) {
        const Place at = on_sphere(engine, scale, sign);
        CHECK(wrong_values(scene_at(at, height, scale * at.normal, black), 1) == 0);
        CHECK(wrong_values(scene_at(at, -std::min(height, 5e-8 * scale), scale * at.normal, black), 1) == 0);
      }
      for (const Place& at : {on_quad(engine, scale), on_box(engine, scale)})
        CHECK(wrong_values(scene_at(at, height, scale * at.normal, black), 1) == 0);
    }
}

TEST_CASE("camera on a surface: closer to a wide lamp than single precision tells, it is seen from both sides") {
  Scene scene = scene_at({{"", Solid3d{Quad<>{{-1e4, 0, -1e4}, {0, 0, 2e4}, {2e4, 0, 0}}, 0}, {}}, {}, {0, 1, 0}}, 2e-4,
                         {0, -1, 0}, {"", Vec3d{3, 3, 3}, Light<>{}});
  CHECK(wrong_values(scene, 3) == 0);
  scene.camera.look_from.y = -2e-4, scene.camera.look_at.y = 1;
  CHECK(wrong_values(scene, 3) == 0);
}

TEST_CASE("camera on a surface: with a lens, and far from the middle of the scene") {
  Engine engine(2);
  for (const double scale : scales) {
    CAPTURE(scale);
    for (const Place& at : {on_sphere(engine, scale, 1), on_box(engine, scale)}) {
      Scene scene = scene_at(at, 0, scale * at.normal, black);
      scene.camera.defocus_angle = 0.2;  // all of the lens is above the sphere, most of it within rounding
      CHECK(wrong_values(scene, 1) == 0);
      scene.camera.defocus_angle = 0;
      Place away = at;
      for (int i = 0; i < 3; ++i) {  // the scene's origin moves to the middle of what is in it
        const Vec3d far = at.point - (20 + i) * scale * at.normal;
        scene.objects.push_back({"", Solid3d{Sphere<>{far, 0.1 * scale, {}}, 0}, {}});
      }
      CHECK(wrong_values(scene, 1) == 0);
    }
  }
}

TEST_CASE("camera on a surface: a ball that moves elsewhere while the shutter is closed") {
  Engine engine(3);
  Place at = on_sphere(engine, 1000, 1);
  std::get<Sphere<>>(std::get<Solid3d>(at.object.kind).shape).center_end = Vec3d{9000, 0, 0};
  CHECK(wrong_values(scene_at(at, 0, at.normal, black), 1) == 0);
}

TEST_CASE("camera on a surface: whoever stands on the wall of a room in a ball or box sees all of the room") {
  Engine engine(4);
  const Material lamp{"", Vec3d{2, 2, 2}, Light<>{}};
  for (const double scale : scales) {
    CAPTURE(scale);
    for (const Place& at : {on_sphere(engine, scale, -1), on_box(engine, scale)}) {
      const Scene scene = scene_at(at, 0, -scale * at.normal, lamp);
      CHECK(wrong_values(scene, 2) == 0);
      const FirstHit middle = middle_of(scene);
      CHECK(middle.element >= 0);
      CHECK(static_cast<double>(middle.depth) > 0.1 * scale);
    }
  }
}

TEST_CASE("camera on a surface: a little farther away than rounding, whoever looks down sees what is beneath") {
  Engine engine(5);
  for (const double scale : {0.5, 1000.0})
    for (int round = 0; round < 20; ++round) {
      const Place at = on_sphere(engine, scale, 1);
      const double height = 1e-5 * scale;
      const FirstHit middle = middle_of(scene_at(at, height, -scale * at.normal, black));
      CHECK(static_cast<double>(middle.depth) == doctest::Approx(height).epsilon(0.1));
    }
}

}  // namespace tyndall::test::camera_on_surface_test
