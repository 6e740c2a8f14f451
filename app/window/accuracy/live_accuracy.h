#pragma once
#include "app/curves/convergence.h"
#include "app/window/accuracy/comparison.h"
#include "app/window/accuracy/half.h"
#include "app/window/document/job_queue.h"
#include "app/window/system/clock.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace tyndall {

/// A picture of differences, 4 floats a pixel.
struct ErrorMap {
  int width = 0, height = 0;
  ErrorView view = ErrorView::none;
  std::vector<float> rgba;
};

/// What is known of a pair of pictures: the current one against the reference or, in a split view, against the other
/// half.
struct PairErrors {
  std::optional<double> rel_mse, flip;
  std::uint32_t flip_spp = 0;  ///< of the current picture when FLIP was computed
};

/// How far the pictures on the screen are from the truth: estimated, and measured in the background where there is a
/// reference or a second half. Measuring takes less than 2 % of the processors while they render, but the view of FLIP,
/// which takes 10 %. For the main thread.
class LiveAccuracy {
 public:
  /// on_result: called from another thread when collect() has something to do; clock: seconds that never go back.
  explicit LiveAccuracy(const std::function<void()>& on_result, std::function<double()> clock = clock_seconds);

  void set_reference(std::shared_ptr<const Reference> reference);  ///< null: none
  const std::shared_ptr<const Reference>& reference() const { return reference_; }
  /// The scene that a half renders from now on.
  void set_scene(Half half, std::shared_ptr<const Scene> scene);
  void set_scene(Half half, Scene scene) { set_scene(half, std::make_shared<const Scene>(std::move(scene))); }
  /// How the reference goes with that scene; nothing without a reference.
  std::optional<ReferenceFit> fit(Half half) const { return side(half).fit; }
  void set_view(ErrorView view);
  /// A second half comes, or goes with its curves.
  void set_split(bool split);
  bool split() const { return split_; }
  /// Another scene was opened: its curves do not belong to those before.
  void clear();
  /// How many threads render, in all.
  void set_threads(int threads) { threads_ = threads; }

  /// Nothing renders: all that is left may be measured at once.
  void set_resting(bool resting);
  /// A picture is on the screen. newest: of the scene that was set last.
  void shown(Half half, std::shared_ptr<const Frame> frame, const std::string& method, bool newest);
  /// Takes what was measured. Whether it is to be shown before the next picture comes: a map, or the last numbers.
  bool collect();
  /// Something is being measured, or was and is not collected yet.
  bool busy() const { return busy_[0] || busy_[1]; }

  /// True errors are shown, else estimated ones.
  bool is_true() const;
  const Convergence& curves(Half half) const;
  /// All curves of the chart, under their names.
  std::vector<NamedCurve> named_curves() const;
  const PairErrors& pair() const { return pair_; }
  /// Of the chosen view; null: there is none yet.
  std::shared_ptr<const ErrorMap> map() const { return map_; }

 private:
  /// What is measured, each with a share of its own.
  enum Task { truth_task, kept_truth_task, pair_task, map_task, flip_map_task, flip_task, task_count };
  /// Those with FLIP take a second, the others milliseconds: they do not wait for each other.
  static bool is_slow(Task task) { return task == flip_map_task || task == flip_task; }
  struct Side {
    std::shared_ptr<const Scene> scene = std::make_shared<const Scene>();
    std::optional<ReferenceFit> fit;
    Convergence estimated, truth;
    std::shared_ptr<const Frame> frame;
    std::string method;
    bool newest = false;
  };
  /// Edits and passes of the two pictures.
  struct PairId {
    std::uint64_t edit = 0, kept_edit = 0, pass = 0, kept_pass = 0;
    bool operator==(const PairId&) const = default;
  };
  struct Measured {
    ProcessorShare share;
    PairId newest{};     ///< for which this was done
    double seconds = 0;  ///< of rendering, then
  };

  void consider();
  bool wanted(Task task) const;
  bool due(Task task, double now) const;
  bool is_early(Task task, const ComparisonOrder& order) const;
  bool has_grown(Task task, const ComparisonOrder& order, double times) const;
  ComparisonOrder order_of(Task task) const;
  static PairId id_of(const ComparisonOrder& order);
  void start(Task task, double now);
  void take(Task task, const ComparisonOrder& order, const std::string& method, ComparisonResult result);
  void judge(Side& one) const;
  void forget_results();
  static Half half_of(Task task) { return task == kept_truth_task ? Half::kept : Half::current; }
  Side& side(Half half) { return sides_[static_cast<std::size_t>(half)]; }
  const Side& side(Half half) const { return sides_[static_cast<std::size_t>(half)]; }

  std::function<double()> clock_;
  std::shared_ptr<const Reference> reference_;
  ErrorView view_ = ErrorView::none;
  bool split_ = false, resting_ = false, news_ = false;
  int threads_ = 1;
  std::uint64_t generation_ = 0;  ///< results of earlier ones are dropped
  std::array<Side, 2> sides_;
  std::array<Measured, task_count> measured_;
  PairErrors pair_;
  std::shared_ptr<const ErrorMap> map_;
  bool busy_[2] = {false, false};    ///< quick jobs, slow jobs
  JobQueue quick_jobs_, slow_jobs_;  // last: their results use the others
};

}  // namespace tyndall
