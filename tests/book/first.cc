// Written for Tyndall's tests in the style of the first edition: raw pointers, a function called color, numbers on
// standard output.
#include "rtweekend.h"

vec3 color(const ray& r, hitable* world, int depth) {
  hit_record rec;
  if (world->hit(r, 0.001, infinity, rec)) {
    ray scattered;
    vec3 attenuation;
    if (depth < 20 && rec.mat_ptr->scatter(r, rec, attenuation, scattered))
      return attenuation * color(scattered, world, depth + 1);
    return vec3(0, 0, 0);
  }
  vec3 up = unit(r.direction());
  double share = 0.5 * (up[1] + 1.0);
  return (1.0 - share) * vec3(1.0, 0.9, 0.8) + share * vec3(0.2, 0.4, 0.6);
}

int main() {
  const int nx = 40, ny = 30, ns = 3;
  std::cout << "P3\n" << nx << " " << ny << "\n255\n";
  hitable* list[3];
  list[0] = new sphere(vec3(0, -100, 0), 100, new lambertian(vec3(0.4, 0.5, 0.6)));
  list[1] = new sphere(vec3(0, 1, 0), 1, new metal(vec3(0.7, 0.6, 0.5), 0.25));
  list[2] = new sphere(vec3(2, 0.5, 1), 0.5, new dielectric(1.5));
  hitable* world = new hitable_list(list, 3);
  camera cam(vec3(4, 2, 6), vec3(0, 1, 0), vec3(0, 1, 0), 50, double(nx) / ny, 0.0, 7.0);
  for (int j = ny - 1; j >= 0; j--)
    for (int i = 0; i < nx; i++) {
      vec3 col(0, 0, 0);
      for (int s = 0; s < ns; s++)
        col = col + color(cam.get_ray((i + random_double()) / nx, (j + random_double()) / ny), world, 0);
      for (int k = 0; k < 3; k++) std::cout << int(255.99 * std::sqrt(col[k] / ns)) << " ";
    }
}
