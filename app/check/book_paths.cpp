#include "app/check/book_paths.h"

#include "core/base/math.h"
#include "core/base/sampling.h"
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

constexpr int paths_per_job = 4096;
constexpr double at_once = 1e-6;         // a distance, of a ray that meets the surface that it leaves
constexpr float min_throughput = 1e-4f;  // what carries less is not followed: far below what 8 bits show

struct BookPath {
  Ray<float> ray;
  float length;  ///< that the direction has in the books' program, which does not make all of them unit vectors
  Vec3f throughput;
  Sampler<float> sampler;
  std::size_t sample;  ///< place of its result
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
  switch (rule) {
    case DiffuseRule::cosine:
      break;
    case DiffuseRule::filled_sphere:
      return unit_of(point_at(in.facing, std::cbrt(in.sampler.next_1d(dimension::radius)), in.unit_vector), in);
    case DiffuseRule::hemisphere:
      return {dot(in.unit_vector, in.facing) < 0 ? -in.unit_vector : in.unit_vector};
  }
  return unit_of(in.facing + in.unit_vector, in);
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

/// The ray on which a sample starts, with the length that its direction has there.
BookPath begin(const SceneView& s, const BookRules& rules, int x, int y, int index, std::size_t place) {
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
  p.sample = place;
  p.exact = to_double(p.ray.origin);
  return p;
}

/// Follows paths until all have ended.
class BookPaths {
 public:
  BookPaths(const SceneView& scene, const Kernels& kernels, const BookRules& rules, std::vector<BookSample>& samples)
      : s_(scene), kernels_(kernels), rules_(rules), samples_(samples) {}

  void follow(std::vector<BookPath>& paths) {
    std::vector<TraceRay> rays;
    std::vector<TraceHit> hits;
    while (!paths.empty()) {
      rays.clear();
      for (const BookPath& p : paths) rays.push_back({p.ray.origin, p.ray.direction, p.ray.time, p.ray.from});
      hits.resize(paths.size());
      kernels_.trace(s_, rays.data(), hits.data(), static_cast<int>(rays.size()), false);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < paths.size(); ++i)
        if (step(paths[i], hits[i])) paths[kept++] = paths[i];
      paths.resize(kept);
    }
  }

 private:
  /// Takes a path to where its ray ends. Whether it goes on.
  bool step(BookPath& p, TraceHit hit) {
    if (p.at_surface) hit = {0, p.ray.from >> 2};
    float nearest = hit.element < 0 ? std::numeric_limits<float>::infinity() : hit.t;
    MediumEvent<float> medium = no_event<float>();
    if (s_.features.media && !p.at_surface) {
      fly_through_media(s_, p.ray, p.sampler, true, nearest, medium);
      // The books' black smoke ends paths at random, so that samples vary more than with this as their weight.
      if (p.sampler.next_1d(dimension::roulette) >= transmitted_by_absorbers(s_, p.ray, p.sampler, nearest, true))
        return false;
    }
    const bool goes_on = medium.happens     ? meet_medium(p, medium)
                         : hit.element >= 0 ? meet_surface(p, hit)
                                            : find_light(p, background(p.ray.direction));
    p.sampler.next_event();
    ++p.depth;
    return goes_on && max_component(p.throughput) > min_throughput;
  }

  Vec3f background(Vec3f direction) const {
    return s_.has_sky() ? sky_towards(s_.sky, direction).radiance : background_radiance(s_.background, direction);
  }

  bool find_light(const BookPath& p, Vec3f radiance) {
    const Vec3f light = p.throughput * radiance;
    if (std::isfinite(light.x + light.y + light.z)) samples_[p.sample] = {light, p.depth};
    return false;
  }

  bool meet_medium(BookPath& p, const MediumEvent<float>& event) {
    if (p.depth >= s_.max_depth) return false;
    Vec3f albedo = event.albedo;
    if (s_.features.textures) albedo = textured<float>(s_, albedo, event.texture, true, event.point, nullptr);
    const Pair<float> u = p.sampler.next_2d(dimension::direction);
    const Vec3f out = scatter_in_medium(event.g, p.ray.direction, on_sphere(u), u);
    p.throughput = p.throughput * albedo;
    p.ray = {event.point, out, rules_.time == TimeRule::lost ? 0 : p.ray.time, event.from};
    p.length = 1, p.at_surface = false, p.exact = to_double(event.point);
    return true;
  }

  bool meet_surface(BookPath& p, const TraceHit& hit) {
    const SurfacePoint<float> at = surface_at(s_, p.ray, hit.t, hit.element);
    const Vec3f colour = surface_colour(s_, at, true);
    const std::int32_t kind = s_.materials.kind[at.material];
    if (has_trait<&BsdfTraits::emits>(kind)) return find_light(p, colour);
    if (p.depth >= s_.max_depth) return false;
    const float towards = dot(p.ray.direction, at.normal);
    const bool exiting = towards > 0;
    const Incident<float> in{p.ray.direction,
                             at.normal,
                             exiting ? -at.normal : at.normal,
                             std::min(std::abs(towards), 1.0f),
                             exiting,
                             on_sphere(p.sampler.next_2d(dimension::direction)),
                             rules_.schlick,
                             p.sampler};
    const BookDirection out = scatter(p, at, kind, in);
    if (out.absorbed) return false;
    const bool inside = (exiting != at.inverted) != out.transmitted;
    const bool matt = has_trait<&BsdfTraits::diffuse>(kind);
    const bool loses_time =
        p.ray.time != 0 && (rules_.time == TimeRule::lost || (rules_.time == TimeRule::lost_by_matt && matt));
    if (rules_.meets_itself) {
      const auto distance = [&](Vec3d direction) {
        return book_distance(s_, at.element, at.point, p.exact, direction, p.ray.time);
      };
      const Vec3d direction = static_cast<double>(p.length) * to_double(p.ray.direction);
      p.exact = p.exact + distance(direction) * direction;
      const double again = distance(static_cast<double>(out.length) * to_double(out.direction));
      p.at_surface = again > 0 && again < at_once;
    }
    p.throughput = p.throughput * colour;
    p.ray = {at.point, out.direction, loses_time ? 0 : p.ray.time, 4 * at.element + (inside ? 1 : 0)};
    if (loses_time && moves(at.element)) p.ray.from = from_nowhere;  // the ball has jumped, and can be met again
    p.length = out.length;
    return true;
  }

  bool moves(std::int32_t element) const {
    return s_.features.moving_spheres && !(s_.elements.move[element] == Vec3f{});
  }

  BookDirection scatter(const BookPath& p, const SurfacePoint<float>& at, std::int32_t kind,
                        const Incident<float>& in) {
    using List = MaterialKinds<double>;
    switch (kind) {
      case place_in<Metal<double>, List>:
        return scatter_metal(load_material<Metal<float>, float>(s_, at.material), rules_, p.length, in);
      case place_in<Dielectric<double>, List>:
        return scatter_glass(load_material<Dielectric<float>, float>(s_, at.material), rules_, in);
      default:
        return scatter_matt(rules_.diffuse, in);
    }
  }

  const SceneView& s_;
  const Kernels& kernels_;
  const BookRules& rules_;
  std::vector<BookSample>& samples_;
};

}  // namespace

BookProgram plain_program(const Scene& scene) {
  BookProgram program{scene, {}};
  program.rules.schlick = scene.render.fresnel == FresnelKind::schlick;
  return program;
}

Lattice lattice_of(int width, int height) {
  Lattice lattice{width, height, 1};
  while (lattice.pixels() > 100'000) ++lattice.step;
  return lattice;
}

std::vector<BookSample> book_samples(const BookProgram& program, const Lattice& lattice, int count, ThreadPool& threads,
                                     const std::function<bool()>& go_on) {
  SceneView scene{compile(program.scene)};
  if (program.columns) program.columns(scene);
  const Kernels kernels = *choose_kernels("");
  std::vector<BookSample> samples(lattice.pixels() * static_cast<std::size_t>(count));
  const int pixels = static_cast<int>(lattice.pixels()), pixels_per_job = std::max(1, paths_per_job / count);
  std::atomic<bool> give_up = !go_on();
  const auto follow = [&](int job) {
    if (give_up) return;
    std::vector<BookPath> paths;
    for (int pixel = job * pixels_per_job; pixel < std::min(pixels, (job + 1) * pixels_per_job); ++pixel) {
      const int x = pixel % lattice.columns() * lattice.step, y = pixel / lattice.columns() * lattice.step;
      for (int index = 0; index < count; ++index)
        paths.push_back(
            begin(scene, program.rules, x, y, index,
                  static_cast<std::size_t>(pixel) * static_cast<std::size_t>(count) + static_cast<std::size_t>(index)));
    }
    BookPaths(scene, kernels, program.rules, samples).follow(paths);
  };
  threads.for_each((pixels + pixels_per_job - 1) / pixels_per_job, follow, [&] { give_up = give_up || !go_on(); });
  if (give_up) samples.clear();
  return samples;
}

}  // namespace tyndall
