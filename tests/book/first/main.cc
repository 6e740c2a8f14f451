// Written for Tyndall's tests in the style of the first edition: raw pointers, a function called color, numbers on
// standard output.

#define EDITION 1
#include "../headers/books.h"

vec3 color(const ray& r, hitable* world, int depth) {
  hit_record rec;
  if (world->hit(r, 0.001, infinity, rec)) {
    ray scattered;
    vec3 attenuation;
    if (depth < 20 && rec.mat_ptr->scatter(r, rec, attenuation, scattered))
      return attenuation * color(scattered, world, depth + 1);
    return vec3(0, 0, 0);
  }
  vec3 unit = unit_vector(r.direction());
  double share = 0.5 * (unit.y() + 1.0);
  return (1.0 - share) * vec3(1.0, 0.9, 0.8) + share * vec3(0.2, 0.4, 0.6);
}

int main() {
  int nx = 40, ny = 30, ns = 3;
  std::cout << "P3\n" << nx << " " << ny << "\n255\n";
  hitable* list[3];
  list[0] = new sphere(vec3(0, -100, 0), 100, new lambertian(vec3(0.4, 0.5, 0.6)));
  list[1] = new sphere(vec3(0, 1, 0), 1, new metal(vec3(0.7, 0.6, 0.5), 0.25));
  list[2] = new sphere(vec3(2, 0.5, 1), 0.5, new dielectric(1.5));
  hitable* world = new hitable_list(list, 3);
  camera cam(vec3(4, 2, 6), vec3(0, 1, 0), vec3(0, 1, 0), 50, double(nx) / ny, 0.0, 7.0);
  for (int j = ny - 1; j >= 0; j--) {
    for (int i = 0; i < nx; i++) {
      vec3 col(0, 0, 0);
      for (int s = 0; s < ns; s++) {
        double u = (i + random_double()) / nx;
        double v = (j + random_double()) / ny;
        ray r = cam.get_ray(u, v);
        col += color(r, world, 0);
      }
      col = 1.0 / ns * col;
      col = vec3(sqrt(col[0]), sqrt(col[1]), sqrt(col[2]));
      int ir = int(255.99 * col[0]);
      int ig = int(255.99 * col[1]);
      int ib = int(255.99 * col[2]);
      std::cout << ir << " " << ig << " " << ib << "\n";
    }
  }
}
