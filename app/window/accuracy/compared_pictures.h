#pragma once
#include "app/curves/convergence.h"
#include "app/window/accuracy/comparison.h"
#include "app/window/accuracy/half.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Which pictures are on the screen and what they are measured against.
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

/// Follows what is on the screen, and tells what can be measured there. It measures nothing itself and has no clock.
class ComparedPictures {
 public:
  void set_reference(std::shared_ptr<const Reference> reference);
  const std::shared_ptr<const Reference>& reference() const { return reference_; }
  /// Returns whether the reference fits the new scene in another way than the one before.
  bool set_scene(Half half, std::shared_ptr<const Scene> scene);
  /// Returns whether that is another view.
  bool set_view(ErrorView view);
  ErrorView view() const { return view_; }
  /// Begins or ends a split view; the left half begins without curves. Returns whether that changes anything.
  bool set_split(bool split);
  bool split() const { return split_; }
  void forget_curves();
  void shown(Half half, std::shared_ptr<const Frame> frame, const std::string& method, bool newest);
  /// Adds a measured point to a half's curve.
  void add_truth(Half half, const Frame& frame, const std::string& method, double rel_mse);
  /// The same of the frame's clean view.
  void add_clean_truth(Half half, const Frame& frame, const std::string& method, double rel_mse);

  const ComparedHalf& half(Half which) const { return halves_[static_cast<std::size_t>(which)]; }
  /// Whether errors are measured against a reference of this scene; else they are estimates.
  bool is_true() const;
  const Convergence& curves(Half which, Kind kind = Kind::raw) const;
  std::vector<NamedCurve> named_curves() const;

  /// Whether there is a use for this measurement.
  bool wanted(Measurement what) const;
  ComparisonOrder order_of(Measurement what) const;

 private:
  void judge(ComparedHalf& half) const;
  ComparedHalf& changed(Half which) { return halves_[static_cast<std::size_t>(which)]; }

  std::shared_ptr<const Reference> reference_;
  ErrorView view_ = ErrorView::none;
  bool split_ = false;
  std::array<ComparedHalf, 2> halves_;
};

}  // namespace tyndall
