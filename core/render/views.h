#pragma once
#include "core/render/pictures.h"
#include "core/render/prepare.h"
#include "core/render/progression.h"

#include <atomic>
#include <memory>
#include <vector>

/// What the frames show: the picture itself, or one of the other views of it.
namespace tyndall {

/// Draws the views of a scene. What needs rays of its own (what is first seen, what each part costs) is found when a
/// view first asks, and kept until the scene changes.
class Views {
 public:
  /// The scene has changed: what was found has to be found anew. Until then the old costs are shown, because edits that
  /// follow each other closely interrupt the search, and the view would stay grey.
  void change_scene(std::shared_ptr<const PreparedScene> scene);
  /// Draws the view of the picture into `rgba`. If it first has to find costs, it stops early when `give_up` is set.
  /// Noise and samples show the old picture of them until there is a new one. clean: the clean view of the picture, of
  /// which the noise is then shown, or null.
  PictureGrid draw(View view, const Progression& picture, const CleanFrame* clean, const RenderEngine& engine,
                   const std::atomic<bool>& give_up, std::vector<float>& rgba);
  /// What white stands for in the view that was drawn last: see Frame.
  double white() const { return white_; }

 private:
  void find_due_costs(const RenderEngine& engine, const std::atomic<bool>& give_up);
  void draw_counts(View view, const Progression& picture, std::vector<float>& rgba);

  std::shared_ptr<const PreparedScene> scene_;
  double white_ = 1, white_of_counts_ = 1;
  std::vector<float> counts_;         ///< the newest picture of noise or samples
  View counts_of_ = View::beauty;     ///< which of the two
  std::vector<FirstHit> first_hits_;  ///< empty: not found yet
  std::vector<float> costs_;          ///< those of an older scene while costs_due_ is set
  bool costs_due_ = true;
};

}  // namespace tyndall
