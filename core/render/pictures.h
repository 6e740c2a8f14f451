#pragma once
#include "core/base/crew.h"
#include "core/film/film.h"
#include "core/kernel/kernels.h"
#include "core/render/frame.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

/// From a film to what is shown. Values are linear; exposure and tone mapping are the display's.
namespace tyndall {

/// RGBA of a film's means, in `rgba`. step > 1: only every step-th pixel has samples; the others are filled in between
/// (bilinear), in the picture only.
void beauty_rgba(const Film& film, int step, Crew& crew, std::vector<float>& rgba);

/// Memory of frames that nobody looks at any more: fresh memory costs more than the picture that is written to it.
class FrameMemory {
 public:
  /// A frame with what a former one's `rgba` held. Keep this object for as long as there are frames.
  std::shared_ptr<Frame> take();

 private:
  struct Spare {
    std::mutex mutex;
    std::vector<std::vector<float>> rgba;
  };
  std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
};

/// A picture of one grey.
std::vector<float> grey_rgba(std::size_t pixels, float grey);

/// Estimated relative error of each pixel (see pixel_relative_error) as grey: 1 is 100 % and more.
std::vector<float> noise_rgba(const Film& film);

/// Samples of each pixel over the most any pixel has, as grey.
std::vector<float> samples_rgba(const Film& film);

/// Rays of a path through each pixel, a mean over cells of 4 x 4 pixels and their first samples, which are taken once
/// more for it. Empty if `give_up` was set meanwhile.
std::vector<float> find_costs(const Kernels& kernels, const SceneView& scene, Crew& crew,
                              const std::atomic<bool>& give_up);

/// Numbers >= 0 as grey, 1 for the largest.
std::vector<float> relative_rgba(const std::vector<float>& values);

/// Albedo, normal (x, y, z in [0, 1]) or depth (grey; 1 at the farthest) of what is first seen. hits: a frame's worth.
std::vector<float> first_hit_rgba(const std::vector<FirstHit>& hits, View view);

/// What is first seen through every pixel of the image.
std::vector<FirstHit> find_first_hits(const Kernels& kernels, const SceneView& scene, Crew& crew);

}  // namespace tyndall
