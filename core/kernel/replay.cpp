// Its steps are those of the scalar kernel, to the last bit.
#include "core/kernel/replay.h"

#include "core/kernel/kernels.h"
#include "core/kernel/path.h"

namespace tyndall {
namespace {

bool finite(Vec3f v) {
  const float sum = 0.0f * v.x + 0.0f * v.y + 0.0f * v.z;
  return sum == 0.0f;
}

/// What a path meets next, found by the same queries as in its step.
struct Meeting {
  PathVertex vertex;
  Vec3f colour;
  std::int32_t kind = -1;  ///< of the surface's material
  Vec3f facing;
};

Meeting meet(const SceneView& s, const Paths<float>& p) {
  Meeting m{};
  PathVertex& v = m.vertex;
  v.direction = p.ray.direction, v.throughput = p.throughput, v.point = p.ray.origin;
  v.first_dimension = dimension::camera_count + static_cast<std::uint32_t>(p.depth) * dimension::per_event;
  Hit<float> hit = closest(s, p.ray, true);
  MediumEvent<float> event = no_event<float>();
  if (s.needs.media) {
    fly_through_media(s, p.ray, p.dice, true, hit.t, event);
    v.kept = kept_by_smoke(s, p.ray, p.dice, hit.t, true);
    v.throughput = v.kept * v.throughput;
  }
  if (event.happens) {
    v.met = Met::medium;
    v.element = event.from / 4;
    v.point = event.point;
    v.medium = event.medium;
    m.colour = event.albedo;
    if (s.needs.textures) m.colour = textured<float>(s, m.colour, event.texture, true, event.point, nullptr);
  } else if (hit.element >= 0) {
    const SurfacePoint<float> at = surface_at(s, p.ray, hit.t, hit.element);
    v.met = Met::surface;
    v.element = hit.element;
    v.point = at.point;
    m.colour = surface_colour(s, at, true);
    m.kind = s.kind[at.material];
    m.facing = dot(p.ray.direction, at.normal) > 0 ? -at.normal : at.normal;
  }
  v.distance = length(v.point - p.ray.origin);
  return m;
}

Fate fate_of(const Meeting& m, const Paths<float>& after, bool survives, bool cut) {
  if (survives) return Fate::goes_on;
  if (cut) return Fate::cut;
  if (!finite(after.radiance)) return Fate::lost;
  if (m.vertex.kept == 0) return Fate::absorbed;
  if (m.vertex.met == Met::nothing) return Fate::escapes;
  if (m.kind == kind_of<Light<double>>()) return Fate::ends_at_light;
  const bool black = !(max_component(m.vertex.throughput * m.colour) > 0);
  const bool below = m.kind == kind_of<Metal<double>>() && dot(after.ray.direction, m.facing) <= 0;
  return black || below ? Fate::absorbed : Fate::roulette;
}

/// Takes the path one step further; answers whether it goes on. `cut`: whether max_depth ended it. shared: of a scene
/// that shares.
bool take_step(const SceneView& s, Paths<float>& p, bool& cut, SharedPaths& shared) {
  std::uint32_t shadow_rays = 0;
  ChainQueue<float> chains{};
  NoSharing alone;
  return s.shares ? step(s, p, true, cut, chains, shared, shadow_rays)
                  : step(s, p, true, cut, chains, alone, shadow_rays);
}

/// From its second vertex on a path that is shared is a path of its own, which came there with a grey throughput. This
/// is what it has gathered, and what it carries, as a path of its own pixel.
struct OwnColours {
  Vec3f gathered{}, tint{1, 1, 1};

  OwnColours(const Paths<float>& p, const SharedPaths& shared) {
    if (!p.second) return;
    const auto at = [&](const float(&columns)[3][SharedPaths::room]) {
      return Vec3f{columns[0][p.slot], columns[1][p.slot], columns[2][p.slot]};
    };
    const Vec3f albedo = at(shared.albedo);
    gathered = at(shared.own), tint = (1 / max_component(albedo)) * albedo;
  }
};

/// The sample of a scene that shares, together with the samples of its group.
Vec3f shared_sample(const SceneView& s, const Unit& unit) {
  FilmPixel pixel{};
  UnitCounts counts;
  scalar_kernels().render_unit(s, unit, 1, &pixel, counts);
  const ExactSum(&sum)[3] = pixel.sum[unit.first & 1u];
  const float lost = pixel.rejected[unit.first & 1u] ? __builtin_nanf("") : 0.0f;
  const auto value = [&](int c) { return lost + static_cast<float>(sum[c].value()); };
  return {value(0), value(1), value(2)};
}

/// The scene without chains. What a step in the full scene adds beyond a step in this one was added by chains.
SceneView without_chains(SceneView s) {
  s.chains.pairs = 0;
  return s;
}

/// What chains did to a step. start: the radiance before it; alone: after it, without chains.
void tell_chains(Vec3f start, Vec3f alone, Vec3f after, PathVertex& v) {
  const float with = max_component(after - start), without = max_component(alone - start);
  if (with < without)
    v.chance = with / without;
  else
    v.by_chains = after - alone;
}

}  // namespace

PathReplay replay(const SceneView& s, int x, int y, std::uint32_t sample) {
  const Unit unit{{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1};
  UnitSamples samples;
  list_samples(s, unit, samples);
  Paths<float> p{};
  p.dice.sampler = s.sampler;
  begin_samples(s, p, samples);
  PathReplay path{p.ray.origin, p.ray.time, {}, {}, s.has_chains() ? p.weight : 1.0f};
  SharedPaths shared;
  while (p.alive) {
    Meeting meeting = meet(s, p);
    bool cut = false;
    const Vec3f start = p.radiance, tint = OwnColours(p, shared).tint;
    Paths<float> alone = p;
    if (s.has_chains()) take_step(without_chains(s), alone, cut, shared);  // first: what both note is to be p's
    const bool survives = take_step(s, p, cut, shared);
    const OwnColours own(p, shared);
    PathVertex& v = meeting.vertex;
    if (s.has_chains()) tell_chains(start, alone.radiance, p.radiance, v);
    v.throughput = tint * v.throughput;
    v.radiance = own.gathered + own.tint * (path.weight * p.radiance), v.by_chains = path.weight * v.by_chains;
    v.fate = fate_of(meeting, p, survives, cut);
    v.inside = v.met == Met::surface && survives && p.ray.from >= 0 &&
               (p.ray.from & 3) != static_cast<std::int32_t>(Side::outward);
    path.vertices.push_back(v);
    p.alive = survives ? 1 : 0;
  }
  path.radiance = path.vertices.back().radiance;
  path.shared = p.first != 0;
  if (s.shares) path.radiance = shared_sample(s, unit);
  return path;
}

}  // namespace tyndall
