#pragma once
#include "core/reuse/reuse.h"
#include "core/targets/replay.h"
#include "core/transport/path.h"

/// Lets the scalar kernel record how a sample comes about.
namespace tyndall {

/// Records, event by event, the path of the one sample that a tile job wants. See NoRecorder.
class PathRecorder {
 public:
  /// The group to which the path belongs if the scene reuses second vertices; else null.
  const ReusedPaths* reused = nullptr;

  void on_weight_against_specular_paths(float weight) { weight_ *= weight; }
  void on_event(const SceneView& s, const Paths<float>& p, const Hit<float>& hit, const MediumEvent<float>& found,
                const Event<float>& e);
  void on_specular_path_light(Vec3f light);
  /// A branch leaves the path where it is. Branches are followed after the path, the last one first.
  void on_branch() {
    if (wanted_) branches_.push_back(static_cast<std::int32_t>(path_.vertices.size()) - 1);
  }
  void on_end(const Paths<float>& p, bool on, StepResult<float> end);
  const PathReplay& path() const { return path_; }

 private:
  bool is_wanted(const Paths<float>& p) const { return !reused || reused->pixel[p.slot] >= 0; }

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

}  // namespace tyndall
