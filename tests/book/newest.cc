// Written for Tyndall's tests in the style of the fourth edition: camera::render() at the end of main().
#include "second_book.h"

int main() {
  hittable_list room;
  auto tiles = make_shared<checker_texture>(0.5, color(0.1, 0.2, 0.3), color(0.8, 0.8, 0.8));
  room.add(make_shared<quad>(point3(-4, 0, -4), vec3(8, 0, 0), vec3(0, 0, 8), make_shared<textured>(tiles)));
  room.add(make_shared<sphere>(point3(0, 1, 0), 1.0, make_shared<dielectric>(1.5)));
  room.add(make_shared<sphere>(point3(-2, 0.5, 1), point3(-2, 0.75, 1), 0.5, make_shared<metal>(color(0.9, 0.6, 0.2), 1.0)));

  shared_ptr<hittable> block = box(point3(1, 0, -1), point3(0, 2, 0), make_shared<lambertian>(color(0.5, 0.25, 0.125)));
  block = make_shared<rotate_y>(block, std::acos(-1.0) / 6);
  block = make_shared<translate>(block, vec3(2, 0, 0));
  room.add(block);
  auto mist = make_shared<sphere>(point3(2, 1, 2), 0.75, shared_ptr<material>());
  room.add(make_shared<constant_medium>(mist, 0.5, color(0.9, 0.9, 1.0)));
  room.add(make_shared<quad>(point3(-1, 4, -1), vec3(2, 0, 0), vec3(0, 0, 2), make_shared<diffuse_light>(color(5, 4, 3))));

  camera cam;
  cam.aspect_ratio = 4.0 / 3.0;
  cam.image_width = 64;
  cam.samples_per_pixel = 8;
  cam.max_depth = 7;
  cam.background = color(0.25, 0.5, 0.75);
  cam.vfov = 45;
  cam.lookfrom = point3(3, 3, 8);
  cam.lookat = point3(0, 1, 0);
  cam.vup = vec3(0, 1, 0);
  cam.defocus_angle = 0.5;
  cam.focus_dist = 8;
  cam.render(room);
}
