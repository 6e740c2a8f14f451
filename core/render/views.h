#pragma once
#include "core/render/pictures.h"
#include "core/render/progression.h"

#include <atomic>
#include <vector>

/// What the frames show: the picture itself, or one of the other views of it.
namespace tyndall {

/// Draws the views of a scene. What needs rays of its own (what is first seen, what each part costs) is found when a
/// view first asks, and kept until the scene changes.
class Views {
 public:
  /// Other things are seen from now on. The costs are shown until new ones are found: edits that follow each other
  /// closely interrupt the search, and the view would stay grey.
  void change_scene();
  /// The view of the picture, in `rgba`. Where costs are searched, the search ends early when `give_up` is set.
  void draw(View view, const Progression& picture, const RenderEngine& engine, const std::atomic<bool>& give_up,
            std::vector<float>& rgba);

 private:
  void find_due_costs(const RenderEngine& engine, const std::atomic<bool>& give_up);

  std::vector<FirstHit> first_hits_;  ///< empty: not found yet
  std::vector<float> costs_;          ///< of an older scene while costs_due_
  bool costs_due_ = true;
};

}  // namespace tyndall
