#pragma once
#include "core/render/frame.h"
#include "core/render/prepare.h"
#include "core/render/progression.h"
#include "core/system/locks.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

/// What the frames show: the beauty image or one of the other views, as pictures made of a film, first hits or costs.
/// Values are linear: exposure and tone mapping are applied when a picture is shown.
namespace tyndall {

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

/// Fills in what the film holds of the pixel (report.x, report.y); outside the film it leaves the report unchanged.
void look_at_pixel(const Film& film, PixelReport& report);

/// Draws the views of a scene. First hits and costs, which need rays of their own, are computed when a view first needs
/// them, and kept until the scene changes.
class Views {
 public:
  /// The scene has changed: first hits and costs have to be computed anew. Until then the old costs are shown, because
  /// edits in quick succession interrupt their computation, and the view would stay grey.
  void change_scene(std::shared_ptr<const PreparedScene> scene);
  /// Draws the view of the picture into `rgba`. If it first has to compute costs, it stops early when `give_up` is set.
  /// The views of noise and samples keep their old picture until there is a new one. clean: the clean view, whose noise
  /// is then shown, or null.
  PictureGrid draw(View view, const Progression& picture, const CleanFrame* clean, const RenderEngine& engine,
                   const std::atomic<bool>& give_up, std::vector<float>& rgba);
  /// The value shown as white in the view drawn last: see Frame.
  double white() const { return white_; }

 private:
  void draw_counts(View view, const Progression& picture, std::vector<float>& rgba);

  std::shared_ptr<const PreparedScene> scene_;
  double white_ = 1, white_of_counts_ = 1;
  std::vector<float> counts_;         ///< the newest picture of noise or samples
  View counts_of_ = View::beauty;     ///< noise or samples
  std::vector<FirstHit> first_hits_;  ///< empty: not computed yet
  std::vector<float> costs_;          ///< of an older scene while costs_due_ is set
  bool costs_due_ = true;
};

}  // namespace tyndall
