#include "core/guide/light_paths.h"

#include "core/compile/columns.h"
#include "core/trace/flight.h"
#include "core/trace/intersect.h"
#include "core/trace/lights.h"
#include "core/trace/shade.h"

#include <map>
#include <utility>

namespace tyndall {
namespace {

constexpr double min_reflected = 0.15;  // probability with which a light path is reflected, or refracted, at least
constexpr double move_step = 1e-3;      // of rays beside a path, in radii of their light
constexpr double focus = 1e-11;         // area of a wave front per steradian, over the flight's squared length
constexpr std::size_t min_kept = 10;    // landings of each sequence, where there are so many
constexpr double copy_spread = 2;       // copies are rotated by up to this times the distance between light paths

/// A random number in [0, 1): S. Vigna's splitmix64.
double next(std::uint64_t& random) {
  std::uint64_t z = random += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull, z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// z · axis, and r across it at a random angle: by the kernels' polynomials, not by the C library. Not unit.
Vec3d at_random_angle(Vec3d axis, double z, double r, std::uint64_t& random) {
  const SinCos<float> a = sin_cos_2pi(static_cast<float>(next(random)));
  const Basis<double> b = basis_around(axis);
  return z * axis + (r * static_cast<double>(a.cos)) * b.s + (r * static_cast<double>(a.sin)) * b.t;
}

Vec3d middle_of(const Lights& l, int light, double time) {
  if (l.kind[light] == Lights::sphere) return sphere_light_center(load_light<double>(l, light), time);
  return to_double(l.center[light]);
}

/// Draws a path from a light's middle towards a thing. Returns false if it leads along the light.
bool aim(LightPaths& paths, int light, int index, LightStart& start) {
  const CameraColumns& camera = paths.scene.camera;
  const Lights& l = paths.scene.lights;
  const Thing& thing = paths.things[static_cast<std::size_t>(index)];
  start.light = light, start.thing = index;
  start.time =
      static_cast<double>(camera.shutter_open) + next(paths.random) * static_cast<double>(camera.shutter_length);
  const Vec3d middle = middle_of(l, light, start.time);
  if (thing.is_sphere) {
    const Vec3d to_center = thing.center + start.time * thing.motion - middle;
    const double squared = dot(to_center, to_center), sine2 = thing.radius * thing.radius / squared;
    const double one_minus_cos = sine2 < 1 ? sine2 / (1 + std::sqrt(1 - sine2)) : 2;
    const double z = 1 - next(paths.random) * one_minus_cos, r = std::sqrt(std::max(1 - z * z, 0.0));
    const Vec3d axis = squared > 0 ? normalize(to_center) : Vec3d{0, 0, 1};
    start.direction = normalize(at_random_angle(axis, z, r, paths.random));
    start.solid_angle = 2 * pi * one_minus_cos;
  } else {
    const double a = next(paths.random), b = next(paths.random);
    const Vec3d to_thing = thing.corner + a * thing.u + b * thing.v - middle;
    const double squared = dot(to_thing, to_thing);
    if (!(squared > 0)) return false;
    start.direction = normalize(to_thing);
    start.solid_angle = std::min(std::abs(dot(start.direction, cross(thing.u, thing.v))) / squared, 4 * pi);
  }
  const double intensity = at(l.power, light);  // radiance times area
  const bool round = l.kind[light] == Lights::sphere;
  const double cosine = round ? 0.25 : std::abs(dot(start.direction, load_light<double>(l, light).normal));
  start.power = start.solid_angle * intensity * cosine;
  return start.power > 0;
}

/// A light path on its way.
class Flight {
 public:
  explicit Flight(LightPaths& paths) : paths_(paths), scene_(paths.scene) {}

  /// Follows a path, and keeps its landing. wanted: of a copy, the events of the landing; else null.
  void trace(const LightStart& start, const OrderedEvents<double>* wanted) {
    ++paths_.traced;
    begin(start, wanted);
    for (int depth = 0; depth <= max_guided_events; ++depth) {
      const Ray<double> ray = beam_.path();
      const Hit<double> hit = closest<double>(scene_, ray, true);
      if (hit.element < 0 || (depth == 0 && hit.element != thing_of_index(start.thing).element)) return;
      landing_.length += hit.t;
      if (scene_.has_media()) {  // by the kernels' polynomials
        const Ray<float> same{to_float(ray.origin), to_float(ray.direction), static_cast<float>(ray.time), ray.from};
        landing_.weight *= static_cast<double>(pass_media<float>(scene_, same, static_cast<float>(hit.t), true));
      }
      const std::int32_t kind = scene_.materials.kind[scene_.elements.material[hit.element]];
      if (has_trait<&BsdfTraits::diffuse>(scene_, kind)) return land(ray.origin + hit.t * ray.direction);
      const std::int32_t thing = paths_.thing_of[static_cast<std::size_t>(hit.element)];
      if (thing < 0 || !meet(thing, surface_at<double>(scene_, ray, hit.t, hit.element))) return;
    }
  }

 private:
  const Thing& thing_of_index(std::int32_t index) const { return paths_.things[static_cast<std::size_t>(index)]; }

  /// Behind the path itself there are two rays rotated at the light, and two moved on it.
  void begin(const LightStart& start, const OrderedEvents<double>* wanted) {
    const Lights& l = scene_.lights;
    const LightColumns<double> columns = load_light<double>(l, start.light);
    const bool round = l.kind[start.light] == Lights::sphere;
    const Vec3d d = start.direction, middle = middle_of(l, start.light, start.time);
    const double skip = round ? columns.length_u : 0;  // paths start on the light's surface
    wanted_ = wanted, left_ = wanted ? *wanted : OrderedEvents<double>::none();
    landing_ = {}, landing_.start = start, landing_.weight = start.power, landing_.length = skip;
    landing_.image = LightImage<double>{middle, {}, 0};
    const double longest = std::max(columns.length_u, columns.length_v);
    light_radius_ = round ? columns.length_u : longest * std::sqrt(1 / 3.0);  // of a disc as wide, roughly
    const bool behind = !round && dot(d, columns.normal) < 0;
    beam_.rays.clear(), beam_.fuzz.clear(), beam_.time = start.time;
    beam_.from = 4 * l.element[start.light] + static_cast<std::int32_t>(behind ? Side::inward : Side::outward);
    const Basis<double> b = basis_around(d);
    for (const Vec3d& direction : {d, normalize(d + angle_step * b.s), normalize(d + angle_step * b.t)})
      beam_.rays.push_back({middle + skip * direction, direction});
    for (const Vec3d& moved : {b.s, b.t})
      beam_.rays.push_back({middle + move_step * light_radius_ * moved + skip * d, d});
  }

  /// Decides whether glass reflects the flight, and weighs it. Returns false if no light goes that way.
  bool choose_side(double reflected, std::int32_t thing, bool& reflects) {
    double probability = reflected;
    if (reflected > 0 && reflected < 1) probability = std::clamp(reflected, min_reflected, 1 - min_reflected);
    if (wanted_) {  // the sum of the copies' weights is known, so that a factor of all does not matter
      if (left_.lowest_thing() != thing) return false;
      reflects = left_.lowest_reflects();
      probability = 0.5;
    } else {
      reflects = next(paths_.random) < probability;
    }
    const double fraction = reflects ? reflected : 1 - reflected;
    landing_.chance *= fraction, landing_.weight *= fraction / (reflects ? probability : 1 - probability);
    return fraction > 0;
  }

  /// Adds an event to the image of the light that those see who look back along the flight.
  void extend_image(const Thing& thing, const MetSurface& m) {
    std::optional<LightImage<double>>& image = landing_.image;
    if (!image) return;
    const auto mirrored = [&](Vec3d p) { return p - (2 * dot(p - thing.corner, m.normal)) * m.normal; };
    if (m.reflects && !thing.is_sphere)
      image->light = mirrored(image->light), image->sphere = mirrored(image->sphere);
    else if (m.reflects && !m.far && thing.motion == Vec3d{} && image->radius == 0)
      image->sphere = thing.center, image->radius = thing.radius;
    else
      image.reset();
  }

  /// Sends the flight on from a thing. Returns false if it ends there.
  bool meet(std::int32_t index, const SurfacePoint<double>& p) {
    if (landing_.count == max_guided_events) return false;
    const Thing& thing = thing_of_index(index);
    const Vec3d direction = beam_.rays[0].direction, center = thing.center + landing_.start.time * thing.motion;
    const bool exiting = dot(direction, p.normal) > 0, inside = exiting != p.inverted;
    MetSurface m{thing.is_sphere, p.inverted, inside, center, p.point, p.normal, length(p.point - center), 0, true};
    if (has_trait<&BsdfTraits::glossy>(scene_, scene_.materials.kind[p.material])) {
      landing_.weight *= static_cast<double>(max_component(scene_.materials.colour[p.material]));
    } else {
      Incident<double> in{};
      in.direction = direction, in.normal = p.normal, in.facing = exiting ? -p.normal : p.normal;
      in.cosine = std::min(std::abs(dot(direction, p.normal)), 1.0), in.exiting = exiting;
      const Boundary<double> boundary = boundary_any(scene_, p.material, in);
      m.index = exiting ? 1 / boundary.eta : boundary.eta;
      if (!choose_side(boundary.reflected, index, m.reflects)) return false;
    }
    extend_image(thing, m);
    beam_.from = 4 * p.element + (inside == m.reflects ? 1 : 0);
    object_ = landing_.count == 0 || object_ == thing.object ? thing.object : -1;
    landing_.next = append_event(landing_.next, index, m.reflects), ++landing_.count;
    left_ = left_.without_lowest();
    return beam_.pass(m, thing.fuzz);
  }

  /// Turns the flight into a landing, from how the rays beside it cross the plane across the flight there; unless exact
  /// paths cover its events, or they are not the wanted ones.
  void land(Vec3d point) {
    Landing& l = landing_;
    if (l.count == 0 || object_ >= 0 || !beam_.is_whole()) return;
    for (OrderedEvents<double> e = l.next; e.has_events(); e = e.without_lowest())
      l.events = append_event(l.events, e.lowest_thing(), e.lowest_reflects());
    if (wanted_ && !same_events(*wanted_, l.events)) return;
    const Changes rotated = beam_.changes(1, point, angle_step),
                  moved = beam_.changes(3, point, move_step * light_radius_);
    if (std::abs(determinant(rotated.place)) < focus * l.length * l.length) return;
    const Matrix front = rotated.direction * inverse(rotated.place);
    add_square(moved.direction - front * moved.place, light_radius_ * light_radius_ / 4, l.variance);
    for (std::size_t k = 0; k < beam_.fuzz.size(); ++k) {
      const Changes blurred = beam_.changes(5 + 2 * k, point, angle_step);
      add_square(blurred.direction - front * blurred.place, beam_.fuzz[k] * beam_.fuzz[k] / 5, l.variance);
    }
    l.point = point, l.flight = beam_.rays[0].direction, l.axis = basis_around(l.flight).s;
    l.curvature = {front.a, 0.5 * (front.b + front.c), front.d};
    if (std::isfinite(l.variance.xx + l.variance.yy + front.a + front.b + front.c + front.d))
      paths_.landings.push_back(l);
  }

  LightPaths& paths_;
  const SceneView& scene_;
  const OrderedEvents<double>* wanted_ = nullptr;
  OrderedEvents<double> left_{};  ///< wanted events to come, the next one in the lowest bits
  int object_ = -1;               ///< Thing::object, if all events are at the same one
  Beam beam_;
  double light_radius_ = 0;
  Landing landing_{};  ///< as far as it is known
};

/// The landings after one sequence of events.
struct SequenceLandings {
  std::vector<std::size_t> landed;  ///< their indices
  double power = 0;                 ///< sum of their weights
  double fraction = 0;              ///< root of the power, over the sum of these roots of all sequences
};

std::vector<SequenceLandings> by_events(const std::vector<Landing>& landings) {
  std::map<std::pair<std::int32_t, std::int32_t>, SequenceLandings> sequences;
  for (std::size_t i = 0; i < landings.size(); ++i) {
    SequenceLandings& sequence = sequences[{landings[i].events.high, landings[i].events.low}];
    sequence.landed.push_back(i), sequence.power += landings[i].weight;
  }
  std::vector<SequenceLandings> list;
  double roots = 0;
  for (auto& [events, sequence] : sequences) roots += std::sqrt(sequence.power), list.push_back(std::move(sequence));
  for (SequenceLandings& sequence : list) sequence.fraction = std::sqrt(sequence.power) / roots;
  return list;
}

/// Traces copies of paths that landed after the same events, and shares the sum of their weights with them.
void copy(LightPaths& paths, const std::vector<std::size_t>& landed, int count) {
  std::vector<Landing>& landings = paths.landings;
  const OrderedEvents<double> events = landings[landed[0]].events;
  const std::size_t before = landings.size();
  Flight flight(paths);
  for (int i = 0; i < count; ++i) {
    const auto chosen = static_cast<std::size_t>(next(paths.random) * static_cast<double>(landed.size()));
    LightStart start = landings[landed[chosen]].start;
    const double apart = std::sqrt(start.solid_angle / pi / std::max(paths.paths_of_pair, 1.0));
    const double r = copy_spread * apart * std::sqrt(next(paths.random));
    start.direction = normalize(at_random_angle(start.direction, 1, r, paths.random));
    flight.trace(start, &events);
  }
  double old_sum = 0, new_sum = 0;
  for (const std::size_t i : landed) old_sum += landings[i].weight;
  for (std::size_t i = before; i < landings.size(); ++i) new_sum += landings[i].weight;
  if (!(new_sum > 0)) return;
  const auto had = static_cast<double>(landed.size());
  const double kept = had / (had + static_cast<double>(landings.size() - before));
  for (const std::size_t i : landed) landings[i].weight *= kept;
  for (std::size_t i = before; i < landings.size(); ++i) landings[i].weight *= (1 - kept) * old_sum / new_sum;
}

}  // namespace

LightPaths::LightPaths(const SceneView& its_scene, std::vector<Thing> its_things)
    : scene(its_scene), things(std::move(its_things)), thing_of(static_cast<std::size_t>(scene.elements.count()), -1) {
  for (std::size_t i = 0; i < things.size(); ++i)
    thing_of[static_cast<std::size_t>(things[i].element)] = static_cast<std::int32_t>(i);
}

void LightPaths::trace_pairs(int count) {
  const int lights = std::min(scene.lights.count(), max_guide_lights), per_light = static_cast<int>(things.size());
  const int each = std::max(count / std::max(lights * per_light, 1), 1);
  paths_of_pair += each;
  Flight flight(*this);
  for (int light = 0; light < lights; ++light)
    for (int thing = 0; thing < per_light; ++thing)
      for (int i = 0; i < each; ++i)
        if (LightStart start; aim(*this, light, thing, start)) flight.trace(start, nullptr);
}

void LightPaths::thin_out(std::size_t count) {
  std::vector<std::size_t> kept;
  for (const SequenceLandings& sequence : by_events(landings)) {
    const std::vector<std::size_t>& landed = sequence.landed;
    const auto wanted = static_cast<std::size_t>(sequence.fraction * static_cast<double>(count));
    const std::size_t quota = std::max(wanted, min_kept), step = (landed.size() + quota - 1) / quota;
    double power = 0;
    for (std::size_t j = 0; j < landed.size(); j += step) power += landings[landed[j]].weight;
    for (std::size_t j = 0; j < landed.size(); j += step)
      landings[landed[j]].weight *= sequence.power / power, kept.push_back(landed[j]);
  }
  std::sort(kept.begin(), kept.end());
  for (std::size_t k = 0; k < kept.size(); ++k) landings[k] = landings[kept[k]];
  landings.resize(kept.size());
}

void LightPaths::trace_copies(int count) {
  for (const SequenceLandings& sequence : by_events(landings))
    copy(*this, sequence.landed, static_cast<int>(count * sequence.fraction));
}

}  // namespace tyndall
