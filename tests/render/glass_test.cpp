#include "tests/support/probe.h"

#include <doctest/doctest.h>

/// Glass that is the same in another form, or is not there; known answers are cases of "tyndall verify".
namespace tyndall::test::glass_test {

TEST_CASE("hollow glass: by negative radius and by relative index the same picture, bit for bit") {
  Scene bubble = white_room();
  bubble.background = Gradient{};
  bubble.width = 120, bubble.height = 80;
  bubble.camera = {.look_from = {0.5, 0.7, 4}, .look_at = {0, 0, 0}, .vfov = 35};
  add(bubble, sphere({0, -101, 0}, 100), lambertian(0.5));
  add(bubble, sphere({0, 0, 0}, 1), glass(1.5));
  Scene relative = bubble;
  add(bubble, sphere({0, 0, 0}, -0.9), glass(1.5));
  add(relative, sphere({0, 0, 0}, 0.9), glass(1 / 1.5));
  for (const Kernels& kernels : available_kernels()) {
    CAPTURE(kernels.isa);
    CHECK(resolve(film_of(bubble, 8, kernels.isa)) == resolve(film_of(relative, 8, kernels.isa)));
  }
}

TEST_CASE("glass of index 1 changes no mean; single samples differ, because its events use up random numbers") {
  Scene scene = white_room();
  scene.background = Gradient{{0.1, 0.2, 0.3}, {1, 0.5, 0.2}};
  add(scene, sphere({0, -101, 0}, 100), lambertian(0.5));
  aim(scene, {0.3, 2, 4}, {0.1, -1, 0});
  const Estimate without = radiance(scene, 4096);
  add(scene, sphere({0, 0, 0}, 1), glass(1));
  const Estimate with = radiance(scene, 4096);
  CHECK(with.error < 1e-3 * with.mean);
  check_agree(with, without);
  Scene sky = white_room();  // nothing but sky: every ray goes straight on, in every bit
  sky.background = Gradient{{0.1, 0.2, 0.3}, {1, 0.5, 0.2}};
  sky.camera = {.look_from = {0, 0.2, 3}, .look_at = {0, 0, 0}};
  const std::vector<float> empty = resolve(film_of(sky, 4));
  add(sky, sphere({0, 0, 0}, 1), glass(1));
  add(sky, Box<>{{-2, -2, -2}, {2, 2, 1.5}}, glass(1), {RotateY{20}});
  CHECK(resolve(film_of(sky, 4)) == empty);
}

}  // namespace tyndall::test::glass_test
