#pragma once
#include "core/base/thread_pool.h"
#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/render/frame.h"
#include "core/system/locks.h"
#include "core/targets/kernels.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

/// Turns a film, first hits or costs into pictures. Values are linear: exposure and tone mapping are applied when a
/// picture is shown.
namespace tyndall {

/// Writes the mean of every pixel of a film into `rgba`.
void beauty_rgba(const Film& film, ThreadPool& thread_pool, std::vector<float>& rgba);

/// Writes the means of a film in which only every step-th pixel in x and y has samples. From a step of 3 on the picture
/// has twice as many columns and rows: pixels between samples are interpolated along edges. step >= 1.
PictureGrid coarse_rgba(const Film& film, int step, ThreadPool& thread_pool, std::vector<float>& rgba);

/// Writes the mean of every pixel that has samples; pixels without show that of the coarse pass of that step.
void filled_rgba(const Film& film, int step, ThreadPool& thread_pool, std::vector<float>& rgba);

/// Keeps the memory of released objects for new ones: fresh memory from the system takes longer than drawing a picture
/// into it. kept: the members whose memory is kept.
template <class T, std::vector<float> T::*... kept>
class MemoryOf {
 public:
  /// A new object whose kept members may hold an old picture. When its last owner drops it, its memory comes back here.
  /// pixels: of the film; memory of pictures of another film size is not kept.
  std::shared_ptr<T> take(std::size_t pixels) {
    if (std::exchange(pixels_, pixels) != pixels) spare_ = std::make_shared<Spare>();
    auto made = std::make_unique<T>();
    {
      const std::lock_guard lock(spare_->mutex);
      if (!spare_->left.empty()) move_kept(spare_->left.back(), *made), spare_->left.pop_back();
    }
    return {made.release(), [spare = spare_](T* done) {
              const std::unique_ptr<T> owner(done);
              const std::lock_guard lock(spare->mutex);
              if (spare->left.size() < max_spare) move_kept(*done, spare->left.emplace_back());
            }};
  }

 private:
  static constexpr std::size_t max_spare = 2;
  struct Spare {
    Spare() { left.reserve(max_spare); }  // so that returning memory, which must not fail, allocates nothing
    Mutex mutex;
    std::vector<T> left;  ///< empty except for the kept members
  };
  static void move_kept(T& from, T& to) { ((to.*kept = std::move(from.*kept)), ...); }
  std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
  std::size_t pixels_ = 0;
};
using FrameMemory = MemoryOf<Frame, &Frame::rgba>;
using CleanFrameMemory = MemoryOf<CleanFrame, &CleanFrame::rgba, &CleanFrame::pixel_error>;

/// A uniformly grey picture.
std::vector<float> grey_rgba(std::size_t pixels, float grey);

/// The estimated relative error of each pixel (see pixel_relative_error) as grey: white is an error of 100 % or more.
std::vector<float> noise_rgba(const Film& film);
std::vector<float> noise_rgba(const std::vector<float>& errors);

/// The number of samples of each pixel as grey: twice the mean and more is white.
std::vector<float> samples_rgba(const Film& film);
double twice_mean_samples(const Film& film);

/// Rays a path through each pixel takes: the mean over cells of 4 x 4 pixels. To count them, the pixels' first 4
/// samples are rendered once more. Empty if `give_up` was set meanwhile.
std::vector<float> find_costs(const Kernels& kernels, const SceneView& scene, ThreadPool& thread_pool,
                              const std::atomic<bool>& give_up);

/// Numbers >= 0 as grey: the largest one is white.
std::vector<float> relative_rgba(const std::vector<float>& values);
/// The largest value, but always above 0.
float largest(const std::vector<float>& values);

/// Fills in what the film holds of the pixel (report.x, report.y); outside the film it leaves the report unchanged.
void look_at_pixel(const Film& film, PixelReport& report);

/// Albedo, normal (x, y, z mapped to [0, 1]) or depth (grey, the farthest is white) of the first hit of each pixel.
std::vector<float> first_hit_rgba(const std::vector<FirstHit>& hits, View view);
/// The largest depth, but always above 0.
float farthest(const std::vector<FirstHit>& hits);
/// A colour for each object, the same wherever it is seen. scene: owner of the elements that the hits name.
std::vector<float> object_rgba(const std::vector<FirstHit>& hits, const RenderScene& scene);

/// The first hit through the centre of each pixel of the image.
std::vector<FirstHit> find_first_hits(const Kernels& kernels, const SceneView& scene, ThreadPool& thread_pool);

}  // namespace tyndall
