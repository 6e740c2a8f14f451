#pragma once
// A small path tracer with the interface of the books' fourth edition, as far as ../main.cc uses it: one ray after the
// other, in one thread, as the first two books describe it. It is what Tyndall is compared with; it is no part of it.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <memory>
#include <vector>

using std::make_shared;
using std::shared_ptr;

inline double random_double() { return std::rand() / (RAND_MAX + 1.0); }
inline double random_double(double low, double high) { return low + (high - low) * random_double(); }

struct vec3 {
  double e[3] = {0, 0, 0};
  vec3() = default;
  vec3(double x, double y, double z) : e{x, y, z} {}
  double operator[](int axis) const { return e[axis]; }
  double squared() const { return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]; }
  double length() const { return std::sqrt(squared()); }
  static vec3 random(double low = 0, double high = 1) {
    return vec3(random_double(low, high), random_double(low, high), random_double(low, high));
  }
};
using point3 = vec3;
using color = vec3;
inline vec3 operator+(const vec3& a, const vec3& b) { return vec3(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
inline vec3 operator-(const vec3& a, const vec3& b) { return vec3(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
inline vec3 operator*(const vec3& a, const vec3& b) { return vec3(a[0] * b[0], a[1] * b[1], a[2] * b[2]); }
inline vec3 operator*(double t, const vec3& v) { return vec3(t * v[0], t * v[1], t * v[2]); }
inline double dot(const vec3& a, const vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline vec3 cross(const vec3& a, const vec3& b) {
  return vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline vec3 unit(const vec3& v) { return 1 / v.length() * v; }
inline vec3 in_ball() {
  vec3 p = vec3::random(-1, 1);
  while (p.squared() >= 1) p = vec3::random(-1, 1);
  return p;
}

struct ray {
  point3 origin;
  vec3 direction;
  point3 at(double t) const { return origin + t * direction; }
};

struct material;
struct hit_record {
  double t = 0;
  point3 p;
  vec3 normal;  // towards the ray's origin
  bool front_face = true;
  const material* mat = nullptr;
  void face(const ray& r, const vec3& outward) {
    front_face = dot(r.direction, outward) < 0;
    normal = front_face ? outward : -1 * outward;
  }
};
struct interval {
  double min, max;
  interval(double low, double high) : min(low), max(high) {}
};
const double infinity = std::numeric_limits<double>::infinity();

struct material {
  virtual ~material() = default;
  virtual color emitted() const { return color(); }
  virtual bool scatter(const ray&, const hit_record&, color&, ray&) const { return false; }
};
struct lambertian : material {
  color albedo;
  lambertian(const color& a) : albedo(a) {}
  bool scatter(const ray&, const hit_record& hit, color& part, ray& out) const override {
    part = albedo;
    out = {hit.p, hit.normal + unit(in_ball())};
    return true;
  }
};
inline vec3 reflect(const vec3& v, const vec3& normal) { return v - 2 * dot(v, normal) * normal; }
struct metal : material {
  color albedo;
  double fuzz;
  metal(const color& a, double f) : albedo(a), fuzz(f) {}
  bool scatter(const ray& in, const hit_record& hit, color& part, ray& out) const override {
    part = albedo;
    out = {hit.p, reflect(unit(in.direction), hit.normal) + fuzz * in_ball()};
    return dot(out.direction, hit.normal) > 0;
  }
};
struct dielectric : material {
  double index;
  dielectric(double n) : index(n) {}
  bool scatter(const ray& in, const hit_record& hit, color& part, ray& out) const override {
    part = color(1, 1, 1);
    const double ratio = hit.front_face ? 1 / index : index;
    const vec3 to = unit(in.direction);
    const double cosine = std::min(-dot(to, hit.normal), 1.0), sine2 = ratio * ratio * (1 - cosine * cosine);
    const double r0 = (1 - ratio) / (1 + ratio) * (1 - ratio) / (1 + ratio);
    const bool mirrors = sine2 > 1 || r0 + (1 - r0) * std::pow(1 - cosine, 5) > random_double();
    const vec3 through = ratio * to + (ratio * cosine - std::sqrt(std::max(0.0, 1 - sine2))) * hit.normal;
    out = {hit.p, mirrors ? reflect(to, hit.normal) : through};
    return true;
  }
};
struct diffuse_light : material {
  color radiance;
  diffuse_light(const color& c) : radiance(c) {}
  color emitted() const override { return radiance; }
};

struct box_of_space {
  vec3 low = vec3(1e9, 1e9, 1e9), high = vec3(-1e9, -1e9, -1e9);
  void add(const vec3& p) {
    for (int k = 0; k < 3; ++k) low.e[k] = std::min(low[k], p[k] - 1e-4), high.e[k] = std::max(high[k], p[k] + 1e-4);
  }
  bool hit(const ray& r, double nearest, double farthest) const {
    for (int k = 0; k < 3; ++k) {
      const double a = (low[k] - r.origin[k]) / r.direction[k], b = (high[k] - r.origin[k]) / r.direction[k];
      nearest = std::max(nearest, std::min(a, b)), farthest = std::min(farthest, std::max(a, b));
    }
    return nearest < farthest;
  }
};

struct hittable {
  box_of_space bounds;
  virtual ~hittable() = default;
  virtual bool hit(const ray& r, interval range, hit_record& hit) const = 0;
};
struct hittable_list : hittable {
  std::vector<shared_ptr<hittable>> objects;
  hittable_list() = default;
  hittable_list(shared_ptr<hittable> object) { add(object); }
  void add(shared_ptr<hittable> object) {
    objects.push_back(object);
    bounds.add(object->bounds.low), bounds.add(object->bounds.high);
  }
  bool hit(const ray& r, interval range, hit_record& nearest) const override {
    bool any = false;
    for (const auto& object : objects)
      if (object->hit(r, range, nearest)) any = true, range.max = nearest.t;
    return any;
  }
};
struct bvh_node : hittable_list {
  bvh_node(hittable_list list) {
    const auto centre = [](const shared_ptr<hittable>& one, int k) { return one->bounds.low[k] + one->bounds.high[k]; };
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (list.bounds.high[k] - list.bounds.low[k] > list.bounds.high[axis] - list.bounds.low[axis]) axis = k;
    std::sort(list.objects.begin(), list.objects.end(),
              [&](const auto& a, const auto& b) { return centre(a, axis) < centre(b, axis); });
    if (list.objects.size() <= 2) {
      for (const auto& object : list.objects) add(object);
      return;
    }
    hittable_list halves[2];
    for (std::size_t k = 0; k < list.objects.size(); ++k) halves[2 * k >= list.objects.size()].add(list.objects[k]);
    for (const hittable_list& half : halves) add(make_shared<bvh_node>(half));
  }
  bool hit(const ray& r, interval range, hit_record& nearest) const override {
    return bounds.hit(r, range.min, range.max) && hittable_list::hit(r, range, nearest);
  }
};
struct sphere : hittable {
  point3 center;
  double radius;
  shared_ptr<material> mat;
  sphere(const point3& c, double r, shared_ptr<material> m) : center(c), radius(r), mat(m) {
    bounds.add(c - vec3(r, r, r)), bounds.add(c + vec3(r, r, r));
  }
  bool hit(const ray& r, interval range, hit_record& nearest) const override {
    const vec3 to = center - r.origin;
    const double a = r.direction.squared(), h = dot(r.direction, to), d = h * h - a * (to.squared() - radius * radius);
    if (d < 0) return false;
    double t = (h - std::sqrt(d)) / a;
    if (t < range.min) t = (h + std::sqrt(d)) / a;
    if (t < range.min || t > range.max) return false;
    nearest.t = t;
    nearest.p = r.at(t);
    nearest.mat = mat.get();
    nearest.face(r, 1 / radius * (nearest.p - center));
    return true;
  }
};
struct quad : hittable {
  point3 corner;
  vec3 u, v, normal;
  shared_ptr<material> mat;
  quad(const point3& q, const vec3& a, const vec3& b, shared_ptr<material> m)
      : corner(q), u(a), v(b), normal(cross(a, b)), mat(m) {
    for (const point3& p : {q, q + a, q + b, q + a + b}) bounds.add(p);
  }
  bool hit(const ray& r, interval range, hit_record& nearest) const override {
    const double slope = dot(normal, r.direction), t = dot(normal, corner - r.origin) / slope;
    if (!(t > range.min && t < range.max)) return false;
    const vec3 p = r.at(t) - corner;
    const double a = dot(normal, cross(p, v)) / normal.squared(), b = dot(normal, cross(u, p)) / normal.squared();
    if (a < 0 || a > 1 || b < 0 || b > 1) return false;
    nearest.t = t;
    nearest.p = r.at(t);
    nearest.mat = mat.get();
    nearest.face(r, unit(normal));
    return true;
  }
};

struct camera {
  double aspect_ratio = 1, vfov = 90, defocus_angle = 0, focus_dist = 10;
  int image_width = 100, samples_per_pixel = 10, max_depth = 10;
  color background;
  point3 lookfrom, lookat = point3(0, 0, -1);
  vec3 vup = vec3(0, 1, 0);

  void render(const hittable& world) {
    const double degree = std::acos(-1.0) / 180;
    image_height = static_cast<int>(image_width / aspect_ratio);
    lens = focus_dist * std::tan(defocus_angle / 2 * degree);
    pixel = 2 * std::tan(vfov / 2 * degree) * focus_dist / image_height;
    back = unit(lookfrom - lookat), right = unit(cross(vup, back)), up = cross(back, right);
    std::cout << "P3\n" << image_width << ' ' << image_height << "\n255\n";
    for (int y = 0; y < image_height; ++y)
      for (int x = 0; x < image_width; ++x) {
        color sum;
        for (int sample = 0; sample < samples_per_pixel; ++sample)
          sum = sum + ray_color(get_ray(x, y), world, max_depth);
        for (int k = 0; k < 3; ++k)
          std::cout << static_cast<int>(256 * std::min(std::sqrt(sum[k] / samples_per_pixel), 0.999)) << ' ';
        std::cout << '\n';
      }
  }

  ray get_ray(int x, int y) const {
    const double across = (x + random_double() - image_width / 2.0) * pixel;
    const double down = (y + random_double() - image_height / 2.0) * pixel;
    vec3 p = vec3(random_double(-1, 1), random_double(-1, 1), 0);
    while (p.squared() >= 1) p = vec3(random_double(-1, 1), random_double(-1, 1), 0);
    const point3 eye = lookfrom + lens * p[0] * right + lens * p[1] * up;
    const point3 seen = lookfrom - focus_dist * back + across * right - down * up;
    return {eye, seen - eye};
  }

  color ray_color(const ray& r, const hittable& world, int depth) const {
    if (depth <= 0) return color();
    hit_record hit;
    if (!world.hit(r, interval(0.001, infinity), hit)) return background;
    color part;
    ray out;
    if (!hit.mat->scatter(r, hit, part, out)) return hit.mat->emitted();
    return hit.mat->emitted() + part * ray_color(out, world, depth - 1);
  }

  int image_height = 0;
  double lens = 0, pixel = 0;
  vec3 back, right, up;
};
