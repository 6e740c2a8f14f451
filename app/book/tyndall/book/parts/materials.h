#pragma once
#include "textures.h"

/// The books' materials. Functions that trace are never asked of them: they are here for readers' own classes, and for
/// the loop in main() of editions 1 to 3, which asks those of the probe (loop.h).
struct hit_record;
struct scatter_record;

/// Densities of the third book, so that its main() compiles.
struct pdf {
  virtual ~pdf() = default;
  virtual double value(const vec3&) const { return 1; }
  virtual vec3 generate() const { return vec3(0, 1, 0); }
};
struct cosine_pdf : pdf {
  cosine_pdf(const vec3&) {}
};
struct sphere_pdf : pdf {};
struct mixture_pdf : pdf {
  template <class A, class B>
  mixture_pdf(const A&, const B&) {}
};
struct hittable_pdf : pdf {
  template <class A, class B>
  hittable_pdf(const A&, const B&) {}
};
using hitable_pdf = hittable_pdf;

struct material {
  virtual ~material() = default;
  virtual color emitted() const { return color(); }
  virtual color emitted(double, double, const point3&) const { return color(); }
  virtual color emitted(const ray&, const hit_record&, double, double, const point3&) const { return color(); }
  virtual bool scatter(const ray&, const hit_record&, color&, ray&) const { return false; }
  virtual bool scatter(const ray&, const hit_record&, vec3&, ray&) const { return false; }
  virtual bool scatter(const ray&, const hit_record&, scatter_record&) const { return false; }
  virtual bool scatter(const ray&, const hit_record&, color&, ray&, double&) const { return false; }
  virtual bool scatter(const ray&, const hit_record&, vec3&, ray&, float&) const { return false; }
  virtual double scattering_pdf(const ray&, const hit_record&, const ray&) const { return 0; }
  template <class... Arguments>  // as some readers spell them
  bool Scatter(const ray& in, Arguments&&... rest) const {
    return scatter(in, std::forward<Arguments>(rest)...);
  }
  template <class... Arguments>
  color Emitted(const Arguments&... arguments) const {
    return emitted(arguments...);
  }

  /// The material as the scene has it, a JSON object.
  virtual std::string tyndall_text(tyndall_book::scene_text&) const { tyndall_refuse(); }
  /// Its quoted name in the scene.
  std::string tyndall_name(tyndall_book::scene_text& out) const {
    return out.name_of(*this, out.materials, [&] { return tyndall_text(out); });
  }

 protected:
  [[noreturn]] void tyndall_refuse() const {
    tyndall_book::refuse(tyndall_book::class_of(*this) + ": Tyndall has no such material");
  }
  /// Refuses a class that the reader has derived from one of ours: it may scatter in another way.
  template <class T>
  void tyndall_only() const {
    if (!tyndall_book::of_class<T>(*this)) tyndall_refuse();
  }
  static std::string tyndall_colour(const shared_ptr<texture>& colour, tyndall_book::scene_text& out) {
    if (!colour) tyndall_book::refuse("a material has no texture");
    return colour->tyndall_text(out);
  }
};

struct lambertian : material {
  tyndall_book::ref<texture> tex, albedo;

  lambertian(const vec3& colour) : lambertian(make_shared<solid_color>(colour)) {}
  lambertian(tyndall_book::ref<texture> colour) : tex(colour), albedo(colour) {}
  std::string tyndall_text(tyndall_book::scene_text& out) const override {
    tyndall_only<lambertian>();
    return "{\"type\":\"lambertian\",\"albedo\":" + tyndall_colour(tex, out) + "}";
  }
};

struct metal : material {
  color albedo;
  double fuzz;

  metal(const vec3& colour, double blur = 0) : albedo(colour), fuzz(blur < 1 ? blur : 1) {}
  std::string tyndall_text(tyndall_book::scene_text&) const override {
    tyndall_only<metal>();
    return "{\"type\":\"metal\",\"albedo\":" + tyndall_book::triple(albedo) +
           ",\"fuzz\":" + tyndall_book::number(fuzz) + "}";
  }
};

struct dielectric : material {
  double refraction_index;

  dielectric(double index) : refraction_index(index) {}
  std::string tyndall_text(tyndall_book::scene_text&) const override {
    tyndall_only<dielectric>();
    return "{\"type\":\"dielectric\",\"refractive_index\":" + tyndall_book::number(refraction_index) + "}";
  }
};

struct diffuse_light : material {
  tyndall_book::ref<texture> tex, emit;

  diffuse_light(const vec3& colour) : diffuse_light(make_shared<solid_color>(colour)) {}
  diffuse_light(tyndall_book::ref<texture> colour) : tex(colour), emit(colour) {}
  std::string tyndall_text(tyndall_book::scene_text& out) const override {
    tyndall_only<diffuse_light>();
    out.has_lights = true;
    return "{\"type\":\"light\",\"radiance\":" + tyndall_colour(tex, out) + "}";
  }
};

/// What a medium scatters by; of its own on a surface it means nothing.
struct isotropic : material {
  tyndall_book::ref<texture> tex, albedo;

  isotropic(const vec3& colour) : isotropic(make_shared<solid_color>(colour)) {}
  isotropic(tyndall_book::ref<texture> colour) : tex(colour), albedo(colour) {}
  std::string tyndall_text(tyndall_book::scene_text&) const override {
    tyndall_book::refuse("isotropic on a surface: Tyndall has it in constant_medium only");
  }
};

struct hit_record {
  point3 p, point, position;  // and other names of readers' for the same
  vec3 normal;
  tyndall_book::ref<::material> mat, mat_ptr, matPtr, mat_pointer, material, material_ptr, materialPtr;
  TYNDALL_BOOK_HIT_MEMBERS
  double t = 0, u = 0, v = 0;
  bool front_face = true;

  void set_face_normal(const ray& r, const vec3& outward) {
    front_face = dot(r.direction(), outward) < 0;
    normal = front_face ? outward : -outward;
  }
};
using hitable_record = hit_record;

namespace tyndall_book {

/// A pointer to a density that main() of the first edition may delete.
struct pdf_pointer : ref<pdf> {
  using ref<pdf>::ref;
  operator pdf*() const { return nullptr; }
};

}  // namespace tyndall_book

struct scatter_record {
  color attenuation;
  tyndall_book::pdf_pointer pdf_ptr;
  bool skip_pdf = false, is_specular = false;
  ray skip_pdf_ray, specular_ray;
};
