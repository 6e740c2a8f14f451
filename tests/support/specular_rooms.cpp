#include "tests/support/specular_rooms.h"

#include "tests/support/probe.h"

namespace tyndall::test {
namespace {

constexpr Vec3d sphere_center{0, 1.2, 0}, light_center{0.08, 4.1, 0.05};
constexpr Vec3d bulb_center{-0.3, 1.8, -0.2}, beside_center{-0.1, 1.9, -0.1};

/// Walls of a room, seen from a corner.
Scene dim_room() {
  Scene scene = dark_room();
  scene.width = 48, scene.height = 36;
  scene.render.integrator = Integrator::mis;
  scene.render.sampler = SamplerKind::sobol;
  scene.camera = {.look_from = {2.8, 2.6, 2.7}, .look_at = {-0.6, 1, -0.6}, .vfov = 75};
  add(scene, Box<>{{-3, 0, -3}, {3, 5, 3}}, lambertian(0.2));
  return scene;
}

/// A room with a hood over the middle of the floor: a light in the hood shines only on a sphere below it.
Scene hooded_room() {
  Scene scene = dim_room();
  const Material black = lambertian(0);
  const double half = 0.3, low = 3, high = 4.5, wide = 2 * half;
  for (const double side : {-half, half}) {
    add(scene, Quad<>{{-half, low, side}, {wide, 0, 0}, {0, high - low, 0}}, black);
    add(scene, Quad<>{{side, low, -half}, {0, 0, wide}, {0, high - low, 0}}, black);
  }
  add(scene, Quad<>{{-half, high, -half}, {wide, 0, 0}, {0, 0, wide}}, black);
  return scene;
}

/// The hooded room with a light, whose power is the same for every radius. Rooms with solid spheres get a larger light,
/// because such spheres gather the light of small lights at bright edges, where few samples make most of the noise.
Scene under_hood(double light_radius = 0.05) {
  Scene scene = hooded_room();
  add(scene, sphere(light_center, light_radius), lamp(1.75 / (light_radius * light_radius)));
  return scene;
}

constexpr double large_light = 0.2;
constexpr double edges = 0.02;  // precision of rooms where such edges, or media within glass, leave much noise

void add_shell(Scene& scene, Vec3d center, double inner, Vec3d direction = {}) {
  const auto moving = [&](double radius) {
    return direction == Vec3d{} ? sphere(center, radius) : Sphere<>{center, radius, center + direction};
  };
  add(scene, moving(1), glass(1.5));
  add(scene, moving(-inner), glass(1.5));
}

Scene with(Scene scene, auto change) {
  change(scene);
  return scene;
}

void open_shutter(Scene& scene) { scene.camera.shutter_open = 0.2, scene.camera.shutter_close = 0.9; }

void fill_with_medium(Scene& scene) { add_medium(scene, Box<>{{-2.9, 0.1, -2.9}, {1.8, 2.9, 2.9}}, {0.3, 0.3}, 0.9); }

std::vector<SpecularRoom> balls() {
  const auto ball = [](const Material& material, double light_radius = 0.05) {
    return with(under_hood(light_radius), [&](Scene& s) { add(s, sphere(sphere_center, 1), material); });
  };
  const auto shell = [](double inner, double light_radius = 0.05) {
    return with(under_hood(light_radius), [&](Scene& s) { add_shell(s, sphere_center, inner); });
  };
  return {
      {"mirror", ball(metal(0.9, 0)), 256},
      {"glass", ball(glass(1.5), large_light), 1024, edges},
      {"glass of index 2.4", ball(glass(2.4), large_light), 1024, edges},
      {"air in glass", ball(glass(0.75)), 1024},
      {"shell", shell(0.85), 256},
      {"shell of two indices",
       with(ball(glass(1.5)), [](Scene& s) { add(s, sphere(sphere_center, 0.85), glass(1 / 1.5)); }), 256},
      {"thick shell", shell(0.5, large_light), 1024, 0.006},
      {"thing in a shell", with(shell(0.85),
                                [](Scene& s) {
                                  add(s, sphere({0.3, 1.3, 0.1}, 0.3), lambertian(0.5));
                                })},
  };
}

std::vector<SpecularRoom> bulbs() {
  const auto bulb = [](Vec3d at, auto add_glass, double light_radius = 0.05) {
    return with(dim_room(), [&](Scene& s) {
      add(s, sphere(at, light_radius), lamp(0.75 / (light_radius * light_radius)));
      add_glass(s);
    });
  };
  const auto shell = [](Scene& s) { add_shell(s, bulb_center, 0.85); };
  const auto solid = [](Scene& s) { add(s, sphere(bulb_center, 1), glass(1.5)); };
  return {
      {"bulb", bulb(beside_center, shell)},
      {"bulb, lamp in the middle", bulb(bulb_center, shell)},
      {"bulb of thick glass", bulb({-0.2, 1.9, -0.15}, [](Scene& s) { add_shell(s, bulb_center, 0.4); }), 1024},
      {"lamp in glass", bulb(beside_center, solid)},
      {"lamp in the middle of glass", bulb(bulb_center, solid)},
      {"moving bulb", bulb(beside_center,
                           [](Scene& s) {
                             add_shell(s, bulb_center, 0.85, {0.1, 0.1, 0});
                             open_shutter(s);
                           })},
      {"fog in a bulb",
       bulb(
           beside_center,
           [&](Scene& s) {
             shell(s);
             add_medium(s, sphere(bulb_center, 0.85), {0.5, 0.3}, 0.9);
           },
           large_light),
       512, edges},
      {"bulb in fog",
       bulb(
           beside_center,
           [&](Scene& s) {
             shell(s);
             fill_with_medium(s);
           },
           large_light),
       512, edges},
  };
}

std::vector<SpecularRoom> in_medium_and_moving() {
  const auto moving = [](const Material& material) {
    return with(under_hood(large_light), [&](Scene& s) {
      add(s, Sphere<>{sphere_center, 1, sphere_center + Vec3d{0.1, 0.1, 0.1}}, material);
      open_shutter(s);
    });
  };
  const auto foggy = [](const Material& material) {
    return with(under_hood(large_light), [&](Scene& s) {
      add(s, sphere(sphere_center, 1), material);
      fill_with_medium(s);
    });
  };
  return {
      {"moving mirror", moving(metal(0.9, 0)), 1024},
      {"moving glass", moving(glass(1.5)), 1024, edges},
      {"moving shell",
       with(under_hood(),
            [](Scene& s) {
              add_shell(s, sphere_center, 0.85, {0.1, 0.1, 0.1});
              open_shutter(s);
            }),
       256},
      {"mirror in fog", foggy(metal(0.9, 0)), 512, 0.006},
      {"glass in fog", foggy(glass(1.5)), 1024, edges},
      {"shell in fog",
       with(under_hood(large_light),
            [](Scene& s) {
              add_shell(s, sphere_center, 0.85);
              fill_with_medium(s);
            }),
       512, edges},
      {"fog in glass",
       with(under_hood(large_light),
            [](Scene& s) {
              add(s, sphere(sphere_center, 1), glass(1.5));
              add_medium(s, sphere(sphere_center, 1), {0.5, 0.3}, 0.9);
            }),
       1024, edges},
  };
}

std::vector<SpecularRoom> mirrors() {
  const Material silver = metal(0.9, 0);
  const auto tilted = [&](Scene& s) { add(s, Quad<>{{-1.2, 0.88, -1.2}, {2.4, 1.2, 0}, {0, -0.36, 2.4}}, silver); };
  return {
      {"flat mirror", with(under_hood(), tilted)},
      {"block of metal",
       with(under_hood(),
            [&](Scene& s) {
              add(s, Box<>{{0.3, 0.02, -1.2}, {1.2, 2.6, 1.2}}, silver, {RotateY{45}});
            }),
       256},
      {"flat mirror in fog",
       with(under_hood(large_light),
            [&](Scene& s) {
              tilted(s);
              fill_with_medium(s);
            }),
       512, 0.006},
  };
}

std::vector<SpecularRoom> slabs() {
  const auto hanging = [](double index) {
    return [index](Scene& s) { add(s, Box<>{{-0.9, 1.9, -0.7}, {1, 2.1, 0.8}}, glass(index), {RotateY{20}}); };
  };
  return {
      {"pane", with(under_hood(), hanging(1.5)), 512, 0.003, 2e7},
      {"block of glass",
       with(under_hood(large_light),
            [](Scene& s) {
              add(s, Box<>{{-0.5, 1, -0.4}, {0.4, 2, 0.5}}, glass(1.6), {RotateY{30}});
            }),
       1024, 0.006},
      {"block of glass just above the floor",
       with(under_hood(large_light),
            [](Scene& s) {
              add(s, Box<>{{-0.9, 0.02, -0.8}, {0.9, 1.2, 0.8}}, glass(1.5), {RotateY{30}});
            }),
       1024, 0.006, 2e7},
      {"pane in fog",
       with(under_hood(large_light),
            [&](Scene& s) {
              hanging(1.5)(s);
              add_medium(s, Box<>{{-2.9, 0.1, -2.9}, {2.8, 2.9, 2.9}}, {0.3, 0.3}, 0.9);
            }),
       512, 0.03},
  };
}

std::vector<SpecularRoom> lamps() {
  const auto lit = [](auto add_lights) {
    return with(hooded_room(), [&](Scene& s) {
      add(s, sphere(sphere_center, 1), metal(0.9, 0));
      add_lights(s);
    });
  };
  const Quad<> quad{{-0.1, 4.1, -0.05}, {0.15, 0, 0}, {0, 0.03, 0.15}};
  return {
      {"quad as lamp", lit([&](Scene& s) { add(s, quad, lamp(500)); }), 512},
      {"textured lamp", lit([&](Scene& s) {
         s.textures.push_back({"tiles", Checker<>{0.04, {0.1, 0.5, 1}, {1, 0.7, 0.2}}});
         add(s, quad, {"", TextureIndex{0}, Light<>{}});
       }),
       512},
      {"box as lamp", lit([](Scene& s) {
         add(s, Box<>{{-0.05, 4, -0.05}, {0.05, 4.1, 0.05}}, lamp(500));
       }),
       512, 0.006},
      {"moving lamp", lit([](Scene& s) {
         add(s, Sphere<>{{-0.1, 4.1, 0}, 0.05, Vec3d{0.1, 4.2, 0.05}}, lamp(700));
         open_shutter(s);
       }),
       256},
      {"two lamps and two balls", lit([](Scene& s) {
         add(s, sphere(light_center, 0.05), lamp(700));
         add(s, sphere({-0.1, 4.2, -0.1}, 0.03), lamp(900));
         add(s, sphere({1.7, 0.5, -1.5}, 0.5), glass(1.5));
       }),
       1024},
  };
}

}  // namespace

std::vector<SpecularRoom> specular_rooms() {
  std::vector<SpecularRoom> all;
  for (const std::vector<SpecularRoom>& some : {balls(), bulbs(), in_medium_and_moving(), mirrors(), slabs(), lamps()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace tyndall::test
