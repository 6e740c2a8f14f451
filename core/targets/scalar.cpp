// One path at a time, for any processor: the readable reference, and the kernel that records paths and probes scenes.
#include "core/reuse/reuse.h"
#include "core/targets/entry.h"
#include "core/targets/replay.h"
#include "core/transport/path.h"

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

/// Records, event by event, the path of the one sample that a tile job wants. See NoRecorder. What it does stays out of
/// the path loop, which mostly runs without it.
class PathRecorder {
 public:
  /// The group to which the path belongs if the scene reuses second vertices; else null.
  const ReusedPaths* reused = nullptr;

  void on_weight_against_specular_paths(float weight) { weight_ *= weight; }
  [[gnu::noinline]] void on_event(const SceneView& s, const Paths<float>& p, const Hit<float>& hit,
                                  const MediumEvent<float>& found, const Event<float>& e);
  [[gnu::noinline]] void on_specular_path_light(Vec3f light);
  /// A branch leaves the path where it is. Branches are followed after the path, the last one first.
  [[gnu::noinline]] void on_branch() {
    if (wanted_) branches_.push_back(static_cast<std::int32_t>(path_.vertices.size()) - 1);
  }
  [[gnu::noinline]] void on_end(const Paths<float>& p, bool on, StepResult<float> end);
  const PathReplay& path() const { return path_; }

 private:
  PathReplay path_;
  float weight_ = 1;  ///< against specular and guided paths, of the light that this step has hit
  bool wanted_ = false, at_light_ = false;
  Vec3f ended_{};                       ///< gathered by the path, and by branches, that have ended
  std::vector<std::int32_t> branches_;  ///< that are still to be followed: the vertices at which they leave
};

/// The recorder of the scalar kernel, which mostly records nothing. It passes copies: a kernel keeps in memory what is
/// pointed to.
struct MaybeRecorder {
  PathRecorder* to = nullptr;

  TYNDALL_INLINE void on_weight_against_specular_paths(float weight) {
    if (to) to->on_weight_against_specular_paths(weight);
  }
  TYNDALL_INLINE void on_event(const SceneView& s, Paths<float> p, Hit<float> hit, MediumEvent<float> found,
                               Event<float> e) {
    if (to) to->on_event(s, p, hit, found, e);
  }
  TYNDALL_INLINE void on_specular_path_light(Vec3f light) {
    if (to) to->on_specular_path_light(light);
  }
  TYNDALL_INLINE void on_branches(bool some) {
    if (to && some) to->on_branch();
  }
  TYNDALL_INLINE void on_end(Paths<float> p, bool on, StepResult<float> end) {
    if (to) to->on_end(p, on, end);
  }
};

void PathRecorder::on_event(const SceneView& s, const Paths<float>& p, const Hit<float>& hit,
                            const MediumEvent<float>& found, const Event<float>& e) {
  wanted_ = !reused || reused->pixel[p.slot] >= 0;
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

/// The one sample of a pixel, which is in the given half.
Vec3f sample_of(const FilmPixel& pixel, std::uint32_t half) {
  const float lost = pixel.rejected[half] ? __builtin_nanf("") : 0.0f;
  const auto value = [&](int c) { return lost + static_cast<float>(pixel.sum[half][c].value()); };
  return {value(0), value(1), value(2)};
}

}  // namespace

Kernels scalar_kernels() { return full_kernel_of<float, MaybeRecorder>("scalar"); }

PathReplay replay(const SceneView& scene, int x, int y, std::uint32_t sample) {
  FilmPixel pixel{};
  TileCounts counts;
  PathRecorder recorder;
  MaybeRecorder maybe{&recorder};
  render_either_tile<float>(scene, {{x, y, x + 1, y + 1}, 1, 0, sample, sample + 1}, {1, &pixel, nullptr, counts},
                            maybe, [&](GroupSamples& groups) { recorder.reused = &groups.reused(); });
  PathReplay path = recorder.path();
  if (scene.reuses_paths) path.radiance = sample_of(pixel, sample & 1u);
  return path;
}

void trace_groups(const SceneView& scene, ReusedPaths& paths, TileCounts& counts) {
  const TileFilm film{1, nullptr, nullptr, counts};
  GroupSamples samples(paths, {nullptr, nullptr}, film);
  MaybeRecorder none;
  follow_either<float>(scene, {}, film, &samples, none);
  add_specular_paths_to_leaving(scene, paths);
}

}  // namespace tyndall
