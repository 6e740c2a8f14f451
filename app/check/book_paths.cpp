#include "app/check/book_paths.h"

#include "core/base/math.h"
#include "core/base/sampling.h"
#include "core/base/thread_pool.h"
#include "core/compile/compile.h"
#include "core/materials/materials.h"
#include "core/targets/kernels.h"
#include "core/trace/camera.h"
#include "core/trace/flight.h"
#include "core/trace/shade.h"
#include "core/trace/sky.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace tyndall {
namespace {

constexpr std::size_t paths_per_job = 4096;
constexpr double at_once = 1e-6;         // a distance, of a ray that meets the surface that it leaves
constexpr float min_throughput = 1e-4f;  // what carries less is not followed: far below what 8 bits show

struct BookPath {
  Ray<float> ray;
  float length;  ///< that the direction has in the books' program, which does not make all of them unit vectors
  Vec3f throughput;
  Sampler<float> sampler;
  BookSample* sample;  ///< its result
  std::int32_t depth;  ///< scattering events so far
  bool at_surface;     ///< it meets the surface that it leaves at once, see BookRules::meets_itself
  Vec3d exact;         ///< where the ray begins in the books' program; only with that rule
};

/// Scattered light as the books' programs have it: a direction that need not be a unit vector.
struct BookDirection {
  Vec3f direction;
  float length = 1;
  bool absorbed = false, transmitted = false;
};

BookDirection unit_of(Vec3f sum, const Incident<float>& in) {
  const float long_enough = length(sum);
  if (long_enough < 1e-6f) return {in.facing};
  return {1 / long_enough * sum, long_enough};
}

BookDirection scatter_matt(DiffuseRule rule, const Incident<float>& in) {
  if (rule == DiffuseRule::hemisphere) return {dot(in.unit_vector, in.facing) < 0 ? -in.unit_vector : in.unit_vector};
  const float part = rule == DiffuseRule::cosine ? 1 : std::cbrt(in.sampler.next_1d(dimension::radius));
  return unit_of(point_at(in.facing, part, in.unit_vector), in);
}

BookDirection scatter_metal(const Metal<float>& metal, const BookRules& rules, float length,
                            const Incident<float>& in) {
  const Vec3f mirror = reflect(in.direction, in.normal);
  const float part = rules.fuzz == FuzzRule::sphere ? 1 : std::cbrt(in.sampler.next_1d(dimension::radius));
  BookDirection out =
      unit_of(point_at(rules.long_mirror ? length * mirror : mirror, metal.fuzz * part, in.unit_vector), in);
  out.absorbed = dot(out.direction, in.facing) <= 0;
  return out;
}

BookDirection scatter_glass(const Dielectric<float>& glass, const BookRules& rules, Incident<float> in) {
  if (rules.glass == GlassRule::black) return {in.facing, 1, true};
  if (rules.glass == GlassRule::enters_only) in.exiting = false;
  Boundary<float> boundary = boundary_at(glass, in);
  if (rules.glass == GlassRule::reflects_all) boundary.reflected = 1;
  if (rules.glass == GlassRule::reflects_none) boundary.reflected = boundary.scaled_cos_out > 0 ? 0.0f : 1.0f;
  const bool reflects = in.sampler.next_1d(dimension::lobe) < boundary.reflected;
  const BsdfSample<float> out = leave_boundary(boundary, in, reflects);
  return {out.direction, 1, false, out.flags.transmitted};
}

/// The distance above 0 at which the books' programs find an element, in their arithmetic, whose rounding puts a point
/// of a surface a little outside or inside; negative: they do not find it. point: one of the element.
double book_distance(const SceneView& s, std::int32_t element, Vec3f point, Vec3d origin, Vec3d direction, float time) {
  const Vec3f at = s.elements.center_or_normal[element];
  if (s.elements.inverse_radius[element] == 0)
    return dot(to_double(at), to_double(point) - origin) / dot(to_double(at), direction);
  const Vec3f move = s.features.moving_spheres ? s.elements.move[element] : Vec3f{};
  const Vec3d to_center = to_double(at + time * move) - origin;
  const double radius = 1 / static_cast<double>(s.elements.inverse_radius[element]);
  const double a = dot(direction, direction), h = dot(direction, to_center);
  const double c = dot(to_center, to_center) - radius * radius, root = std::sqrt(std::max(0.0, h * h - a * c));
  return (h - root) / a > 0 ? (h - root) / a : (h + root) / a;
}

/// The ray on which a sample of a pixel starts, with the length that its direction has there.
BookPath begin(const SceneView& s, const BookRules& rules, int x, int y, std::size_t index, BookSample& sample) {
  BookPath p{};
  p.sampler = Sampler<float>::of(s.seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                 static_cast<std::uint32_t>(index), SamplerKind::random);
  const Pair<float> in_pixel = p.sampler.next_2d(dimension::pixel);
  float at_x = static_cast<float>(x) + in_pixel.x, at_y = static_cast<float>(y) + in_pixel.y;
  if (rules.short_frame) {  // rows count from the bottom there
    const auto w = static_cast<float>(s.width), h = static_cast<float>(s.height);
    at_x = s.width > 1 ? at_x * w / (w - 1) : at_x;
    at_y = s.height > 1 ? h * (at_y - 1) / (h - 1) : at_y;
  }
  p.ray = ray_through(s, at_x, at_y, p.sampler);
  p.length = length(point_at(point_at(s.camera.corner, at_x, s.camera.du), at_y, s.camera.dv));
  p.sampler.event = static_cast<std::uint32_t>(dimension::camera_count * golden_ratio);
  p.throughput = {1, 1, 1};
  p.sample = &sample;
  p.exact = to_double(p.ray.origin);
  return p;
}

/// Moves paths on in a scene.
struct BookTracer {
  const SceneView& s;
  const BookRules& rules;

  /// Takes a path to where its ray ends. Whether it goes on.
  bool step(BookPath& p, TraceHit hit) const {
    if (p.at_surface) hit = {0, p.ray.from >> 2};
    float nearest = hit.element < 0 ? std::numeric_limits<float>::infinity() : hit.t;
    MediumEvent<float> medium = no_event<float>();
    if (s.features.media && !p.at_surface) {
      fly_through_media(s, p.ray, p.sampler, true, nearest, medium);
      // The books' black smoke ends paths at random, so that samples vary more than with this as their weight.
      if (p.sampler.next_1d(dimension::roulette) >= transmitted_by_absorbers(s, p.ray, p.sampler, nearest, true))
        return false;
    }
    const bool goes_on = medium.happens ? meet_medium(p, medium) : hit.element >= 0 ? meet_surface(p, hit) : escape(p);
    p.sampler.next_event();
    ++p.depth;
    return goes_on && max_component(p.throughput) > min_throughput;
  }

  static bool find_light(const BookPath& p, Vec3f radiance) {
    const Vec3f light = p.throughput * radiance;
    if (std::isfinite(light.x + light.y + light.z)) *p.sample = {light, p.depth};
    return false;
  }

  bool escape(const BookPath& p) const {
    const Vec3f direction = p.ray.direction;
    return find_light(
        p, s.has_sky() ? sky_towards(s.sky, direction).radiance : background_radiance(s.background, direction));
  }

  bool meet_medium(BookPath& p, const MediumEvent<float>& event) const {
    if (p.depth >= s.max_depth) return false;
    const Pair<float> u = p.sampler.next_2d(dimension::direction);
    const Vec3f out = scatter_in_medium(event.g, p.ray.direction, on_sphere(u), u);
    p.throughput = p.throughput * textured<float>(s, event.albedo, event.texture, true, event.point, nullptr);
    p.ray = {event.point, out, rules.time == TimeRule::lost ? 0 : p.ray.time, event.from};
    p.length = 1, p.at_surface = false, p.exact = to_double(event.point);
    return true;
  }

  bool meet_surface(BookPath& p, const TraceHit& hit) const {
    const SurfacePoint<float> at = surface_at(s, p.ray, hit.t, hit.element);
    const Vec3f colour = surface_colour(s, at, true);
    const std::int32_t kind = s.materials.kind[at.material];
    if (has_trait<&BsdfTraits::emits>(kind)) return find_light(p, colour);
    if (p.depth >= s.max_depth) return false;
    const float towards = dot(p.ray.direction, at.normal);
    const bool exiting = towards > 0, matt = has_trait<&BsdfTraits::diffuse>(kind);
    const Incident<float> in{p.ray.direction,
                             at.normal,
                             exiting ? -at.normal : at.normal,
                             std::min(std::abs(towards), 1.0f),
                             exiting,
                             on_sphere(p.sampler.next_2d(dimension::direction)),
                             rules.schlick,
                             p.sampler};
    const BookDirection out =
        matt ? scatter_matt(rules.diffuse, in)
        : kind == place_in<Metal<double>, MaterialKinds<double>>
            ? scatter_metal(load_material<Metal<float>, float>(s, at.material), rules, p.length, in)
            : scatter_glass(load_material<Dielectric<float>, float>(s, at.material), rules, in);
    if (out.absorbed) return false;
    if (rules.meets_itself) {
      const auto distance = [&](Vec3d direction) {
        return book_distance(s, at.element, at.point, p.exact, direction, p.ray.time);
      };
      const Vec3d direction = static_cast<double>(p.length) * to_double(p.ray.direction);
      p.exact = p.exact + distance(direction) * direction;
      const double again = distance(static_cast<double>(out.length) * to_double(out.direction));
      p.at_surface = again > 0 && again < at_once;
    }
    const bool loses_time = p.ray.time != 0 && rules.time != TimeRule::kept && (rules.time == TimeRule::lost || matt);
    const bool jumps = loses_time && s.features.moving_spheres && !(s.elements.move[at.element] == Vec3f{});
    const bool inside = (exiting != at.inverted) != out.transmitted;
    p.throughput = p.throughput * colour;
    // A ball that has jumped can be met again.
    p.ray = {at.point, out.direction, loses_time ? 0 : p.ray.time, jumps ? from_nowhere : 4 * at.element + inside};
    p.length = out.length;
    return true;
  }
};

/// Follows paths until all have ended.
void follow(const BookTracer& tracer, const Kernels& kernels, std::vector<BookPath>& paths) {
  std::vector<TraceRay> rays;
  std::vector<TraceHit> hits;
  while (!paths.empty()) {
    rays.clear();
    for (const BookPath& p : paths) rays.push_back({p.ray.origin, p.ray.direction, p.ray.time, p.ray.from});
    hits.resize(paths.size());
    kernels.trace(tracer.s, rays.data(), hits.data(), static_cast<int>(rays.size()), false);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < paths.size(); ++i)
      if (tracer.step(paths[i], hits[i])) paths[kept++] = paths[i];
    paths.resize(kept);
  }
}

}  // namespace

Lattice lattice_of(int width, int height) {
  Lattice lattice{width, height, 1};
  while (lattice.pixels() > 100'000) ++lattice.step;
  return lattice;
}

std::vector<BookSample> book_samples(const BookProgram& program, const Lattice& lattice, int count,
                                     const std::function<bool()>& go_on) {
  SceneView scene{compile(program.scene)};
  if (program.columns) program.columns(scene);
  const Kernels kernels = *choose_kernels("");
  const auto each = static_cast<std::size_t>(count), columns = static_cast<std::size_t>(lattice.columns());
  std::vector<BookSample> samples(lattice.pixels() * each);
  const auto stops = [&go_on] { return go_on && !go_on(); };
  std::atomic<bool> give_up = stops();
  const auto follow_some = [&](int job) {
    const std::size_t first = paths_per_job * static_cast<std::size_t>(job);
    std::vector<BookPath> paths;
    for (std::size_t k = first; k < std::min(first + paths_per_job, samples.size()) && !give_up; ++k) {
      const auto row = static_cast<int>(k / each / columns), column = static_cast<int>(k / each % columns);
      paths.push_back(begin(scene, program.rules, column * lattice.step, row * lattice.step, k % each, samples[k]));
    }
    follow({scene, program.rules}, kernels, paths);
  };
  const auto jobs = static_cast<int>((samples.size() + paths_per_job - 1) / paths_per_job);
  ThreadPool(0).for_each(jobs, follow_some, [&] { give_up = give_up || stops(); });
  if (give_up) samples.clear();
  return samples;
}

}  // namespace tyndall
