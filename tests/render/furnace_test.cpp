#include "tests/support/probe.h"

#include <doctest/doctest.h>

#include <functional>

/// White furnaces: in a white room things that absorb nothing are invisible, and things that absorb a fifth of the
/// light have a radiance of 0.8. This holds exactly and in every sample.
namespace tyndall::test::furnace_test {

namespace {

/// What is put into a room where all lengths are `scale` times as long.
using Things = std::function<void(Scene&, double scale)>;

/// Samples of a picture are 1 beside the things and `expected` on them, and a good part are on them.
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

/// A sphere of radius `scale` at the origin would fill a good part of the picture.
Scene sphere_room(double scale) {
  Scene scene = white_room();
  scene.camera = {.look_from = {0.3 * scale, 0.4 * scale, 5 * scale}, .look_at = {0, 0, 0}, .vfov = 25};
  scene.render.max_depth = 1000000;
  return scene;
}

void check(const std::string& name, float expected, const Things& add_things,
           const std::vector<double>& scales = {1e-3, 1.0, 1e3}) {
  for (const double scale : scales)
    for (const char* isa : {"", "scalar"}) {
      CAPTURE(name);
      CAPTURE(scale);
      CAPTURE(isa);
      Scene scene = sphere_room(scale);
      add_things(scene, scale);
      check_all(scene, expected, isa);
    }
}

Things ball(const Material& material, double radius = 1) {
  return [=](Scene& s, double scale) { add(s, sphere({0, 0, 0}, radius * scale), material); };
}
Things both(const Things& a, const Things& b) {
  return [=](Scene& s, double scale) { a(s, scale), b(s, scale); };
}
Things fog(double density, double g) {
  return [=](Scene& s, double scale) { add_medium(s, sphere({0, 0, 0}, scale), {density / scale, g}, 1); };
}
/// Three shapes in one place, of which the first is seen.
Things copies(const auto& shape_of, const Transform& transform = {}) {
  return [=](Scene& s, double scale) {
    Transform placed = transform;
    for (auto& part : placed)
      if (auto* shift = std::get_if<Translate>(&part)) shift->offset = scale * shift->offset;
    for (const double albedo : {0.8, 0.3, 0.5}) add(s, shape_of(scale), lambertian(albedo), placed);
  };
}

}  // namespace

TEST_CASE("white furnace: balls reflect their albedo; glass of any index is invisible, also hollow") {
  for (const double radius : {1.0, -1.0}) {
    check("lambertian", 0.8f, ball(lambertian(0.8), radius));
    check("mirror", 0.8f, ball(metal(0.8, 0), radius));
    for (const double index : {1.0, 1.000001, 1.5, 2.417, 1 / 1.5, 100.0}) {
      CAPTURE(index);
      check("glass", 1, ball(glass(index), radius));
    }
  }
  for (const double thickness : {0.1, 1e-3, 1e-6}) {
    CAPTURE(thickness);
    check("hollow, by negative radius", 1, both(ball(glass(1.5)), ball(glass(1.5), thickness - 1)));
    check("hollow, by relative index", 1, both(ball(glass(1.5)), ball(glass(1 / 1.5), 1 - thickness)));
  }
}

TEST_CASE("white furnace: boxes and quads of glass, also turned, far away and touching") {
  const Things sharing_a_face = [](Scene& s, double a) {
    add(s, Box<>{{-a, -a, -a}, {a, 0, a}}, glass(1.5));
    add(s, Box<>{{-a, 0, -a}, {a, a, a}}, glass(1.7));
  };
  check("boxes that share a face", 1, sharing_a_face, {1.0});
  const Things far_away = [](Scene& s, double a) {
    const Vec3d away = 1e6 * a * Vec3d{1, 0, -1};
    s.camera.look_from = s.camera.look_from + away, s.camera.look_at = away;
    add(s, Box<>{{-a, -a, -a}, {a, a, a}}, glass(2), {RotateY{37}, Translate{away}});
    add(s, Quad<>{{-2 * a, -2 * a, 2 * a}, {4 * a, 0, 0}, {0, 4 * a, 0}}, glass(1.5), {RotateY{10}, Translate{away}});
  };
  check("far away", 1, far_away, {1.0});
}

TEST_CASE("white furnace: of surfaces in one place the first is seen, and does not shade itself with the others") {
  check("balls", 0.8f, copies([](double s) { return sphere({0, 0, 0}, s); }));
  check("boxes", 0.8f, copies([](double s) { return Box<>{{-s, -s, -s}, {s, s, s}}; }, {RotateY{33}}));
  check("quads", 0.8f,
        copies(
            [](double s) {
              return Quad<>{{-s, -s, -0.2 * s}, {2 * s, 0, 0.3 * s}, {0.1 * s, 2 * s, 0}};
            },
            {RotateY{10}, Translate{{0, 0, 1}}}));
}

TEST_CASE("white furnace: flats, and faces of boxes, that lie in one plane do not shade each other") {
  for (const Transform& transform : {Transform{}, Transform{RotateY{33}}}) {
    check("boxes that overlap, with a quad on a face and a triangle on another", 0.8f, [=](Scene& s, double a) {
      add(s, Box<>{{-a, -a, -a}, {0.3 * a, a, a}}, lambertian(0.8), transform);
      add(s, Box<>{{-0.3 * a, -a, -a}, {a, a, a}}, lambertian(0.8), transform);
      add(s, Quad<>{{0.7 * a, 0.7 * a, a}, {-1.5 * a, 0.1 * a, 0}, {0.2 * a, -1.3 * a, 0}}, lambertian(0.8), transform);
      add(s, Triangle<>{{-a, a, -a}, {1.5 * a, 0, 0.2 * a}, {0, 0, 1.5 * a}}, lambertian(0.8), transform);
    });
    check("quads and a disk", 0.8f, [=](Scene& s, double a) {
      add(s, Quad<>{{-a, -a, 0.1 * a}, {2 * a, 0, 0}, {0, 2 * a, 0}}, lambertian(0.8), transform);
      add(s, Quad<>{{a, a, 0.1 * a}, {-1.7 * a, 0.2 * a, 0}, {-0.1 * a, -1.8 * a, 0}}, lambertian(0.8), transform);
      add(s, Disk<>{{0, 0, 0.1 * a}, {0.8 * a, 0, 0}, {0, 0.8 * a, 0}}, lambertian(0.8), transform);
    });
  }
}

TEST_CASE("glass that stands on a grey block is seen as if it were a hair above") {
  const auto picture = [](double gap) {
    Scene scene = sphere_room(1);
    scene.camera.look_from = {0.5, 4, 3};
    add(scene, Box<>{{-1, 0, -1}, {1, 0.5, 1}}, glass(1.5), {RotateY{20}});
    add(scene, Box<>{{-5, -1 - gap, -5}, {5, -gap, 5}}, lambertian(0.3), {RotateY{20}});
    return picture_mean(film_of(scene, 256));
  };
  const Estimate standing = picture(0), above = picture(1e-5);
  CHECK(std::abs(standing.mean - above.mean) < 4 * std::hypot(standing.error, above.error));
  CHECK(standing.error < 0.002 * standing.mean);
}

TEST_CASE("white furnace: media that only scatter are invisible at any density, also as milk in balls and boxes") {
  for (const double density : {0.01, 1.0, 10.0, 100.0})
    for (const double g : {0.0, 0.8, -0.5}) {
      CAPTURE(density);
      CAPTURE(g);
      check("fog", 1, fog(density, g));
    }
  for (const double index : {1.0, 1.5, 1 / 1.5})
    for (const double density : {0.1, 3.0, 30.0}) {
      CAPTURE(index);
      CAPTURE(density);
      check("milk", 1, both(ball(glass(index)), fog(density, 0.2)));
      check("box of milk", 1, [&](Scene& s, double a) {
        const Transform transform{RotateY{25}, Translate{{0.1 * a, 0, 0}}};
        const Box<> box{{-a, -a, -a}, {a, a, a}};
        add(s, box, glass(index), transform);
        add_medium(s, box, {density / a, 0}, 1, transform);
      });
    }
}

TEST_CASE("white furnace: the camera inside glass, fog and milk") {
  const auto inside = [](Scene& s, double a) {
    s.camera = {.look_from = a * Vec3d{0.2, -0.3, 0.1}, .look_at = a * Vec3d{0, 5, 0.3}, .vfov = 25};
  };
  check("nothing", 1, inside);
  check("glass", 1, both(inside, ball(glass(1.5))));
  check("fog", 1, both(inside, fog(4, 0)));
  check("milk", 1, both(inside, both(ball(glass(1.5)), fog(4, 0))));
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
