// Written for Tyndall's tests in the style of the fourth edition: camera::render() at the end of main(). Before it, what
// the second book adds.
#include "rtweekend.h"

struct translate : hittable {
  shared_ptr<hittable> object;
  vec3 offset;
  translate(shared_ptr<hittable> what, const vec3& by) : object(what), offset(by) {}
  bool hit(const ray& r, interval range, hit_record& rec) const override {
    if (!object->hit(ray(r.origin() - offset, r.direction(), r.time()), range, rec)) return false;
    rec.p = rec.p + offset;
    return true;
  }
};
struct rotate_y : hittable {
  shared_ptr<hittable> object;
  double sin_theta, cos_theta;
  rotate_y(shared_ptr<hittable> what, double radians)
      : object(what), sin_theta(std::sin(radians)), cos_theta(std::cos(radians)) {}
  vec3 turned(const vec3& a, double s) const {
    return vec3(cos_theta * a[0] - s * a[2], a[1], s * a[0] + cos_theta * a[2]);
  }
  bool hit(const ray& r, interval range, hit_record& rec) const override {
    const ray within(turned(r.origin(), sin_theta), turned(r.direction(), sin_theta), r.time());
    if (!object->hit(within, range, rec)) return false;
    rec.p = turned(rec.p, -sin_theta);
    rec.normal = turned(rec.normal, -sin_theta);
    return true;
  }
};
inline shared_ptr<hittable_list> box(const point3& a, const point3& b, shared_ptr<material> m) {
  auto sides = make_shared<hittable_list>();
  const vec3 edges[] = {{b[0] - a[0], 0, 0}, {0, b[1] - a[1], 0}, {0, 0, b[2] - a[2]}};
  for (int k = 0; k < 3; ++k) {
    const vec3 &u = edges[k], &v = edges[(k + 1) % 3];
    sides->add(make_shared<quad>(a, u, v, m));
    sides->add(make_shared<quad>(b, -1 * u, -1 * v, m));
  }
  return sides;
}

struct texture {
  virtual ~texture() = default;
  virtual color value(double u, double v, const point3& p) const = 0;
};
struct solid_color : texture {
  color albedo;
  solid_color(const color& c) : albedo(c) {}
  color value(double, double, const point3&) const override { return albedo; }
};
struct checker_texture : texture {
  double inv_scale;
  shared_ptr<texture> even, odd;
  checker_texture(double scale, const color& a, const color& b)
      : inv_scale(1 / scale), even(make_shared<solid_color>(a)), odd(make_shared<solid_color>(b)) {}
  color value(double u, double v, const point3& p) const override {
    int sum = 0;
    for (int k = 0; k < 3; ++k) sum += static_cast<int>(std::floor(inv_scale * p[k]));
    return (sum % 2 == 0 ? even : odd)->value(u, v, p);
  }
};
struct textured : material {
  shared_ptr<texture> tex;
  textured(shared_ptr<texture> t) : tex(t) {}
  bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override {
    return lambertian(tex->value(rec.u, rec.v, rec.p)).scatter(in, rec, part, out);
  }
};

struct isotropic : lambertian {
  using lambertian::lambertian;
  bool scatter(const ray& in, const hit_record& rec, color& part, ray& out) const override {
    out = ray(rec.p, unit(in_ball()), in.time());
    part = albedo;
    return true;
  }
};
struct constant_medium : hittable {
  shared_ptr<hittable> boundary;
  double neg_inv_density;
  shared_ptr<material> phase_function;
  constant_medium(shared_ptr<hittable> b, double density, const color& c)
      : boundary(b), neg_inv_density(-1 / density), phase_function(make_shared<isotropic>(c)) {}
  bool hit(const ray& r, interval range, hit_record& rec) const override {
    hit_record in, out;
    if (!boundary->hit(r, interval(-infinity, infinity), in)) return false;
    if (!boundary->hit(r, interval(in.t + 0.0001, infinity), out)) return false;
    const double from = std::max({in.t, range.minimum, 0.0}), to = std::min(out.t, range.maximum);
    in.t = from + neg_inv_density * std::log(random_double()) / r.direction().length();
    if (from >= to || in.t > to) return false;
    rec = in;
    rec.p = r.at(rec.t);
    rec.mat = phase_function;
    return true;
  }
};

int main() {
  hittable_list room;
  auto tiles = make_shared<checker_texture>(0.5, color(0.1, 0.2, 0.3), color(0.8, 0.8, 0.8));
  room.add(box(point3(-4, -0.25, -4), point3(4, -0.25, 4), make_shared<textured>(tiles)));  // two quads, and four without an area
  room.add(make_shared<sphere>(point3(0, 1, 0), 1.0, make_shared<dielectric>(1.5)));
  room.add(make_shared<sphere>(point3(-2, 0.5, 1), point3(-2, 0.75, 1), 0.5, make_shared<metal>(color(0.9, 0.6, 0.2), 1.0)));

  shared_ptr<hittable> block = box(point3(1, 0, -1), point3(0, 2, 0), make_shared<lambertian>(color(0.5, 0.25, 0.125)));
  block = make_shared<rotate_y>(block, std::acos(-1.0) / 6);
  room.add(make_shared<translate>(block, vec3(2, 0, 0)));
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
  cam.defocus_angle = 0.5;
  cam.focus_dist = 8;
  cam.render(room);
}
