#include "tests/support/light_tracer.h"

#include "core/base/kinds.h"
#include "core/system/processors.h"
#include "tests/support/light_room.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace tyndall::test {
namespace {

/// A parcel of light on its way.
struct Particle {
  Vec3d at, direction, power;
  double time;
  int last = -1;  ///< the surface that it is on
};

class Tracer {
 public:
  explicit Tracer(const Scene& scene)
      : room_(scene), eye_(scene), camera_(scene.camera), max_depth_(scene.render.max_depth) {}

  std::vector<double> batch(std::uint64_t particles, SplitMix random) const {
    std::vector<double> picture(static_cast<std::size_t>(3 * eye_.width * eye_.height));
    const auto lamps = static_cast<double>(room_.lamps.size());
    for (std::uint64_t i = 0; i < particles; ++i) {
      Particle p = emit(room_.lamps[static_cast<std::size_t>(lamps * random())], random);
      p.power = lamps * p.power;
      follow(p, picture, random);
    }
    for (double& value : picture) value /= static_cast<double>(particles);
    return picture;
  }

  std::vector<char> joined() const {
    std::vector<char> mask;
    for (int y = 0; y < eye_.height; ++y)
      for (int x = 0; x < eye_.width; ++x) mask.push_back(shows_matt(x, y) ? 1 : 0);
    return mask;
  }

 private:
  bool shows_matt(int x, int y) const {
    constexpr int steps = 4;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j)
        for (int k = 0; k <= steps; ++k) {
          const double fraction = 1.0 / steps;
          const double time = camera_.shutter_open + k * fraction * (camera_.shutter_close - camera_.shutter_open);
          const RoomHit hit = room_.closest(eye_.eye, eye_.direction(x + i * fraction, y + j * fraction), time, -1);
          if (hit.surface >= 0 && !is_matt(hit.surface)) return false;
        }
    return true;
  }
  bool is_matt(int surface) const { return std::holds_alternative<Lambertian<>>(room_.kind(at(surface))); }
  const RoomSurface& at(int surface) const { return room_.surfaces[static_cast<std::size_t>(surface)]; }

  /// Half of the particles are sent in all directions, by the cosine, and half to the spheres of glass and metal, so
  /// that light by way of these is not rare.
  Particle emit(int lamp, SplitMix& random) const {
    const RoomSurface& surface = at(lamp);
    Particle p;
    p.time = camera_.shutter_open + random() * (camera_.shutter_close - camera_.shutter_open);
    p.last = lamp;
    Vec3d normal = surface.normal;
    double sides = 1;
    if (surface.round) {
      normal = on_unit_sphere(random);
      p.at = surface.center_at(p.time) + std::abs(surface.radius) * normal;
    } else {
      p.at = surface.corner + random() * surface.u + random() * surface.v;
      if (random() < 0.5) normal = -normal;
      sides = 2;
    }
    const std::vector<Cone> cones = cones_from(p.at, p.time);
    const double by_cosine_fraction = cones.empty() ? 1 : 0.5;
    if (random() < by_cosine_fraction) {
      p.direction = by_cosine(normal, random);
    } else {
      const Cone& cone = cones[static_cast<std::size_t>(random() * static_cast<double>(cones.size()))];
      p.direction = lean(cone.axis, random() * cone.versine, random());
    }
    const double cosine = std::max(dot(normal, p.direction), 0.0);
    double pdf = by_cosine_fraction * cosine / pi;
    for (const Cone& cone : cones)
      if (1 - dot(cone.axis, p.direction) < cone.versine)
        pdf += (1 - by_cosine_fraction) / (static_cast<double>(cones.size()) * 2 * pi * cone.versine);
    p.power = (surface.area() * sides * cosine / pdf) * room_.colour(surface, p.at, p.time);
    return p;
  }

  struct Cone {
    Vec3d axis;
    double versine;
  };
  std::vector<Cone> cones_from(Vec3d point, double time) const {
    std::vector<Cone> cones;
    for (const int ball : room_.balls) {
      const Vec3d direction = at(ball).center_at(time) - point;
      const double sine2 = at(ball).radius * at(ball).radius / dot(direction, direction);
      if (sine2 < 1) cones.push_back({normalize(direction), sine2 / (1 + std::sqrt(1 - sine2))});
    }
    return cones;
  }

  void follow(Particle p, std::vector<double>& picture, SplitMix& random) const {
    const double start = std::max({p.power.x, p.power.y, p.power.z});
    for (int events = 1; events <= max_depth_; ++events) {
      const double maximum = std::max({p.power.x, p.power.y, p.power.z}), survival = 4 * maximum / start;
      if (!(maximum > 0) || (survival < 1 && random() > survival)) return;
      if (survival < 1) p.power = (1 / survival) * p.power;
      RoomHit hit = room_.closest(p.at, p.direction, p.time, p.last);
      const int medium = room_.fly(p.at, p.direction, hit.t, random);
      if (medium < 0 && hit.surface < 0) return;
      p.at = p.at + hit.t * p.direction;
      if (medium >= 0)
        scatter_in_medium(p, room_.media[static_cast<std::size_t>(medium)], picture, random);
      else if (!meet(p, hit, picture, random))
        return;
    }
  }

  void scatter_in_medium(Particle& p, const PlacedVolume& fog, std::vector<double>& picture, SplitMix& random) const {
    p.power = p.power * room_.colour(fog, p.at);
    p.last = -1;
    join(
        p, [&](Vec3d to_eye) { return phase(fog.medium.g, dot(p.direction, to_eye)); }, picture);
    p.direction = lean(p.direction, 1 - phase_cosine(fog.medium.g, random()), random());
  }

  /// Whether the particle goes on.
  bool meet(Particle& p, const RoomHit& hit, std::vector<double>& picture, SplitMix& random) const {
    const RoomSurface& surface = at(hit.surface);
    const Vec3d normal = dot(hit.normal, p.direction) < 0 ? hit.normal : -hit.normal;
    p.last = hit.surface;
    return std::visit(
        Overloaded{[](const Light<>&) { return false; },
                   [&](const Lambertian<>&) {
                     p.power = p.power * room_.colour(surface, p.at, p.time);
                     join(
                         p, [&](Vec3d to_eye) { return std::max(dot(normal, to_eye), 0.0) / pi; }, picture);
                     p.direction = by_cosine(normal, random);
                     return true;
                   },
                   [&](const Metal<>& metal) {
                     p.power = p.power * room_.colour(surface, p.at, p.time);
                     return mirror(p, normal, metal.fuzz, random);
                   },
                   [&](const Dielectric<>& glass) {
                     const bool enters = dot(hit.normal, p.direction) < 0;
                     cross_glass(p, normal, enters ? glass.refractive_index : 1 / glass.refractive_index, random);
                     return true;
                   }},
        room_.kind(surface));
  }

  /// Reflects a particle at metal. The lobe has the same density both ways, and for paths from the camera that density
  /// includes the cosine on the light's side. A particle needs the cosine on the camera's side in its place: hence the
  /// ratio of the two.
  static bool mirror(Particle& p, Vec3d normal, double fuzz, SplitMix& random) {
    const double cos_in = -dot(p.direction, normal);
    p.direction = p.direction + (2 * cos_in) * normal;
    if (fuzz == 0) return true;
    p.direction = normalize(p.direction + (fuzz * std::cbrt(random())) * on_unit_sphere(random));
    const double cos_out = dot(p.direction, normal);
    p.power = (std::max(cos_out, 0.0) / cos_in) * p.power;
    return cos_out > 0;
  }

  /// Reflects or refracts a particle. index: that of the far side over that of the near side. Paths from the camera
  /// carry radiance across glass unchanged, although glass narrows or widens cones of light. So that both agree,
  /// particles are divided by the square of the index.
  static void cross_glass(Particle& p, Vec3d normal, double index, SplitMix& random) {
    const double cos_in = std::min(-dot(p.direction, normal), 1.0);
    if (random() < reflected_fraction(cos_in, index)) {
      p.direction = normalize(p.direction + (2 * cos_in) * normal);
      return;
    }
    const double cos_out = std::sqrt(1 - (1 - cos_in * cos_in) / (index * index));
    p.direction = normalize((1 / index) * (p.direction + cos_in * normal) - cos_out * normal);
    p.power = (1 / (index * index)) * p.power;
  }

  /// Adds what the camera sees of the light that scatters here. scattered: density into a direction, with the cosine.
  void join(const Particle& p, auto scattered, std::vector<double>& picture) const {
    const Vec3d direction = eye_.eye - p.at;
    const double distance = length(direction);
    const Vec3d to_eye = (1 / distance) * direction;
    const double cosine = dot(to_eye, eye_.back);
    if (cosine <= 0) return;
    const double x = (1 - dot(to_eye, eye_.right) / cosine / eye_.half_width) / 2 * eye_.width;
    const double y = (1 + dot(to_eye, eye_.up) / cosine / eye_.half_height) / 2 * eye_.height;
    if (!(x >= 0 && x < eye_.width && y >= 0 && y < eye_.height)) return;
    const double pdf = scattered(to_eye);
    if (pdf <= 0 || room_.closest(p.at, to_eye, p.time, p.last, distance).surface >= 0) return;
    const double pixel = 4 * eye_.half_width * eye_.half_height / (eye_.width * eye_.height);
    const double scale =
        pdf * room_.transmittance(p.at, to_eye, distance) / (distance * distance * pixel * cosine * cosine * cosine);
    double* rgb = &picture[static_cast<std::size_t>(3 * (static_cast<int>(y) * eye_.width + static_cast<int>(x)))];
    rgb[0] += scale * p.power.x, rgb[1] += scale * p.power.y, rgb[2] += scale * p.power.z;
  }

  LightRoom room_;
  Pinhole eye_;
  Camera camera_;
  int max_depth_;
};

}  // namespace

LightTraced trace_light(const Scene& scene, const LightTracing& how) {
  const Tracer tracer(scene);
  const auto count = static_cast<std::size_t>(how.batches);
  LightTraced out{scene.width, scene.height, std::vector<std::vector<double>>(count), tracer.joined()};
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      SplitMix random{how.seed * 0xd1342543de82ef95u + i * 0x2545f4914f6cdd1du};
      random(), random();
      out.batches[i] = tracer.batch(how.particles / count, random);
    }
  };
  std::vector<std::thread> threads;
  const int cores = thread_count(how.threads).count;
  for (int i = 1; i < cores; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return out;
}

}  // namespace tyndall::test
