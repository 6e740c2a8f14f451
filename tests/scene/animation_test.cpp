#include "core/scene/settings.h"

#include "core/scene/frames.h"
#include "core/scene/load.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace tyndall::test::animation_test {
namespace {

/// A scene with these members of "animation", and more at its end.
Scene scene_with(const std::string& animation, const std::string& more = "") {
  return load_scene_text(R"({ "tyndall": 1, "camera": { "look_from": [0, 0, 5], "look_at": [0, 0, 0]} ,
    "materials": { "gold": { "type": "metal", "albedo": [1, 1, 1], "fuzz": 0.1 } },
    "objects": [{ "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold" }],
    "animation": { "frames": 100, )" +
                             animation + "}" + more + "}",
                         "film.json", ".")
      .scene;
}

std::string problem_of(const std::string& animation) {
  try {
    scene_with(animation);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("animation: a linear curve goes evenly from key to key and stands still outside of them") {
  const KeyedValue keyed{"/camera/vfov", {{10, {40}}, {20, {60}}, {40, {20}}}};
  for (const auto& [time, value] : {std::pair{0.0, 40.0}, {10, 40}, {15, 50}, {20, 60}, {30, 40}, {40, 20}, {99, 20}})
    CHECK(value_at(keyed, Curve::linear, time)[0] == doctest::Approx(value));
}

TEST_CASE("animation: a smooth curve meets the keys, never goes beyond them, and rests at both ends") {
  const KeyedValue keyed{"/camera/vfov", {{0, {0}}, {10, {1}}, {30, {1.2}}, {40, {5}}, {50, {2}}}};
  for (const KeyFrame& key : keyed.keys) CHECK(value_at(keyed, Curve::smooth, key.frame)[0] == key.value[0]);
  for (std::size_t k = 0; k + 1 < keyed.keys.size(); ++k) {
    const KeyFrame &a = keyed.keys[k], &b = keyed.keys[k + 1];
    double before = a.value[0];
    for (double t = a.frame; t <= b.frame; t += 0.125) {
      const double value = value_at(keyed, Curve::smooth, t)[0];
      CHECK((b.value[0] > a.value[0] ? value >= before : value <= before));
      before = value;
    }
  }
  const auto slope = [&](double t) {
    return (value_at(keyed, Curve::smooth, t + 1e-4)[0] - value_at(keyed, Curve::smooth, t - 1e-4)[0]) / 2e-4;
  };
  CHECK(slope(10 - 1e-3) == doctest::Approx(slope(10 + 1e-3)).epsilon(0.01).scale(0));  // no jerk at a key
  CHECK(slope(10) ==
        doctest::Approx(90 / (50 / 0.1 + 40 / 0.01)).epsilon(0.01).scale(0));  // the nearer key counts more
  CHECK(std::abs(slope(1e-3)) < 1e-3);
}

TEST_CASE("animation: a frame has the values of its keys, and no keys") {
  const Scene scene = scene_with(R"("curve": "linear", "keys": { "/materials/gold/fuzz": { "0": 0, "50": 1 },
      "/camera/look_from": { "0": [0, 0, 5], "50": [5, 0, 5] }, "/render/max_depth": { "0": 1, "3": 3 } })");
  const Scene frame = scene_at(scene, 25);
  CHECK(std::get<Metal<>>(frame.materials[0].kind).fuzz == 0.5);
  CHECK(frame.camera.look_from == Vec3d{2.5, 0, 5});
  CHECK(scene_at(scene, 1).render.max_depth == 2);
  CHECK_FALSE(frame.animation);
  CHECK(scene.animation->keyed.size() == 3);
  CHECK(read_scene(write_scene(scene), "again", ".") == scene);
}

TEST_CASE("animation: an orbit keeps its distance from look_at and goes the shorter way") {
  const std::string keys =
      R"("curve": "linear", "keys": { "/camera/look_from": { "0": [0, 0, 5], "10": [5, 0, 0], "20": [0, 3, -5] } })";
  const Scene straight = scene_with(keys), orbit = scene_with(R"("orbit": true, )" + keys);
  CHECK(length(scene_at(straight, 5).camera.look_from) == doctest::Approx(5 / std::sqrt(2)));
  CHECK(length(scene_at(orbit, 5).camera.look_from) == doctest::Approx(5));
  CHECK(scene_at(orbit, 5).camera.look_from.x == doctest::Approx(5 / std::sqrt(2)));
  CHECK(scene_at(orbit, 10).camera.look_from == Vec3d{5, 0, 0});
  CHECK(scene_at(orbit, 20).camera.look_from == Vec3d{0, 3, -5});
  CHECK(scene_at(orbit, 15).camera.look_from.x > 3);
}

TEST_CASE("animation: the turntable goes once around, about vup") {
  Scene scene = scene_with(R"("keys": {})");
  scene.camera.look_from = {3, 2, 0};
  const FramePlan plan{.frames = 8, .turntable = true};
  CHECK(frame_scene(scene, plan, 0).camera == scene.camera);
  const Vec3d quarter = frame_scene(scene, plan, 2).camera.look_from,
              half = frame_scene(scene, plan, 4).camera.look_from;
  CHECK(std::abs(quarter.z) == doctest::Approx(3));
  CHECK(half.x == doctest::Approx(-3));
  for (int n = 0; n < 8; ++n) CHECK(frame_scene(scene, plan, n).camera.look_from.y == doctest::Approx(2));
}

TEST_CASE("animation: the seed of frame n is the scene's and n, unless one seed is asked for") {
  Scene scene = scene_with(R"("keys": {})");
  scene.render.seed = 7;
  CHECK(frame_scene(scene, {.frames = 10}, 3).render.seed == 10);
  CHECK(frame_scene(scene, {.frames = 10, .seed_per_frame = false}, 3).render.seed == 7);
  scene.render.seed = 4294967294u;
  CHECK_THROWS_AS(frame_scene(scene, {.frames = 10}, 3), ParseError);
}

TEST_CASE("animation: with a shutter a sphere moves from its place in this frame to that in the next one") {
  const char* keys = R"("curve": "linear", "keys": { "/objects/0/center": { "0": [0, 0, 0], "10": [10, 0, 0] } })";
  Scene scene = scene_with(keys);
  const auto sphere = [](const Scene& s) { return std::get<Sphere<>>(std::get<Solid3d>(s.objects[0].kind).shape); };
  CHECK_FALSE(sphere(scene_at(scene, 4)).center_end);
  scene.camera.shutter_close = 0.5;
  CHECK(sphere(scene_at(scene, 4)).center == Vec3d{4, 0, 0});
  CHECK(sphere(scene_at(scene, 4)).center_end == Vec3d{5, 0, 0});
  CHECK_FALSE(sphere(scene_at(scene, 10)).center_end);  // it stands still
}

TEST_CASE("animation: what is wrong with keys is told with its place") {
  const auto told = [](const std::string& animation, const std::vector<std::string>& texts) {
    const std::string problem = problem_of(animation);
    for (const std::string& text : texts) CHECK_MESSAGE(problem.find(text) != problem.npos, problem, " lacks ", text);
  };
  const std::string gold = "/animation/keys/~1materials~1gold~1fuzz";
  told(R"("keys": { "/materials/gold/fuzz": { "0": 0, "7": 1.5 } })", {gold + "/7", "1.5"});
  told(R"("keys": { "/materials/gild/fuzz": { "0": 0 } })", {"~1materials~1gild~1fuzz", "gold"});
  told(R"("keys": { "/materials/gold/fuz": { "0": 0 } })", {"fuzz"});
  told(R"("keys": { "/camera/vfov": { "100": 40 } })", {"~1camera~1vfov/100", "0 to 99"});
  told(R"("keys": { "/camera/vfov": { "-1": 40 } })", {"\"-1\"", "frame"});
  told(R"("keys": { "/camera/vfov": { "01": 40 } })", {"\"01\""});
  told(R"("keys": { "/camera/vfov": { "1": "wide" } })", {"~1camera~1vfov/1", "wide"});
  told(R"("keys": { "/camera/vfov": { "1": [1, 2, 3] } })", {"~1camera~1vfov/1", "array of 3"});
  told(R"("keys": { "/camera/look_from": { "1": [1, 2, 3], "2": 5 } })", {"~1camera~1look_from/2"});
  told(R"("keys": { "/camera/vfov": {} })", {"~1camera~1vfov", "no keys"});
  told(R"("keys": { "camera": { "0": 1 } })", {"JSON pointer"});
  told(R"("keys": { "/image/width": { "0": 100 } })", {"/image/width"});
  told(R"("speed": 3)", {"speed"});
  told(R"("curve": "smoth")", {"smooth"});
  told(R"("keys": { "/camera/look_at": { "0": [0, 0, 5] } })", {"look_at/0", "the same point"});
}

TEST_CASE("animation: keys are set in the order of frames, and found again") {
  Animation animation;
  set_key(animation, "/camera/vfov", {20, {2}});
  set_key(animation, "/camera/vfov", {10, {1}});
  set_key(animation, "/camera/vfov", {20, {3}});
  REQUIRE(find_keys(animation, "/camera/vfov"));
  CHECK(*find_keys(animation, "/camera/vfov") == KeyedValue{"/camera/vfov", {{10, {1}}, {20, {3}}}});
  CHECK_FALSE(find_keys(animation, "/camera/vup"));
}

TEST_CASE("override: another type of a material keeps its colour and leaves out what the type has not") {
  const std::string text = R"({ "tyndall": 1, "materials": {
    "gold": { "type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3 }, "glass": { "type": "dielectric", "refractive_index": 1.5 } } })";
  const auto material = [&](const char* type, std::size_t k) {
    return read_scene(text, "s", ".", {{k == 0 ? "/materials/gold/type" : "/materials/glass/type", type}}).materials[k];
  };
  CHECK(std::holds_alternative<Lambertian<>>(material("lambertian", 0).kind));
  CHECK(std::get<Vec3d>(material("lambertian", 0).colour) == Vec3d{0.8, 0.6, 0.2});
  CHECK(std::get<Vec3d>(material("light", 0).colour) == Vec3d{0.8, 0.6, 0.2});
  CHECK(std::holds_alternative<Dielectric<>>(material("dielectric", 0).kind));
  CHECK(std::holds_alternative<Metal<>>(material("metal", 1).kind));
  CHECK(std::get<Metal<>>(material("metal", 0).kind).fuzz == 0.3);
  CHECK_THROWS_AS(material("plastic", 0), SceneError);
}

}  // namespace tyndall::test::animation_test
