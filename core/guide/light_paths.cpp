#include "core/guide/light_paths.h"

#include "core/trace/flight.h"
#include "core/trace/intersect.h"
#include "core/trace/lights.h"
#include "core/trace/shade.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tyndall {
namespace {

constexpr double min_reflected = 0.15;  // probability with which a light path is reflected, or refracted, at least
constexpr double move_step = 1e-3;      // of nearby rays, in radii of their light
constexpr double focus = 1e-11;         // area of a wave front per steradian, over the flight's squared length
constexpr std::size_t min_kept = 10;    // landings of each sequence, where there are so many
constexpr double copy_spread = 2;       // copies are rotated by up to this times the distance between light paths

/// Cosine and sine of a random angle: by the kernels' polynomials, not by the C library.
SinCos<double> random_angle(double u) {
  const SinCos<float> a = sin_cos_2pi(static_cast<float>(u));
  return {static_cast<double>(a.sin), static_cast<double>(a.cos)};
}

/// Transmittance of the media along a ray, by the kernels' polynomials.
double transmitted(const SceneView& s, const Ray<double>& ray, double distance) {
  const Ray<float> same{to_float(ray.origin), to_float(ray.direction), static_cast<float>(ray.time), ray.from};
  return static_cast<double>(pass_media<float>(s, same, static_cast<float>(distance), true));
}

}  // namespace

LightPaths::LightPaths(const SceneView& scene, std::vector<Thing> things)
    : scene_(scene), things_(std::move(things)), thing_of_(static_cast<std::size_t>(scene.elements.count()), -1) {
  for (std::size_t i = 0; i < things_.size(); ++i)
    thing_of_[static_cast<std::size_t>(things_[i].element)] = static_cast<std::int32_t>(i);
}

std::vector<std::int32_t> LightPaths::thing_of() const { return thing_of_; }

/// S. Vigna's splitmix64.
double LightPaths::next() {
  std::uint64_t z = random_ += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull, z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

Vec3d LightPaths::direction_in_cone(Vec3d axis, double one_minus_cos) {
  const double z = 1 - next() * one_minus_cos, r = std::sqrt(std::max(1 - z * z, 0.0));
  const SinCos<double> a = random_angle(next());
  const Basis<double> b = basis_around(axis);
  return normalized(z * axis + (r * a.cos) * b.s + (r * a.sin) * b.t);
}

Vec3d LightPaths::middle_of(int light, double time) const {
  const Lights& l = scene_.lights;
  if (l.kind[light] == Lights::sphere) return sphere_light_center(load_light<double>(l, light), time);
  return to_double(l.center[light]);
}

/// Draws a path from a light's middle towards a thing. Returns false if it leads along the light.
bool LightPaths::aim(int light, int index, Start& start) {
  const Lights& l = scene_.lights;
  const Thing& thing = things_[static_cast<std::size_t>(index)];
  start.light = light, start.thing = index;
  start.time =
      static_cast<double>(scene_.camera.shutter_open) + next() * static_cast<double>(scene_.camera.shutter_length);
  const LightColumns<double> columns = load_light<double>(l, light);
  const bool round = l.kind[light] == Lights::sphere;
  const Vec3d middle = middle_of(light, start.time);
  if (thing.is_sphere) {
    const Vec3d to_center = thing.center + start.time * thing.motion - middle;
    const double squared = dot(to_center, to_center), sine2 = thing.radius * thing.radius / squared;
    const double one_minus_cos = sine2 < 1 ? sine2 / (1 + std::sqrt(1 - sine2)) : 2;
    start.direction = direction_in_cone(squared > 0 ? normalized(to_center) : Vec3d{0, 0, 1}, one_minus_cos);
    start.solid_angle = 2 * pi * one_minus_cos;
  } else {
    const double a = next(), b = next();
    const Vec3d to_thing = thing.corner + a * thing.u + b * thing.v - middle;
    const double squared = dot(to_thing, to_thing);
    if (!(squared > 0)) return false;
    start.direction = normalized(to_thing);
    start.solid_angle = std::min(std::abs(dot(start.direction, cross(thing.u, thing.v))) / squared, 4 * pi);
  }
  const double intensity = at(l.power, light);  // radiance times area
  start.power = start.solid_angle * intensity * (round ? 0.25 : std::abs(dot(start.direction, columns.normal)));
  return start.power > 0;
}

void LightPaths::begin(const Start& start) {
  const Lights& l = scene_.lights;
  const LightColumns<double> columns = load_light<double>(l, start.light);
  const bool round = l.kind[start.light] == Lights::sphere;
  const Vec3d d = start.direction;
  const double skip = round ? columns.length_u : 0;  // paths start on the light's surface
  const Vec3d middle = middle_of(start.light, start.time);
  Flight& f = flight_;
  f.start = start, f.fuzz.clear(), f.met.clear(), f.rays.clear();
  f.weight = start.power, f.chance = 1, f.length = skip;
  f.image = LightImage<double>{middle, {}, 0};
  const double longest = std::max(columns.length_u, columns.length_v);
  f.light_radius = round ? columns.length_u : longest * std::sqrt(1 / 3.0);  // of a disc as wide, roughly
  const bool behind = !round && dot(d, columns.normal) < 0;
  f.from = 4 * l.element[start.light] + static_cast<std::int32_t>(behind ? Side::inward : Side::outward);
  const Basis<double> b = basis_around(d);
  const Vec3d directions[] = {d, normalized(d + angle_step * b.s), normalized(d + angle_step * b.t)};
  for (const Vec3d& direction : directions) f.rays.push_back({middle + skip * direction, direction});
  for (const Vec3d& moved : {b.s, b.t}) f.rays.push_back({middle + move_step * f.light_radius * moved + skip * d, d});
}

void LightPaths::trace(const Start& start, const OrderedEvents<double>* wanted) {
  ++traced_;
  begin(start);
  Flight& f = flight_;
  for (int depth = 0; depth <= max_guided_events; ++depth) {
    const Ray<double> ray{f.rays[0].origin, f.rays[0].direction, start.time, f.from};
    const Hit<double> hit = closest<double>(scene_, ray, true);
    if (hit.element < 0) return;
    f.length += hit.t;
    const std::int32_t aimed = things_[static_cast<std::size_t>(start.thing)].element;
    if (depth == 0 && hit.element != aimed) return;
    if (scene_.has_media()) f.weight *= transmitted(scene_, ray, hit.t);
    const std::int32_t kind = scene_.materials.kind[scene_.elements.material[hit.element]];
    if (has_trait<&BsdfTraits::diffuse>(scene_, kind)) return land(ray.origin + hit.t * ray.direction, wanted);
    if (thing_of_[static_cast<std::size_t>(hit.element)] < 0 || !meet(hit.element, hit.t, wanted)) return;
  }
}

/// Decides whether glass reflects the flight, and weighs it. Returns false if no light goes that way.
bool LightPaths::choose_side(double reflected, std::int32_t thing, const OrderedEvents<double>* wanted,
                             bool& reflects) {
  double probability = reflected;
  if (reflected > 0 && reflected < 1) probability = std::clamp(reflected, min_reflected, 1 - min_reflected);
  if (wanted) {  // the sum of the copies' weights is known, so that a factor of all does not matter
    const auto depth = static_cast<int>(flight_.met.size());
    const std::int32_t code = (depth < 5 ? wanted->low >> 6 * depth : wanted->high >> 6 * (depth - 5)) & 63;
    if (code >> 1 != thing + 1) return false;
    reflects = (code & 1) != 0;
    probability = 0.5;
  } else {
    reflects = next() < probability;
  }
  const double fraction = reflects ? reflected : 1 - reflected;
  flight_.chance *= fraction, flight_.weight *= fraction / (reflects ? probability : 1 - probability);
  return fraction > 0;
}

/// Adds an event to the image of the light that those see who look back along the flight.
void LightPaths::extend_image(const Thing& thing, const MetSurface& m) {
  if (!flight_.image) return;
  LightImage<double>& image = *flight_.image;
  const auto mirrored = [&](Vec3d p) { return p - (2 * dot(p - thing.corner, m.normal)) * m.normal; };
  if (m.reflects && !thing.is_sphere)
    image.light = mirrored(image.light), image.sphere = mirrored(image.sphere);
  else if (m.reflects && !m.far && thing.motion == Vec3d{} && image.radius == 0)
    image.sphere = thing.center, image.radius = thing.radius;
  else
    flight_.image.reset();
}

/// Sends the flight on from a thing. Returns false if it ends there.
bool LightPaths::meet(std::int32_t element, double t, const OrderedEvents<double>* wanted) {
  Flight& f = flight_;
  if (f.met.size() == max_guided_events) return false;
  const std::int32_t index = thing_of_[static_cast<std::size_t>(element)];
  const Thing& thing = things_[static_cast<std::size_t>(index)];
  const Ray<double> ray{f.rays[0].origin, f.rays[0].direction, f.start.time, f.from};
  const SurfacePoint<double> p = surface_at<double>(scene_, ray, t, element);
  const bool exiting = dot(ray.direction, p.normal) > 0, inside = exiting != p.inverted;
  MetSurface m{
      thing.is_sphere, p.inverted, inside, thing.center + f.start.time * thing.motion, p.point, p.normal, 0, 0, true};
  m.radius = std::sqrt(squared_length(p.point - m.center));
  if (has_trait<&BsdfTraits::glossy>(scene_, scene_.materials.kind[p.material])) {
    f.weight *= static_cast<double>(max_component(scene_.materials.colour[p.material]));
  } else {
    Incident<double> in{};
    in.direction = ray.direction, in.normal = p.normal, in.facing = exiting ? -p.normal : p.normal;
    in.cosine = std::min(std::abs(dot(ray.direction, p.normal)), 1.0), in.exiting = exiting;
    const Boundary<double> boundary = boundary_any(scene_, p.material, in);
    m.index = exiting ? 1 / boundary.eta : boundary.eta;
    if (!choose_side(boundary.reflected, index, wanted, m.reflects)) return false;
  }
  extend_image(thing, m);
  for (NearbyRay& near : f.rays) near.lost = near.lost || !follow(m, near.origin, near.direction);
  if (f.rays[0].lost) return false;
  if (thing.fuzz > 0) {
    const NearbyRay own = f.rays[0];
    const Basis<double> b = basis_around(own.direction);
    for (const Vec3d& across : {b.s, b.t})
      f.rays.push_back({own.origin, normalized(own.direction + angle_step * across)});
    f.fuzz.push_back(thing.fuzz);
  }
  f.from = 4 * element + (inside == m.reflects ? 1 : 0);
  f.met.push_back(2 * index + (m.reflects ? 1 : 0));
  return true;
}

/// Names the events of the flight. Returns false if exact paths cover them, or if they are not the wanted ones.
bool LightPaths::name_events(const OrderedEvents<double>* wanted, Landing& l) const {
  const std::vector<std::int32_t>& met = flight_.met;
  l.events = l.next = OrderedEvents<double>::none();
  l.count = static_cast<int>(met.size());
  bool one_object = true;
  for (std::size_t i = 0; i < met.size(); ++i) {
    const std::int32_t first = met[i], last = met[met.size() - 1 - i];
    l.next = append_event(l.next, first >> 1, (first & 1) != 0);
    l.events = append_event(l.events, last >> 1, (last & 1) != 0);
    const auto object = [&](std::int32_t event) { return things_[static_cast<std::size_t>(event >> 1)].object; };
    one_object = one_object && object(first) >= 0 && object(first) == object(met[0]);
  }
  return !one_object && !(wanted && !same_events(*wanted, l.events));
}

/// Turns the flight into a landing, from how its nearby rays cross the plane across the flight there.
void LightPaths::land(Vec3d point, const OrderedEvents<double>* wanted) {
  const Flight& f = flight_;
  if (f.met.empty() || std::any_of(f.rays.begin(), f.rays.end(), [](const NearbyRay& r) { return r.lost; })) return;
  Landing l;
  if (!name_events(wanted, l)) return;
  const Vec3d d = f.rays[0].direction;
  const auto pair = [&](std::size_t k, double step) {
    return changes_of({f.rays[k].origin, f.rays[k + 1].origin}, {f.rays[k].direction, f.rays[k + 1].direction}, point,
                      d, step);
  };
  const ChangedPair rotated = pair(1, angle_step), moved = pair(3, move_step * f.light_radius);
  if (std::abs(determinant(rotated.place)) < focus * f.length * f.length) return;
  const Matrix front = rotated.direction * inverse(rotated.place);
  add_square(moved.direction - front * moved.place, f.light_radius * f.light_radius / 4, l.variance);
  for (std::size_t k = 0; k < f.fuzz.size(); ++k) {
    const ChangedPair blurred = pair(5 + 2 * k, angle_step);
    add_square(blurred.direction - front * blurred.place, f.fuzz[k] * f.fuzz[k] / 5, l.variance);
  }
  l.point = point, l.flight = d, l.axis = basis_around(d).s;
  l.curvature = {front.a, 0.5 * (front.b + front.c), front.d};
  l.weight = f.weight, l.chance = f.chance, l.length = f.length, l.image = f.image;
  if (!std::isfinite(l.variance.xx + l.variance.yy + front.a + front.b + front.c + front.d)) return;
  landings_.push_back(l), starts_.push_back(f.start);
}

void LightPaths::trace_pairs(int count) {
  const int lights = std::min(scene_.lights.count(), max_guide_lights), things = static_cast<int>(things_.size());
  const int each = std::max(count / std::max(lights * things, 1), 1);
  paths_of_pair_ += each;
  for (int light = 0; light < lights; ++light)
    for (int thing = 0; thing < things; ++thing)
      for (int i = 0; i < each; ++i) {
        Start start{};
        if (aim(light, thing, start)) trace(start, nullptr);
      }
}

/// Traces copies of paths that landed after the same events, and shares the sum of their weights with them.
void LightPaths::copy(const std::vector<std::size_t>& landed, int count) {
  const OrderedEvents<double> events = landings_[landed[0]].events;
  const std::size_t before = landings_.size();
  for (int i = 0; i < count; ++i) {
    Start start = starts_[landed[static_cast<std::size_t>(next() * static_cast<double>(landed.size()))]];
    const double apart = std::sqrt(start.solid_angle / pi / std::max(paths_of_pair_, 1.0));
    const double r = copy_spread * apart * std::sqrt(next());
    const SinCos<double> a = random_angle(next());
    const Basis<double> b = basis_around(start.direction);
    start.direction = normalized(start.direction + (r * a.cos) * b.s + (r * a.sin) * b.t);
    trace(start, &events);
  }
  double old_sum = 0, new_sum = 0;
  for (const std::size_t i : landed) old_sum += landings_[i].weight;
  for (std::size_t i = before; i < landings_.size(); ++i) new_sum += landings_[i].weight;
  if (!(new_sum > 0)) return;
  const auto had = static_cast<double>(landed.size());
  const double kept = had / (had + static_cast<double>(landings_.size() - before));
  for (const std::size_t i : landed) landings_[i].weight *= kept;
  for (std::size_t i = before; i < landings_.size(); ++i) landings_[i].weight *= (1 - kept) * old_sum / new_sum;
}

std::vector<LightPaths::SequenceLandings> LightPaths::by_events() const {
  std::map<std::pair<std::int32_t, std::int32_t>, SequenceLandings> sequences;
  for (std::size_t i = 0; i < landings_.size(); ++i) {
    SequenceLandings& sequence = sequences[{landings_[i].events.high, landings_[i].events.low}];
    sequence.landed.push_back(i), sequence.power += landings_[i].weight;
  }
  std::vector<SequenceLandings> list;
  double roots = 0;
  for (auto& [events, sequence] : sequences) roots += std::sqrt(sequence.power), list.push_back(std::move(sequence));
  for (SequenceLandings& sequence : list) sequence.fraction = std::sqrt(sequence.power) / roots;
  return list;
}

void LightPaths::thin_out(std::size_t count) {
  std::vector<std::size_t> kept;
  for (const SequenceLandings& sequence : by_events()) {
    const std::vector<std::size_t>& landed = sequence.landed;
    const auto wanted = static_cast<std::size_t>(sequence.fraction * static_cast<double>(count));
    const std::size_t quota = std::max(wanted, min_kept), step = (landed.size() + quota - 1) / quota;
    double power = 0;
    for (std::size_t j = 0; j < landed.size(); j += step) power += landings_[landed[j]].weight;
    for (std::size_t j = 0; j < landed.size(); j += step)
      landings_[landed[j]].weight *= sequence.power / power, kept.push_back(landed[j]);
  }
  std::sort(kept.begin(), kept.end());
  for (std::size_t k = 0; k < kept.size(); ++k) landings_[k] = landings_[kept[k]], starts_[k] = starts_[kept[k]];
  landings_.resize(kept.size()), starts_.resize(kept.size());
}

void LightPaths::trace_copies(int count) {
  for (const SequenceLandings& sequence : by_events())
    copy(sequence.landed, static_cast<int>(count * sequence.fraction));
}

}  // namespace tyndall
