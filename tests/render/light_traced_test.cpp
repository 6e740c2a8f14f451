#include "tests/support/light_comparison.h"
#include "tests/support/probe.h"
#include "tests/support/specular_rooms.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <cmath>

/// The light tracer of the tests, and specular paths held against it.
namespace tyndall::test::light_traced_test {

namespace {

/// Checks that renders and light tracing agree. precision: largest standard error of each, as a fraction of the mean.
void check_agreement(const Scene& scene, int spp, double particles, double precision) {
  LightTracing how;
  how.particles = static_cast<std::uint64_t>(particles);
  const LightTraced traced = trace_light(scene, how);
  const Pictures pictures = rendered(scene, spp, 4);
  const Estimate light = mean_of(traced.batches, traced), found = mean_of(pictures, traced);
  CAPTURE(light.mean);
  CAPTURE(light.error);
  CAPTURE(found.mean);
  CAPTURE(found.error);
  CHECK(std::hypot(light.error, found.error) < precision * light.mean);
  CHECK(std::abs(found.mean - light.mean) < 4 * std::hypot(light.error, found.error));
}

}  // namespace

TEST_CASE("light tracer: what one face of a cube sends to the opposite one, on any number of threads") {
  Scene scene = dark_room();
  scene.width = scene.height = 8;
  scene.camera.look_from = {0.5, 0.5, 0.5};  // straight above the floor, so the mean over pixels is that over the floor
  scene.camera.look_at = {0.5, 0, 0.5};
  scene.camera.vup = {1, 0, 0};
  scene.camera.vfov = 90;
  add(scene, Quad<>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, lambertian(0.8));
  add(scene, Quad<>{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, lamp(3));
  LightTracing how;
  how.threads = 1;
  const LightTraced one = trace_light(scene, how);
  const Estimate found = mean_of(one.batches, one);
  // J. Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11.
  const double factor = 2 / pi * (std::log(2 / std::sqrt(3)) + 2 * std::sqrt(2) * std::atan(1 / std::sqrt(2)) - pi / 2);
  CHECK(std::abs(found.mean - 0.8 * 3 * factor) < 4 * found.error);
  CHECK(found.error < 0.003 * found.mean);
  how.threads = 3;
  CHECK(trace_light(scene, how).batches == one.batches);
}

TEST_CASE("light tracer: what paths from the camera find, off fuzzy metal, through boxes of glass, in fog") {
  Scene scene = dark_room();
  scene.width = 32, scene.height = 24;
  scene.render.integrator = Integrator::mis;
  scene.camera = {.look_from = {0, 2, 7}, .look_at = {0, 1.5, 0}, .vfov = 40};
  add(scene, Box<>{{-3, 0, -3}, {3, 4, 3}}, lambertian(0.5));
  std::get<Solid3d>(scene.objects.back().kind).shape = Quad<>{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}};
  add(scene, Quad<>{{-3, 0, -3}, {6, 0, 0}, {0, 4, 0}}, lambertian(0.5));
  add(scene, sphere({-1.5, 3, 0}, 0.7), lamp(4));
  add(scene, Box<>{{-0.5, 0, -0.5}, {0.5, 1, 0.5}}, glass(1.5), {RotateY{30}, Translate{{0.3, 0.2, 0}}});
  add(scene, sphere({-1.5, 0.7, 0.5}, 0.6), metal(0.9, 0.4));
  add_medium(scene, Box<>{{-2.5, 0.1, -2.9}, {2.5, 3.9, 2.5}}, {0.2, 0.5}, 0.8);
  thorough() ? check_agreement(scene, 1024, 4e6, 0.004) : check_agreement(scene, 256, 1e6, 0.008);
}

TEST_CASE("specular paths: the mean of what light tracing finds") {
  for (const SpecularRoom& room : specular_rooms()) {
    const bool short_enough = room.name == "mirror" || room.name == "shell" || room.name == "bulb" ||
                              room.name == "mirror in fog" || room.name == "flat mirror";
    const bool quick = room.name == "shell" || room.name == "mirror in fog";
    if (thorough() ? !short_enough : !quick) continue;
    CAPTURE(room.name);
    check_agreement(room.scene, room.spp / 4, room.particles / 10, 0.012);
  }
}

}  // namespace tyndall::test::light_traced_test
