#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// White furnaces: in a white room things that absorb nothing are invisible, and things that absorb a fifth of the
/// light have a radiance of 0.8. This holds exactly and in every sample.
namespace tyndall::test::furnace_test {

namespace {

/// A sphere of radius `scale` at the origin fills a good part of the picture.
Scene sphere_room(double scale) {
  Scene scene = white_room();
  scene.width = scene.height = 64;
  scene.camera = {.look_from = {0.3 * scale, 0.4 * scale, 5 * scale}, .look_at = {0, 0, 0}, .vfov = 25};
  scene.render.max_depth = 1000000;
  return scene;
}

/// Samples of a picture are 1 beside the sphere and `expected` on it, and a good part are on it.
void check_all(const Scene& scene, float expected, const std::string& isa) {
  const Film film = film_of(scene, 1, isa);
  CHECK(totals(film).rejected == 0);
  CHECK(totals(film).truncated == 0);
  int on = 0;
  for (const FilmPixel& pixel : film.pixels) {
    const Vec3f value = mean(film, pixel);
    REQUIRE((value.x == expected || value.x == 1.0f));
    REQUIRE(value.y == value.x);
    on += value.x == expected ? 1 : 0;
  }
  CHECK(on > static_cast<int>(film.pixels.size()) / 2);
}

void check_sphere(const Material& material, double radius, float expected) {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const char* isa : {"", "scalar"}) {
      CAPTURE(scale);
      CAPTURE(isa);
      Scene scene = sphere_room(scale);
      add(scene, sphere({0, 0, 0}, radius * scale), material);
      check_all(scene, expected, isa);
    }
}

}  // namespace

TEST_CASE("white furnace: lambertian and mirror balls reflect their albedo") {
  for (const double radius : {1.0, -1.0}) {
    check_sphere(lambertian(0.8), radius, 0.8f);
    check_sphere(metal(0.8, 0), radius, 0.8f);
  }
}

TEST_CASE("white furnace: glass of any index is invisible") {
  for (const double radius : {1.0, -1.0})
    for (const double index : {1.0, 1.000001, 1.5, 2.417, 1 / 1.5, 100.0}) {
      CAPTURE(index);
      check_sphere(glass(index), radius, 1.0f);
    }
}

TEST_CASE("white furnace: hollow glass is invisible, by negative radius and by relative index") {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const double thickness : {0.1, 1e-3, 1e-6}) {
      CAPTURE(scale);
      CAPTURE(thickness);
      Scene bubble = sphere_room(scale), relative = sphere_room(scale);
      add(bubble, sphere({0, 0, 0}, scale), glass(1.5));
      add(bubble, sphere({0, 0, 0}, -(1 - thickness) * scale), glass(1.5));
      check_all(bubble, 1.0f, "");
      add(relative, sphere({0, 0, 0}, scale), glass(1.5));
      add(relative, sphere({0, 0, 0}, (1 - thickness) * scale), glass(1 / 1.5));
      check_all(relative, 1.0f, "");
    }
}

TEST_CASE("white furnace: boxes and quads of glass, also turned, far away and touching") {
  Scene scene = sphere_room(1);
  add(scene, Box<>{{-1, -1, -1}, {1, 0, 1}}, glass(1.5));
  add(scene, Box<>{{-1, 0, -1}, {1, 1, 1}}, glass(1.7));  // shares a face
  check_all(scene, 1.0f, "");
  Scene rotated = sphere_room(1);
  rotated.camera.look_from = rotated.camera.look_from + Vec3d{1e6, 0, -1e6};
  rotated.camera.look_at = Vec3d{1e6, 0, -1e6};
  add(rotated, Box<>{{-1, -1, -1}, {1, 1, 1}}, glass(2), {RotateY{37}, Translate{{1e6, 0, -1e6}}});
  add(rotated, Quad<>{{-2, -2, 2}, {4, 0, 0}, {0, 4, 0}}, glass(1.5), {RotateY{10}, Translate{{1e6, 0, -1e6}}});
  check_all(rotated, 1.0f, "");
}

TEST_CASE("white furnace: of surfaces in one place the first is seen, and does not shade itself with the others") {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const char* isa : {"", "scalar"}) {
      CAPTURE(scale);
      CAPTURE(isa);
      const auto check = [&](const auto& shape, const Transform& transform) {
        Scene scene = sphere_room(scale);
        for (const double albedo : {0.8, 0.3, 0.5}) add(scene, shape, lambertian(albedo), transform);
        check_all(scene, 0.8f, isa);
      };
      const double s = scale;
      check(sphere({0, 0, 0}, s), {});
      check(Box<>{{-s, -s, -s}, {s, s, s}}, {RotateY{33}});
      check(Quad<>{{-s, -s, -0.2 * s}, {2 * s, 0, 0.3 * s}, {0.1 * s, 2 * s, 0}}, {RotateY{10}, Translate{{0, 0, s}}});
    }
}

TEST_CASE("white furnace: a medium that only scatters is invisible at any density") {
  for (const double scale : {1e-3, 1.0, 1e3})
    for (const double density : {0.01, 1.0, 10.0, 100.0})
      for (const double g : {0.0, 0.8, -0.5}) {
        CAPTURE(scale);
        CAPTURE(density);
        CAPTURE(g);
        Scene fog = sphere_room(scale);
        fog.width = fog.height = 32;
        add_medium(fog, sphere({0, 0, 0}, scale), {density / scale, g}, 1);
        check_all(fog, 1.0f, "");
      }
  Scene scalar = sphere_room(1);
  add_medium(scalar, sphere({0, 0, 0}, 1), {5, 0.3}, 1);
  check_all(scalar, 1.0f, "scalar");
}

TEST_CASE("white furnace: milk in glass, in balls and boxes") {
  for (const double index : {1.0, 1.5, 1 / 1.5})
    for (const double density : {0.1, 3.0, 30.0}) {
      CAPTURE(index);
      CAPTURE(density);
      Scene ball = sphere_room(1), box = sphere_room(1);
      add(ball, sphere({0, 0, 0}, 1), glass(index));
      add_medium(ball, sphere({0, 0, 0}, 1), {density, 0.2}, 1);
      check_all(ball, 1.0f, "");
      const Transform transform{RotateY{25}, Translate{{0.1, 0, 0}}};
      add(box, Box<>{{-1, -1, -1}, {1, 1, 1}}, glass(index), transform);
      add_medium(box, Box<>{{-1, -1, -1}, {1, 1, 1}}, {density, 0}, 1, transform);
      check_all(box, 1.0f, "");
    }
}

TEST_CASE("white furnace: the camera inside glass, fog and milk") {
  for (const bool shell : {false, true})
    for (const bool fog : {false, true}) {
      Scene scene = sphere_room(1);
      scene.camera = {.look_from = {0.2, -0.3, 0.1}, .look_at = {0, 5, 0.3}, .vfov = 25};
      if (shell) add(scene, sphere({0, 0, 0}, 1), glass(1.5));
      if (fog) add_medium(scene, sphere({0, 0, 0}, 1), {4, 0}, 1);
      check_all(scene, 1.0f, "");
    }
}

TEST_CASE("light: seen directly, through glass of index 1 and from inside it shows its radiance") {
  for (const double radius : {1.0, -1.0}) {
    Scene scene = dark_room();
    add(scene, sphere({0, 0, 0}, radius), lamp(3.5));
    aim(scene, {0, 0, 5}, {0.3, 0.2, 0});
    CHECK(common_value(scene) == 3.5);
    aim(scene, {0, 0.2, 0.1}, {0, 0, 5});
    CHECK(common_value(scene) == 3.5);
    add(scene, sphere({0, 0, 0}, 2), glass(1));
    aim(scene, {0, 0, 5}, {0.3, 0.2, 0});
    CHECK(common_value(scene) == 3.5);
  }
}

}  // namespace tyndall::test::furnace_test
