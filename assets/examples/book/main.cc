// A table by lamplight, written as readers of "Ray Tracing in One Weekend" and "The Next Week" write their scenes:
// `tyndall main.cc` shows it. The headers in tracer are a small path tracer with the same interface, for comparison.
#include "rtweekend.h"

#include "bvh.h"
#include "camera.h"
#include "hittable_list.h"
#include "material.h"
#include "quad.h"
#include "sphere.h"

int main() {
  hittable_list world;

  auto wood = make_shared<lambertian>(color(0.36, 0.22, 0.13));
  auto wall = make_shared<lambertian>(color(0.24, 0.3, 0.36));
  world.add(make_shared<quad>(point3(-12, 0, 8), vec3(24, 0, 0), vec3(0, 0, -14), wood));
  world.add(make_shared<quad>(point3(-12, 0, -6), vec3(24, 0, 0), vec3(0, 10, 0), wall));

  auto lamp = make_shared<diffuse_light>(color(34, 27, 18));
  world.add(make_shared<quad>(point3(-2.2, 6, -0.5), vec3(1.4, 0, 0), vec3(0, 0, 1.4), lamp));
  auto glow = make_shared<diffuse_light>(color(1.1, 1.9, 3.2));
  world.add(make_shared<sphere>(point3(3.1, 0.45, 1.1), 0.45, glow));

  auto glass = make_shared<dielectric>(1.5);
  world.add(make_shared<sphere>(point3(-1.1, 1, 0.9), 1, glass));
  world.add(make_shared<sphere>(point3(1, 1.2, -0.6), 1.2, make_shared<metal>(color(0.9, 0.68, 0.38), 0.08)));
  world.add(make_shared<sphere>(point3(-3.4, 1.3, -1.6), 1.3, make_shared<lambertian>(color(0.62, 0.16, 0.12))));

  // Beads on the table, wherever there is room.
  for (int column = -4; column <= 4; ++column)
    for (int row = 0; row <= 4; ++row) {
      point3 place(column + 0.6 * random_double(), 0.22, row - 0.4 + 0.6 * random_double());
      bool is_free =
          (place - point3(-1.1, 0.22, 0.9)).length() > 1.15 && (place - point3(1, 0.22, -0.6)).length() > 1.25;
      is_free = is_free && (place - point3(3.1, 0.22, 1.1)).length() > 0.75;
      if (!is_free) continue;
      double kind = random_double();
      shared_ptr<material> made_of = glass;
      if (kind < 0.5)
        made_of = make_shared<lambertian>(color::random() * color::random());
      else if (kind < 0.8)
        made_of = make_shared<metal>(color::random(0.5, 1), random_double(0, 0.3));
      world.add(make_shared<sphere>(place, 0.22, made_of));
    }
  world = hittable_list(make_shared<bvh_node>(world));

  camera cam;
  cam.aspect_ratio = 4.0 / 3.0;
  cam.image_width = 400;
  cam.samples_per_pixel = 100;
  cam.max_depth = 50;
  cam.background = color(0.01, 0.012, 0.02);
  cam.vfov = 30;
  cam.lookfrom = point3(-0.5, 3.4, 10);
  cam.lookat = point3(-0.2, 1, 0);
  cam.vup = vec3(0, 1, 0);
  cam.defocus_angle = 0.8;
  cam.focus_dist = 9.2;
  cam.render(world);
}
