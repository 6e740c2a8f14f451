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

  void on_weight_against_specular_paths(float weight) { weight_ = weight; }
  void on_event(const SceneView& s, const Paths<float>& p, const Hit<float>& hit, const MediumEvent<float>& found,
                const Event<float>& e);
  void on_specular_path_light(Vec3f light);
  void on_end(const Paths<float>& p, bool on, StepResult<float> end);
  const PathReplay& path() const { return path_; }

 private:
  bool is_wanted(const Paths<float>& p) const { return !reused || reused->pixel[p.slot] >= 0; }

  PathReplay path_;
  float weight_ = 1;  ///< against specular paths, of the light that this step has hit
  bool wanted_ = false, at_light_ = false;
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
  TYNDALL_INLINE void on_end(Paths<float> p, bool on, StepResult<float> end) {
    if (to) to->on_end(p, on, end);
  }
};

}  // namespace tyndall
