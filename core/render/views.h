#pragma once
#include "core/render/pictures.h"
#include "core/render/prepare.h"
#include "core/render/progression.h"

#include <atomic>
#include <memory>
#include <vector>

/// What the frames show: the beauty image or one of the other views.
namespace tyndall {

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
  void find_due_costs(const RenderEngine& engine, const std::atomic<bool>& give_up);
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
