#pragma once
// Headers of readers' programs, for Tyndall's tests: a small path tracer with the interface of the books' editions 1, 3
// and 4, by EDITION. What a test's program does otherwise it says by macros before it includes this.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>
#ifndef EDITION
#define EDITION 4
#endif

using std::make_shared;
using std::shared_ptr;
const double infinity = std::numeric_limits<double>::infinity(), pi = 3.14159265358979323846;

#ifdef OWN_GENERATOR
inline double random_double() { OWN_GENERATOR; }
#elif EDITION == 1
inline double random_double() { return drand48(); }
#else
inline double random_double() { return std::rand() / (RAND_MAX + 1.0); }
#endif
inline double random_double(double low, double high) { return low + (high - low) * random_double(); }

struct vec3 {
  double e[3] = {0, 0, 0};
  vec3() = default;
  vec3(double x, double y, double z) : e{x, y, z} {}
  double x() const { return e[0]; }
  double y() const { return e[1]; }
  double z() const { return e[2]; }
  double operator[](int axis) const { return e[axis]; }
  double length() const { return std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]); }
};
using point3 = vec3;
#if EDITION > 1
using color = vec3;
#endif
inline vec3 operator+(const vec3& a, const vec3& b) { return vec3(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
inline vec3 operator-(const vec3& a, const vec3& b) { return vec3(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
inline vec3 operator*(const vec3& a, const vec3& b) { return vec3(a[0] * b[0], a[1] * b[1], a[2] * b[2]); }
inline vec3 operator*(double t, const vec3& v) { return vec3(t * v[0], t * v[1], t * v[2]); }
inline vec3& operator+=(vec3& a, const vec3& b) { return a = a + b; }
inline double dot(const vec3& a, const vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline vec3 cross(const vec3& a, const vec3& b) {
  return vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
inline vec3 unit_vector(const vec3& v) { return 1 / v.length() * v; }
inline vec3 random_in_ball() {
  for (;;) {
    const vec3 p(random_double(-1, 1), random_double(-1, 1), random_double(-1, 1));
    if (p.length() < 1 && p.length() > 1e-3) return p;
  }
}
inline vec3 reflect(const vec3& v, const vec3& n) { return v - 2 * dot(v, n) * n; }

class ray {
 public:
  ray() = default;
  ray(const point3& from, const vec3& to, double time = 0) : orig(from), dir(to), tm(time) {}
  const point3& origin() const { return orig; }
  const vec3& direction() const { return dir; }
  double time() const { return tm; }
  point3 at(double t) const { return orig + t * dir; }

 private:
  point3 orig;
  vec3 dir;
  double tm = 0;
};

#if EDITION == 4
struct interval {
  double min, max;
  interval(double low, double high) : min(low), max(high) {}
};
#define RANGE interval range
#define LOW range.min
#define HIGH range.max
#define PASS(low, high) interval(low, high)
#else
#define RANGE double t_min, double t_max
#define LOW t_min
#define HIGH t_max
#define PASS(low, high) low, high
#endif
#if EDITION == 1
template <class T>
using pointer = T*;
#define hittable hitable
#define hittable_list hitable_list
#else
template <class T>
using pointer = shared_ptr<T>;
#endif

class material;
struct hit_record {
  double t = 0, u = 0, v = 0;
  point3 p;
  vec3 normal;
#if EDITION == 4
  shared_ptr<material> mat;
#else
  pointer<material> mat_ptr;
#endif
#if EDITION > 1
  bool front_face = true;
#endif
  void met(const ray& r, double at, const vec3& outward, const pointer<material>& of) {
    t = at;
    p = r.at(at);
    normal = outward;
#if EDITION == 4
    mat = of;
#else
    mat_ptr = of;
#endif
#if EDITION > 1
    front_face = dot(r.direction(), outward) < 0;
    if (!front_face) normal = -1 * outward;
#endif
  }
};

class hittable {
 public:
  virtual ~hittable() = default;
  virtual bool hit(const ray& r, RANGE, hit_record& rec) const = 0;
};
class hittable_list : public hittable {
 public:
#if EDITION == 1
  hittable_list(hittable** l, int n) : list(l), list_size(n) {}
  hittable** list;
  int list_size;
#else
  std::vector<shared_ptr<hittable>> objects;
  void add(shared_ptr<hittable> object) { objects.push_back(object); }
#endif
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    bool any = false;
    double nearest = HIGH;
#if EDITION == 1
    for (int k = 0; k < list_size; ++k)
      if (list[k]->hit(r, LOW, nearest, rec)) any = true, nearest = rec.t;
#else
    for (const auto& object : objects)
      if (object->hit(r, PASS(LOW, nearest), rec)) any = true, nearest = rec.t;
#endif
    return any;
  }
};
class sphere : public hittable {
 public:
#if EDITION == 4
  sphere(const point3& c, double r, pointer<material> m) : sphere(c, c, r, m) {}
#else
  sphere(const point3& c, double r, pointer<material> m) : center(c), radius(r), mat(m) {}
#endif
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    const vec3 from = r.origin() - centre_at(r.time());
    const double a = dot(r.direction(), r.direction()), b = dot(from, r.direction()),
                 d = b * b - a * (dot(from, from) - radius * radius);
    for (const double side : {-1.0, 1.0}) {
      const double t = (-b + side * std::sqrt(d)) / a;
      if (!(d > 0 && t > LOW && t < HIGH)) continue;
      rec.met(r, t, 1 / radius * (r.at(t) - centre_at(r.time())), mat);
      return true;
    }
    return false;
  }
#if EDITION == 4
  sphere(const point3& c, const point3& c2, double r, pointer<material> m) : center(c, c2 - c), radius(r), mat(m) {}
  point3 centre_at(double time) const { return center.at(time); }
  ray center;
#else
  virtual point3 centre_at(double) const { return center; }
  point3 center;
#endif
  double radius;
  pointer<material> mat;
};
class quad : public hittable {
 public:
  quad(const point3& q, const vec3& a, const vec3& b, pointer<material> m) : Q(q), u(a), v(b), mat(m) {}
  virtual bool is_interior(double a, double b, hit_record&) const { return 0 <= a && a <= 1 && 0 <= b && b <= 1; }
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    const vec3 n = cross(u, v), w = 1 / dot(n, n) * n;
    const double t = dot(n, Q - r.origin()) / dot(n, r.direction());
    if (!(t > LOW && t < HIGH)) return false;
    const vec3 p = r.at(t) - Q;
    if (!is_interior(dot(w, cross(p, v)), dot(w, cross(u, p)), rec)) return false;
    rec.met(r, t, unit_vector(n), mat);
    return true;
  }
  point3 Q;
  vec3 u, v;
  pointer<material> mat;
};
class translate : public hittable {
 public:
  translate(pointer<hittable> what, const vec3& by) : object(what), offset(by) {}
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    if (!object->hit(ray(r.origin() - offset, r.direction(), r.time()), PASS(LOW, HIGH), rec)) return false;
    rec.p = rec.p + offset;
    return true;
  }

 private:
  pointer<hittable> object;
  vec3 offset;
};
class rotate_y : public hittable {
 public:
  rotate_y(pointer<hittable> what, double angle)
      : object(what), sin_theta(std::sin(angle * pi / 180)), cos_theta(std::cos(angle * pi / 180)) {}
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    if (!object->hit(ray(turned(r.origin(), sin_theta), turned(r.direction(), sin_theta), r.time()), PASS(LOW, HIGH),
                     rec))
      return false;
    rec.p = turned(rec.p, -sin_theta);
    rec.normal = turned(rec.normal, -sin_theta);
    return true;
  }

 private:
  vec3 turned(const vec3& a, double s) const {
    return vec3(cos_theta * a[0] - s * a[2], a[1], s * a[0] + cos_theta * a[2]);
  }
  pointer<hittable> object;
  double sin_theta, cos_theta;
};
#if EDITION == 3
class moving_sphere : public sphere {
 public:
  moving_sphere(point3 a, point3 b, double t0, double t1, double r, shared_ptr<material> m)
      : sphere(a, r, m), center0(a), center1(b), time0(t0), time1(t1) {}
  point3 centre_at(double time) const override {
    return center0 + (time - time0) / (time1 - time0) * (center1 - center0);
  }
  point3 center0, center1;
  double time0, time1;
};
class flip_face : public hittable {
 public:
  flip_face(shared_ptr<hittable> p) : ptr(p) {}
  bool hit(const ray& r, RANGE, hit_record& rec) const override {
    if (!ptr->hit(r, LOW, HIGH, rec)) return false;
    rec.front_face = !rec.front_face;
    return true;
  }
  shared_ptr<hittable> ptr;
};
#endif
#if EDITION == 4
inline shared_ptr<hittable_list> box(const point3& a, const point3& b, shared_ptr<material> m) {
  auto sides = make_shared<hittable_list>();
  const vec3 x(b[0] - a[0], 0, 0), y(0, b[1] - a[1], 0), z(0, 0, b[2] - a[2]);
  for (const auto& [q, u, v] : {std::make_tuple(a, x, y), std::make_tuple(a + z, x, y), std::make_tuple(a, y, z),
                                std::make_tuple(a + x, y, z), std::make_tuple(a, x, z), std::make_tuple(a + y, x, z)})
    sides->add(make_shared<quad>(q, u, v, m));
  return sides;
}
class texture {
 public:
  virtual ~texture() = default;
  virtual color value(double u, double v, const point3& p) const = 0;
};
class solid_color : public texture {
 public:
  solid_color(const color& c) : albedo(c) {}
  color value(double, double, const point3&) const override { return albedo; }

 private:
  color albedo;
};
class checker_texture : public texture {
 public:
  checker_texture(double scale, const color& a, const color& b)
      : inv_scale(1 / scale), even(make_shared<solid_color>(a)), odd(make_shared<solid_color>(b)) {}
  color value(double u, double v, const point3& p) const override {
    int sum = 0;
    for (int k = 0; k < 3; ++k) sum += static_cast<int>(std::floor(inv_scale * p[k]));
    return (sum % 2 == 0 ? even : odd)->value(u, v, p);
  }

 private:
  double inv_scale;
  shared_ptr<texture> even, odd;
};
#endif

class material {
 public:
  virtual ~material() = default;
#if EDITION > 1
  virtual color emitted(double, double, const point3&) const { return color(); }
#endif
  virtual bool scatter(const ray&, const hit_record&, vec3&, ray&) const { return false; }
};
class lambertian : public material {
 public:
#if EDITION == 4
  lambertian(const vec3& a) : tex(make_shared<solid_color>(a)) {}
  lambertian(shared_ptr<texture> t) : tex(t) {}
  shared_ptr<texture> tex;
  color colour(const hit_record& rec) const { return tex->value(rec.u, rec.v, rec.p); }
#else
  lambertian(const vec3& a) : albedo(a) {}
  vec3 albedo;
  vec3 colour(const hit_record&) const { return albedo; }
#endif
  bool scatter(const ray& in, const hit_record& rec, vec3& part, ray& out) const override {
    part = colour(rec);
    out = ray(rec.p, rec.normal + unit_vector(random_in_ball()), in.time());
    return true;
  }
};
class metal : public material {
 public:
  metal(const vec3& a, double f) : albedo(a), fuzz(f < 1 ? f : 1) {}
  bool scatter(const ray& in, const hit_record& rec, vec3& part, ray& out) const override {
    part = albedo;
    out = ray(rec.p, reflect(unit_vector(in.direction()), rec.normal) + fuzz * random_in_ball(), in.time());
    return dot(out.direction(), rec.normal) > 0;
  }

 private:
  vec3 albedo;
  double fuzz;
};
class dielectric : public material {
 public:
  dielectric(double index) : ref_idx(index) {}
  bool scatter(const ray& in, const hit_record& rec, vec3& part, ray& out) const override {
    part = vec3(1, 1, 1);
    const vec3 to = unit_vector(in.direction()), n = dot(to, rec.normal) < 0 ? rec.normal : -1 * rec.normal;
#if EDITION == 1
    const bool outside = dot(to, rec.normal) < 0;
#else
    const bool outside = rec.front_face;
#endif
    const double ratio = outside ? 1 / ref_idx : ref_idx, cosine = -dot(to, n),
                 sine2 = ratio * ratio * (1 - cosine * cosine);
    const double r0 = std::pow((1 - ratio) / (1 + ratio), 2);
    const bool mirrors = sine2 > 1 || r0 + (1 - r0) * std::pow(1 - cosine, 5) > random_double();
    out = ray(rec.p, mirrors ? reflect(to, n) : ratio * to + (ratio * cosine - std::sqrt(1 - sine2)) * n, in.time());
    return true;
  }

 private:
  double ref_idx;
};
#if EDITION > 1
class diffuse_light : public material {
 public:
  diffuse_light(const color& c) : shine(c) {}
  color emitted(double, double, const point3&) const override { return shine; }

 private:
  color shine;
};
#endif
#if EDITION == 4
class isotropic : public material {
 public:
  isotropic(const color& c) : albedo(c) {}
  bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override {
    part = albedo;
    out = ray(rec.p, unit_vector(random_in_ball()), in.time());
    return true;
  }

 private:
  color albedo;
};
class constant_medium : public hittable {
 public:
  constant_medium(shared_ptr<hittable> b, double d, const color& c)
      : boundary(b), neg_inv_density(-1 / d), phase_function(make_shared<isotropic>(c)) {}
  bool hit(const ray& r, interval range, hit_record& rec) const override {
    hit_record in, out;
    if (!boundary->hit(r, interval(-infinity, infinity), in) ||
        !boundary->hit(r, interval(in.t + 0.0001, infinity), out))
      return false;
    const double from = std::fmax(in.t, range.min), to = std::fmin(out.t, range.max);
    const double t = std::fmax(from, 0) + neg_inv_density * std::log(random_double()) / r.direction().length();
    if (from >= to || t > to) return false;
    rec.met(r, t, vec3(1, 0, 0), phase_function);
    return true;
  }

 private:
  shared_ptr<hittable> boundary;
  double neg_inv_density;
  shared_ptr<material> phase_function;
};
class camera {
 public:
  double aspect_ratio = 1, vfov = 90, defocus_angle = 0, focus_dist = 10;
  int image_width = 100, samples_per_pixel = 10, max_depth = 10;
  color background{1, 1, 1};
  point3 lookfrom, lookat = point3(0, 0, -1);
  vec3 vup = vec3(0, 1, 0);
  void render(const hittable& world) {
    image_height = static_cast<int>(image_width / aspect_ratio);
    std::cout << "P3\n" << image_width << ' ' << image_height << "\n255\n";
    for (int j = 0; j < image_height; ++j)
      for (int i = 0; i < image_width; ++i) {
        color sum;
        for (int s = 0; s < samples_per_pixel; ++s) sum += ray_color(get_ray(i, j), max_depth, world);
        for (int k = 0; k < 3; ++k)
          std::cout << static_cast<int>(256 * std::fmin(std::sqrt(sum[k] / samples_per_pixel), 0.999)) << ' ';
        std::cout << '\n';
      }
  }

 private:
  int image_height = 0;
  ray get_ray(int i, int j) const {
    const vec3 w = unit_vector(lookfrom - lookat), u = unit_vector(cross(vup, w)), v = cross(w, u);
    const double size = 2 * std::tan(vfov * pi / 360) * focus_dist / image_height,
                 lens = focus_dist * std::tan(defocus_angle * pi / 360);
    vec3 p = random_in_ball();
    while (p[0] * p[0] + p[1] * p[1] > 1) p = random_in_ball();
    const point3 eye = lookfrom + lens * p[0] * u + lens * p[1] * v;
    const point3 seen = lookfrom - focus_dist * w + size * (i + random_double() - image_width / 2.0) * u -
                        size * (j + random_double() - image_height / 2.0) * v;
    return ray(eye, seen - eye, random_double());
  }
#ifndef SKY
#define SKY background
#endif
#ifndef LOWEST
#define LOWEST 0.001
#endif
  color ray_color(const ray& r, int depth, const hittable& world) const {
    if (depth <= 0) return color();
    hit_record rec;
    if (!world.hit(r, interval(LOWEST, infinity), rec)) return SKY;
    ray out;
    color part, shine = rec.mat->emitted(rec.u, rec.v, rec.p);
    return rec.mat->scatter(r, rec, part, out) ? shine + part * ray_color(out, depth - 1, world) : shine;
  }
};
#else
class camera {
 public:
  camera(point3 from, point3 at, vec3 vup, double vfov, double aspect, double aperture, double focus, double t0 = 0,
         double t1 = 0)
      : origin(from), lens_radius(aperture / 2), time0(t0), time1(t1) {
    const vec3 w = unit_vector(from - at);
    u = unit_vector(cross(vup, w));
    v = cross(w, u);
    vertical = 2 * std::tan(vfov * pi / 360) * focus * v;
    horizontal = aspect * vertical.length() * u;
    lower_left_corner = origin - 0.5 * horizontal - 0.5 * vertical - focus * w;
  }
  ray get_ray(double s, double t) const {
    vec3 p = random_in_ball();
    while (p[0] * p[0] + p[1] * p[1] > 1) p = random_in_ball();
    const vec3 offset = lens_radius * p[0] * u + lens_radius * p[1] * v;
    return ray(origin + offset, lower_left_corner + s * horizontal + t * vertical - origin - offset,
               random_double(time0, time1));
  }

 private:
  point3 origin, lower_left_corner;
  vec3 horizontal, vertical, u, v;
  double lens_radius, time0, time1;
};
inline void write_color(std::ostream& out, const vec3& sum, int samples) {
  for (int k = 0; k < 3; ++k) out << static_cast<int>(256 * std::fmin(std::sqrt(sum[k] / samples), 0.999)) << ' ';
  out << '\n';
}
#endif
