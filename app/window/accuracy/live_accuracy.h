#pragma once
#include "app/curves/curve.h"
#include "app/window/accuracy/comparison.h"
#include "app/window/document/job_queue.h"
#include "app/window/system/pacing.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// This room measures how far the pictures on the screen are from the truth, beside the rendering and without holding
/// it up.
namespace tyndall {

/// What is measured. Each has a fraction of the processors of its own.
enum class Measurement { truth, kept_truth, pair, map, flip_map, flip };
inline constexpr std::size_t measurement_count = 6;

/// Those with FLIP take a second, the others milliseconds.
constexpr bool is_slow(Measurement m) { return m == Measurement::flip_map || m == Measurement::flip; }
/// Those that are points of a curve: a picture against the reference.
constexpr bool is_truth(Measurement m) { return m == Measurement::truth || m == Measurement::kept_truth; }
constexpr Half half_of(Measurement m) { return m == Measurement::kept_truth ? Half::kept : Half::current; }

/// A picture as it is, or its clean view.
enum class Kind { raw, clean };

/// One half of the screen; without a split view all of it.
struct ComparedHalf {
  std::shared_ptr<const Scene> scene = std::make_shared<const Scene>();  ///< the one that is rendered now
  std::optional<ReferenceFit> fit;                                       ///< absent: there is no reference
  Convergence estimated, truth, clean_estimated, clean_truth;
  std::shared_ptr<const Frame> frame;  ///< on the screen; null: none yet
  std::string method;                  ///< by which the frame was rendered
  bool newest = false;                 ///< the frame is of `scene`, not of an earlier one
};

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
/// reference or a second half. Measuring takes less than 2 % of the processors' time while they render; only the view
/// of FLIP takes 10 %. For the main thread.
class LiveAccuracy {
 public:
  /// on_result: called from another thread when collect() has something to do; clock: seconds that never go back.
  explicit LiveAccuracy(const std::function<void()>& on_result, std::function<double()> clock = clock_seconds);

  void set_reference(std::shared_ptr<const Reference> reference);  ///< null: none
  const std::shared_ptr<const Reference>& reference() const { return reference_; }
  /// The scene that a half renders from now on.
  void set_scene(Half half, std::shared_ptr<const Scene> scene);
  /// Whether the reference is of that scene; nothing without a reference.
  std::optional<ReferenceFit> fit(Half which) const { return half(which).fit; }
  void set_view(ErrorView view);
  /// Begins or ends a split view. The left half's curves begin and end with it.
  void set_split(bool split);
  bool split() const { return split_; }
  /// Another scene was opened: its curves do not belong to those before.
  void clear();
  /// How many threads render, in all.
  void set_threads(int threads) { threads_ = threads; }

  /// resting: nothing renders, so all that is left is measured at once.
  void set_resting(bool resting);
  /// A picture is on the screen. newest: of the scene that was set last.
  void shown(Half half, std::shared_ptr<const Frame> frame, const std::string& method, bool newest);
  /// Takes the results of what was measured. Returns whether the window should be drawn for them now and not only with
  /// the next picture: there is a new map, or no next picture.
  bool collect();
  /// Whether something is being measured, or was measured and not collected yet.
  bool busy() const { return !quick_.idle() || !slow_.idle(); }

  /// Whether the curves are errors against a reference of this scene; else they are estimates.
  bool is_true() const;
  const Convergence& curves(Half half, Kind kind = Kind::raw) const;
  /// All curves of the chart, under their names.
  std::vector<NamedCurve> named_curves() const;
  const PairErrors& pair() const { return pair_; }
  /// Of the chosen view; null: there is none yet.
  std::shared_ptr<const ErrorMap> map() const { return map_; }

 private:
  /// Edits and passes of the two pictures.
  struct PairId {
    std::uint64_t edit = 0, kept_edit = 0, pass = 0, kept_pass = 0;
    bool operator==(const PairId&) const = default;
  };
  struct Measured {
    ProcessorBudget budget;
    PairId newest{};     ///< the pictures that were measured last
    double seconds = 0;  ///< for which the first of them had been rendered by then
  };

  bool wanted(Measurement what) const;
  ComparisonOrder order_of(Measurement what) const;
  void consider();
  bool due(Measurement what, double now) const;
  bool has_grown(Measurement what, const ComparisonOrder& order, double times) const;
  static PairId id_of(const ComparisonOrder& order);
  void start(Measurement what, double now);
  void take(Measurement what, const ComparisonOrder& order, const std::string& method, ComparisonResult result);
  void renew_maps();
  void forget_results();
  ComparedHalf& half(Half which) { return halves_[static_cast<std::size_t>(which)]; }
  const ComparedHalf& half(Half which) const { return halves_[static_cast<std::size_t>(which)]; }
  Measured& measured(Measurement what) { return measured_[static_cast<std::size_t>(what)]; }
  const Measured& measured(Measurement what) const { return measured_[static_cast<std::size_t>(what)]; }
  JobQueue& worker(Measurement what) { return is_slow(what) ? slow_ : quick_; }

  std::function<double()> clock_;
  std::shared_ptr<const Reference> reference_;
  ErrorView view_ = ErrorView::none;
  bool split_ = false, resting_ = false;
  std::array<ComparedHalf, 2> halves_;
  int threads_ = 1;
  std::array<Measured, measurement_count> measured_;
  std::uint64_t generation_ = 0;  ///< results of earlier ones are dropped
  PairErrors pair_;
  std::shared_ptr<const ErrorMap> map_;
  bool news_ = false;  ///< what collect() returns next
  /// Measurements wait for each other only on the same worker.
  JobQueue quick_, slow_;  // declared last, because their results use the others
};

}  // namespace tyndall
