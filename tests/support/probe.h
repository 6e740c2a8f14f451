#pragma once
#include "core/accuracy/error.h"
#include "core/film/groups.h"
#include "tests/support/prepared.h"
#include "tests/support/statistics.h"

/// Small scenes written as values, and radiance measured through the whole pipeline: compile, kernels, film.
namespace tyndall::test {

inline Material lambertian(double albedo) { return {"", Vec3d{albedo, albedo, albedo}, Lambertian<>{}}; }
inline Material metal(double albedo, double fuzz) { return {"", Vec3d{albedo, albedo, albedo}, Metal<>{fuzz}}; }
inline Material glass(double index) { return {"", Vec3d{0.5, 0.5, 0.5}, Dielectric<>{index}}; }
inline Material lamp(double radiance) { return {"", Vec3d{radiance, radiance, radiance}, Light<>{}}; }

inline Sphere<> sphere(Vec3d center, double radius) { return {center, radius, {}}; }

/// A white room without anything in it, seen by `random` samples along light paths alone.
inline Scene white_room() {
  Scene scene;
  scene.width = scene.height = 32;
  scene.background = Vec3d{1, 1, 1};
  scene.render.integrator = Integrator::path;
  scene.render.sampler = SamplerKind::random;
  return scene;
}

inline Scene dark_room() {
  Scene scene = white_room();
  scene.background = Vec3d{0, 0, 0};
  return scene;
}

/// Adds a surface of a material of its own.
template <class Shape>
Object& add(Scene& scene, const Shape& shape, const Material& material, Transform transform = {}) {
  scene.materials.push_back(material);
  const int index = static_cast<int>(scene.materials.size()) - 1;
  scene.objects.push_back({"", Solid3d{shape, index}, std::move(transform)});
  return scene.objects.back();
}

template <class Boundary>
Object& add_medium(Scene& scene, const Boundary& boundary, Medium<> medium, double albedo, Transform transform = {}) {
  scene.objects.push_back({"", Volume{boundary, {}, medium, Vec3d{albedo, albedo, albedo}}, std::move(transform)});
  return scene.objects.back();
}

/// A floor, and a light above it.
inline Scene lit_floor(double light_radius, Vec3d light_center, double radiance) {
  Scene scene = dark_room();
  scene.render.integrator = Integrator::mis;
  add(scene, Quad<>{{-6, 0, -6}, {12, 0, 0}, {0, 0, 12}}, lambertian(0.73));
  add(scene, sphere(light_center, light_radius), lamp(radiance));
  return scene;
}

/// A dark room of lights of radiance 3, as mis sees them; made by light_object.
inline RenderScene lit(const std::vector<Object>& lamps) {
  Scene scene = dark_room();
  scene.materials = {lamp(3)};
  scene.objects = lamps;
  scene.render.integrator = Integrator::mis;
  return compile(scene);
}
inline Object light_object(auto shape, Transform transform = {}) {
  return {"", Solid3d{shape, 0}, std::move(transform)};
}

/// Turns the camera into a probe: all its rays run from `from` towards `to`, within a hundred-thousandth of a degree.
inline void aim(Scene& scene, Vec3d from, Vec3d to) {
  const Vec3d up = std::abs(normalize(to - from).y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  scene.camera = {.look_from = from, .look_at = to, .vup = up, .vfov = 1e-5};
}

/// A white room with a ray of impact parameter `impact` on a sphere of radius `scale` around the origin.
inline Scene sphere_seen_at(double impact, double scale) {
  Scene scene = white_room();
  aim(scene, {impact * scale, 0, 5 * scale}, {impact * scale, 0, 0});
  return scene;
}

inline Film film_of(const Scene& scene, int spp, const std::string& isa = "") {
  return render(compile(scene), {.isa = isa, .spp = static_cast<std::uint32_t>(spp)}).film;
}

/// Mean red radiance over the picture; every group of pixels is a batch, as their samples may be computed together. No
/// sample may be rejected. The picture is made of whole blocks.
inline Estimate radiance_of(const Film& film) {
  CHECK(totals(film).rejected == 0);
  CHECK(film.width % block_width == 0);
  CHECK(film.height % block_height == 0);
  const auto red = [&](const FilmPixel& pixel) { return static_cast<double>(mean(film, pixel).x) / group_size; };
  return estimate(group_sums(film, film.region, red));
}

/// Mean over a picture whose pixels show different things. No sample may be rejected.
inline Estimate picture_mean(const Film& film) {
  CHECK(totals(film).rejected == 0);
  const FilmMean found = film_mean(film);
  return {found.mean, found.error};
}

/// The same from 16 seeds, by one integrator.
inline Estimate over_seeds(Scene scene, Integrator integrator, int spp) {
  scene.render.integrator = integrator;
  std::vector<double> means;
  for (scene.render.seed = 0; scene.render.seed < 16; ++scene.render.seed)
    means.push_back(picture_mean(film_of(scene, spp)).mean);
  return estimate(means);
}

/// Each pixel's mean in one channel.
inline std::vector<double> channel_of(const Film& film, float Vec3f::*channel = &Vec3f::x) {
  std::vector<double> values;
  for (const FilmPixel& pixel : film.pixels) values.push_back(static_cast<double>(mean(film, pixel).*channel));
  return values;
}

/// radiance_of() a scene in which no path may be cut.
inline Estimate radiance(const Scene& scene, int spp, const std::string& isa = "") {
  const Film film = film_of(scene, spp, isa);
  CHECK(totals(film).truncated == 0);
  return radiance_of(film);
}

/// What every sample of a picture is, if it is the same to the last bit; NaN if it is not.
inline double common_value(const Scene& scene, const std::string& isa = "") {
  const Film film = film_of(scene, 1, isa);
  CHECK(totals(film).truncated == 0);
  const Vec3f first = mean(film, film.pixels[0]);
  for (const FilmPixel& pixel : film.pixels)
    if (!(mean(film, pixel) == first)) return std::nan("");
  return static_cast<double>(first.x);
}

/// A sphere of a medium in a white room, seen whole: its pixels show different things.
inline Scene medium_sphere() {
  Scene scene = white_room();
  scene.width = scene.height = 16;
  scene.camera = {.look_from = {0, 0, 5}, .look_at = {0, 0, 0}, .vfov = 30};
  add_medium(scene, sphere({0, 0, 0}, 1), {2, 0.3}, 0.7);
  return scene;
}

}  // namespace tyndall::test
