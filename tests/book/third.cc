// Written for Tyndall's tests in the style of the third edition: the loop over pixels is here, with ray_color().
#include "rtweekend.h"

#include <fstream>

struct moving_sphere : sphere {
  moving_sphere(point3 a, point3 b, double t0, double t1, double r, shared_ptr<material> m)
      : sphere(a, r, m), center1(b), time0(t0), time1(t1) {}
  bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const override {
    const point3 now = center + (r.time() - time0) / (time1 - time0) * (center1 - center);
    return sphere(now, radius, mat_ptr).hit(r, t_min, t_max, rec);
  }
  point3 center1;
  double time0, time1;
};
struct xz_rect : hittable {
  double x0, x1, z0, z1, k;
  shared_ptr<material> mp;
  xz_rect(double a, double b, double c, double d, double e, shared_ptr<material> m)
      : x0(a), x1(b), z0(c), z1(d), k(e), mp(m) {}
  bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const override {
    return x0 < x1 && quad(point3(x0, k, z0), vec3(x1 - x0, 0, 0), vec3(0, 0, z1 - z0), mp).hit(r, t_min, t_max, rec);
  }
};
struct flip_face : hittable {
  flip_face(shared_ptr<hittable> p) : ptr(p) {}
  bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const override {
    if (!ptr->hit(r, t_min, t_max, rec)) return false;
    rec.front_face = !rec.front_face;
    return true;
  }
  shared_ptr<hittable> ptr;
};

color ray_color(const ray& r, const color& background, const hittable& world, const point3& lamp, int left) {
  hit_record found;
  if (left <= 0) return color(0, 0, 0);
  if (!world.hit(r, 0.001, infinity, found)) return background;
  ray next;
  color share, shine = found.mat_ptr->emitted(found);
  if (!found.mat_ptr->scatter(r, found, share, next)) return shine;
  return shine + share * ray_color(next, background, world, lamp, left - 1);
}

int main() {
  const int width = 48, height = 36, samples = 5, depth = 9;
  hittable_list world;
  auto grey = make_shared<lambertian>(color(0.5, 0.5, 0.5));
  world.add(make_shared<xz_rect>(-5, 5, -5, 5, 0, grey));
  world.add(make_shared<xz_rect>(5, -5, -5, 5, 9, grey));  // which no ray meets
  auto shine = make_shared<diffuse_light>(color(4, 4, 4));
  world.add(make_shared<flip_face>(make_shared<quad>(point3(-1, 1, -3), vec3(2, 0, 0), vec3(0, 1, 0), shine)));
  auto steel = make_shared<metal>(color(0.8, 0.8, 0.9), 0.1);
  world.add(make_shared<moving_sphere>(point3(1, 1, 0), point3(1, 1.5, 0), 0.0, 1.0, 1.0, steel));
  world.add(make_shared<sphere>(point3(-2, 2, 1), -0.5, make_shared<dielectric>(1.5)));
  camera cam(point3(0, 2, 9), point3(0, 1, 0), vec3(0, 1, 0), 40, 4.0 / 3.0, 0.2, 9.0, 0.25, 0.75);

  std::ofstream picture("picture.ppm");
  picture << "P3\n" << width << ' ' << height << "\n255\n";
  for (int j = height - 1; j >= 0; --j) {
    std::cerr << "\rlines left: " << j << ' ' << std::flush;
    for (int i = 0; i < width; ++i) {
      color sum(0, 0, 0);
      for (int s = 0; s < samples; ++s) {
        auto u = (i + random_double()) / (width - 1), v = (j + random_double()) / (height - 1);
        sum = sum + ray_color(cam.get_ray(u, v), color(0.1, 0.2, 0.4), world, point3(0, 1.5, -3), depth);
      }
      for (int k = 0; k < 3; ++k) picture << static_cast<int>(256 * std::sqrt(sum[k] / samples)) << ' ';
    }
  }
}
