#include "core/targets/recorder.h"

namespace tyndall {
namespace {

bool finite(Vec3f v) {
  const float sum = 0.0f * v.x + 0.0f * v.y + 0.0f * v.z;
  return sum == 0.0f;
}

/// From its second vertex on, a path that is reused is a path of its own, which starts there with a grey throughput.
/// This holds what the path gathered before, and the tint of what it carries as a path of its own pixel.
struct OwnColours {
  Vec3f gathered{}, tint{1, 1, 1};

  OwnColours(const Paths<float>& p, const ReusedPaths* reused) {
    if (!p.second) return;
    const auto at = [&](const float(&columns)[3][ReusedPaths::room]) {
      return Vec3f{columns[0][p.slot], columns[1][p.slot], columns[2][p.slot]};
    };
    const Vec3f albedo = at(reused->albedo);
    gathered = at(reused->own), tint = (1 / max_component(albedo)) * albedo;
  }
};

}  // namespace

void PathRecorder::on_event(const SceneView& s, const Paths<float>& p, const Hit<float>& hit,
                            const MediumEvent<float>& found, const Event<float>& e) {
  wanted_ = is_wanted(p);
  if (!wanted_) return;
  if (path_.vertices.empty())
    path_.origin = p.ray.origin, path_.time = p.ray.time, path_.weight = has_sample_weights(s) ? p.weight : 1;
  PathVertex v{};
  const bool follows = path_.vertices.empty() || path_.vertices.back().fate == Fate::goes_on;
  v.before = static_cast<std::int32_t>(path_.vertices.size()) - 1;
  if (!follows && !branches_.empty()) v.before = branches_.back(), v.branch = true, branches_.pop_back();
  v.direction = p.ray.direction, v.point = p.ray.origin;
  v.first_dimension = dimension::camera_count + static_cast<std::uint32_t>(p.depth) * dimension::per_event;
  if (s.has_media()) v.kept = transmitted_by_absorbers(s, p.ray, p.sampler, hit.t, true);
  v.throughput = OwnColours(p, reused).tint * p.throughput;
  at_light_ = !found.happens && hit.element >= 0 && !e.surface;
  if (found.happens)
    v.met = Met::medium, v.element = found.from / 4, v.point = found.point, v.medium = found.medium;
  else if (hit.element >= 0)
    v.met = Met::surface, v.element = hit.element, v.point = e.at.point;
  v.distance = length(v.point - p.ray.origin);
  if (at_light_) v.chance = weight_;
  weight_ = 1;
  path_.vertices.push_back(v);
}

void PathRecorder::on_specular_path_light(Vec3f light) {
  if (!wanted_) return;
  Vec3f& sum = path_.vertices.back().by_specular_paths;
  sum = sum + path_.weight * light;
}

void PathRecorder::on_end(const Paths<float>& p, bool on, StepResult<float> end) {
  if (!wanted_) return;
  PathVertex& v = path_.vertices.back();
  const OwnColours own(p, reused);
  v.radiance = own.gathered + own.tint * (path_.weight * p.radiance);
  v.fate = end.survivors           ? Fate::goes_on
           : end.cut               ? Fate::cut
           : !finite(p.radiance)   ? Fate::lost
           : v.kept == 0           ? Fate::absorbed
           : v.met == Met::nothing ? Fate::escapes
           : at_light_             ? Fate::ends_at_light
           : on                    ? Fate::roulette
                                   : Fate::absorbed;
  v.inside = v.met == Met::surface && end.survivors && p.ray.from >= 0 &&
             (p.ray.from & 3) != static_cast<std::int32_t>(Side::outward);
  path_.radiance = ended_ + v.radiance;
  if (v.fate != Fate::goes_on) ended_ = path_.radiance;
  path_.reused = p.first != 0;
}

}  // namespace tyndall
