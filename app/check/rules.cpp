#include "app/check/check.h"
#include "app/report/contents.h"
#include "core/base/math.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace tyndall {
namespace {

std::vector<Sphere<>*> spheres_of(Scene& scene) {
  std::vector<Sphere<>*> spheres;
  each_object(scene.objects, [&](Object& object) {
    auto* solid = std::get_if<Solid3d>(&object.kind);
    if (auto* sphere = solid ? std::get_if<Sphere<>>(&solid->shape) : nullptr) spheres.push_back(sphere);
  });
  return spheres;
}

/// The materials of a kind that objects have.
template <class Kind>
std::set<Material*> materials_of(Scene& scene) {
  std::set<Material*> found;
  each_object(scene.objects, [&](Object& object) {
    const auto* solid = std::get_if<Solid3d>(&object.kind);
    Material* material = solid ? &scene.materials[static_cast<std::size_t>(solid->material)] : nullptr;
    if (material && std::holds_alternative<Kind>(material->kind)) found.insert(material);
  });
  return found;
}

template <class Kind>
bool has_material(Scene& scene) {
  return !materials_of<Kind>(scene).empty();
}
bool is_fuzzy(const Material* metal) { return std::get<Metal<>>(metal->kind).fuzz > 0; }
bool has_fuzz(Scene& scene) { return std::ranges::any_of(materials_of<Metal<>>(scene), is_fuzzy); }
bool has_motion(Scene& scene) {
  const auto moves = [](const Sphere<>* sphere) {
    return sphere->center_end && !(*sphere->center_end == sphere->center);
  };
  return scene.camera.shutter_close > scene.camera.shutter_open && std::ranges::any_of(spheres_of(scene), moves);
}

template <class T, class Rule>
std::function<bool(BookProgram&)> rule(Rule BookRules::*member, T value, bool (*applies)(Scene&)) {
  return [=](BookProgram& program) {
    if (!applies(program.scene) || program.rules.*member == value) return false;
    program.rules.*member = value;
    return true;
  };
}

/// Changes the scene; what is the same afterwards has nothing that this would change.
template <class Change>
std::function<bool(BookProgram&)> edit(const Change& change) {
  return [=](BookProgram& program) {
    const Scene before = program.scene;
    change(program.scene);
    return !(program.scene == before);
  };
}

/// The books' sky with another weight: 0.5 · y + 0.5 becomes scale · that + offset.
std::function<bool(BookProgram&)> other_sky(double scale, double offset) {
  return edit([=](Scene& scene) {
    auto* sky = std::get_if<Gradient>(&scene.background);
    if (!sky) return;
    const Gradient right = *sky;
    const auto at = [&](double weight) { return right.bottom + weight * (right.top - right.bottom); };
    sky->bottom = at(offset), sky->top = at(scale + offset);
  });
}

/// Albedo 0: what is left of a colour that scatter() did not hand on.
template <class Kind>
void blacken(Scene& scene) {
  for (Material* material : materials_of<Kind>(scene)) material->colour = Vec3d{0, 0, 0};
}

void flip_radii(Scene& scene) {
  for (Sphere<>* sphere : spheres_of(scene)) sphere->radius = std::abs(sphere->radius);
}

/// Of refractive indices below `limit`. 1: only the air in a hollow ball.
std::function<bool(BookProgram&)> invert_indices(double limit) {
  return edit([=](Scene& scene) {
    for (Material* material : materials_of<Dielectric<>>(scene))
      if (double& index = std::get<Dielectric<>>(material->kind).refractive_index; index < limit) index = 1 / index;
  });
}

void remove_fuzz(Scene& scene) {
  for (Material* material : materials_of<Metal<>>(scene)) std::get<Metal<>>(material->kind).fuzz = 0;
}

void close_shutter(Scene& scene) {
  if (has_motion(scene)) scene.camera.shutter_close = scene.camera.shutter_open;
}
void sharpen(Scene& scene) { scene.camera.defocus_angle = 0; }
void widen_lens(Scene& scene) {
  double& angle = scene.camera.defocus_angle;
  if (angle > 0) angle = 360 / pi * std::atan(2 * std::tan(angle * pi / 360));
}
void light_sky(Scene& scene) {
  if (scene.background == Background(Vec3d{})) scene.background = Gradient{};
}
void invert_checkers(Scene& scene) {
  for (Texture& texture : scene.textures)
    if (auto* checker = std::get_if<Checker<>>(&texture.kind)) checker->scale = 1 / checker->scale;
}

/// A cross product in one of whose components a plus stands for the minus.
Vec3f mistyped_cross(Vec3f a, Vec3f b, int component) {
  Vec3f c = cross(a, b);
  if (component == 0) c.x = a.y * b.z + a.z * b.y;
  if (component == 1) c.y = a.z * b.x + a.x * b.z;
  if (component == 2) c.z = a.x * b.y + a.y * b.x;
  return c;
}

/// The camera's axes as the books compute them: u from vup and w, which points backwards, v from w and u.
std::function<bool(BookProgram&)> mistyped_camera(int component) {
  return [=](BookProgram& program) {
    program.columns = [component, vup = to_float(program.scene.camera.vup)](RenderScene& scene) {
      CameraColumns& c = scene.camera;
      const Vec3f w = -c.axis;
      const Vec3f u = normalize(mistyped_cross(vup, w, component)), v = mistyped_cross(w, u, component);
      const float focus = dot(c.corner, c.axis), lens = length(c.lens_u);
      c.du = length(c.du) * u, c.dv = -length(c.dv) * v;
      c.corner = focus * c.axis - 0.5f * static_cast<float>(scene.width) * c.du -
                 0.5f * static_cast<float>(scene.height) * c.dv;
      c.lens_u = lens * u, c.lens_v = lens * v;
    };
    return true;
  };
}

bool always(Scene&) { return true; }

}  // namespace

std::vector<Difference> usual_choices() {
  return {
      {"schlick", "glass by Schlick's rule", rule(&BookRules::schlick, true, has_material<Dielectric<>>)},
      {"fresnel", "glass by Fresnel's equations", rule(&BookRules::schlick, false, has_material<Dielectric<>>)},
      {"fuzz-sphere", "fuzz on the sphere, as in edition 4", rule(&BookRules::fuzz, FuzzRule::sphere, has_fuzz)},
      {"short-frame", "pixels divided by width - 1 and height - 1, as in editions 2 and 3",
       rule(&BookRules::short_frame, true, always)},
      {"diffuse-ball", "matt surfaces by a point in the ball, as in edition 1",
       rule(&BookRules::diffuse, DiffuseRule::filled_sphere, has_material<Lambertian<>>)},
  };
}

Difference mistake_of(const Reading& r) {
  const std::tuple<bool, const char*, const char*> parts[] = {
      {r.upside_down && !r.mirrored, "upside-down", "the picture is upside down"},
      {!r.upside_down && r.mirrored, "mirrored", "the picture is mirrored, left and right"},
      {r.upside_down && r.mirrored, "upside-down+mirrored", "the picture is turned by 180 degrees"},
      {r.swapped, "red-blue", "red and blue have changed places"},
      {r.curve == TransferCurve::none, "no-gamma", "light is written without gamma"},
      {r.curve == TransferCurve::gamma2_twice, "gamma-twice", "gamma is applied twice"}};
  std::vector<std::string> names, words;
  for (const auto& [wrong, name, said] : parts)
    if (wrong) names.emplace_back(name), words.emplace_back(said);
  return {joined(names, "+"), joined(words, ", and "), [](BookProgram&) { return true; }, 0, r};
}

Difference shorter_paths(int depth) {
  const auto end = edit([depth](Scene& scene) { scene.render.max_depth = depth; });
  if (depth == 0)
    return {"attenuation-lost",
            "what is hit sends on no light: attenuation is passed by value, or paths end at the first hit", end};
  return {fmt::format("depth-{}", depth),
          fmt::format("paths end too early, after {} scattering{}", depth, depth == 1 ? "" : "s"), end};
}

std::vector<Difference> usual_mistakes() {
  return {
      {"hemisphere", "matt surfaces scatter evenly over the hemisphere, not by the cosine",
       rule(&BookRules::diffuse, DiffuseRule::hemisphere, has_material<Lambertian<>>)},
      {"schlick-always-1", "glass reflects everything, as if Schlick's term were always 1",
       rule(&BookRules::glass, GlassRule::reflects_all, has_material<Dielectric<>>)},
      {"no-schlick", "glass reflects nothing that it can refract: there is no Schlick term",
       rule(&BookRules::glass, GlassRule::reflects_none, has_material<Dielectric<>>)},
      {"inverted-index", "the ratio of the refractive indices is upside down", invert_indices(1e300)},
      {"one-sided-index", "rays that leave glass are refracted by the ratio of those that enter it",
       rule(&BookRules::glass, GlassRule::enters_only, has_material<Dielectric<>>)},
      {"positive-radius", "the inner ball of hollow glass has lost the minus of its radius", edit(flip_radii)},
      {"bubble-index", "the air in hollow glass has the refractive index of glass", invert_indices(1)},
      {"long-mirror", "the mirror direction is not made a unit vector before fuzz is added",
       rule(&BookRules::long_mirror, true, has_fuzz)},
      {"no-fuzz", "metal has no fuzz", edit(remove_fuzz)},
      {"sky-brackets", "the sky's weight is 0.5 * y + 1.0 where 0.5 * (y + 1.0) is meant", other_sky(1, 0.5)},
      {"sky-half", "the sky's weight is 0.5 * y where 0.5 * (y + 1.0) is meant", other_sky(1, -0.5)},
      {"sky-upside-down", "the sky's colours have changed places", other_sky(-1, 1)},
      {"sky-left-in", "the blue sky shines where the background is black", edit(light_sky)},
      {"time-lost", "scattered rays lose their time", rule(&BookRules::time, TimeRule::lost, has_motion)},
      {"time-lost-matt", "rays that matt surfaces scatter lose their time",
       rule(&BookRules::time, TimeRule::lost_by_matt, has_motion)},
      {"no-motion", "camera rays have no time, so that nothing moves", edit(close_shutter)},
      {"no-defocus", "nothing is out of focus", edit(sharpen)},
      {"wide-lens", "the lens is twice as wide: its diameter is taken for the radius", edit(widen_lens)},
      {"shadow-acne", "rays meet the surface that they leave: t has no lower bound such as 0.001",
       rule(&BookRules::meets_itself, true, always)},
      {"matt-black", "matt surfaces are black: their attenuation is lost, as where it is passed by value",
       edit(blacken<Lambertian<>>)},
      {"metal-black", "metal is black: its attenuation is lost, as where it is passed by value",
       edit(blacken<Metal<>>)},
      {"glass-black", "glass is black: its attenuation is lost, as where it is passed by value",
       rule(&BookRules::glass, GlassRule::black, has_material<Dielectric<>>)},
      {"checker-scale", "checkers are as large as their inverse scale", edit(invert_checkers)},
      {"cross-x", "the first component of cross() has a wrong sign", mistyped_camera(0)},
      {"cross-y", "the second component of cross() has a wrong sign", mistyped_camera(1)},
      {"cross-z", "the third component of cross() has a wrong sign", mistyped_camera(2)},
  };
}

}  // namespace tyndall
