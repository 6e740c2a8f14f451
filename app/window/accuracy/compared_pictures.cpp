#include "app/window/accuracy/compared_pictures.h"

#include <utility>

namespace tyndall {
namespace {

constexpr const char* clean_suffix = " + clean";

}  // namespace

void ComparedPictures::set_reference(std::shared_ptr<const Reference> reference) {
  reference_ = std::move(reference);
  for (ComparedHalf& one : halves_) one.truth.clear(), one.clean_truth.clear(), judge(one);
}

void ComparedPictures::judge(ComparedHalf& half) const {
  half.fit.reset();
  if (reference_) half.fit = fit_of(*reference_, *half.scene);
}

bool ComparedPictures::set_scene(Half which, std::shared_ptr<const Scene> scene) {
  ComparedHalf& one = changed(which);
  const auto before = one.fit;
  one.scene = std::move(scene);
  judge(one);
  one.newest = false;
  return one.fit != before;
}

bool ComparedPictures::set_view(ErrorView view) { return std::exchange(view_, view) != view; }

bool ComparedPictures::set_split(bool split) {
  if (split == split_) return false;
  split_ = split;
  changed(Half::kept) = {};
  return true;
}

void ComparedPictures::forget_curves() {
  for (ComparedHalf& one : halves_) one.estimated = one.truth = one.clean_estimated = one.clean_truth = {};
}

void ComparedPictures::shown(Half which, std::shared_ptr<const Frame> frame, const std::string& method, bool newest) {
  ComparedHalf& one = changed(which);
  const double error = frame->relative_error, rel_mse = error * error;
  one.estimated.add(frame->edit, method, {frame->seconds, rel_mse, frame->spp, rel_mse});
  if (const auto& clean = frame->clean; clean && clean->spp > 0) {
    const double rest = clean->relative_error * clean->relative_error;
    one.clean_estimated.add(frame->edit, method + clean_suffix, {clean->seconds, rest, clean->spp, rest});
  }
  one.frame = std::move(frame);
  one.method = method;
  one.newest = newest;
}

void ComparedPictures::add_truth(Half which, const Frame& frame, const std::string& method, double rel_mse) {
  const double noise = frame.relative_error * frame.relative_error;
  changed(which).truth.add(frame.edit, method, {frame.seconds, rel_mse, frame.spp, noise});
}

void ComparedPictures::add_clean_truth(Half which, const Frame& frame, const std::string& method, double rel_mse) {
  changed(which).clean_truth.add(frame.edit, method + clean_suffix,
                                 {frame.clean->seconds, rel_mse, frame.clean->spp, 0});
}

const Convergence& ComparedPictures::curves(Half which, Kind kind) const {
  const ComparedHalf& one = half(which);
  if (kind == Kind::clean) return is_true() ? one.clean_truth : one.clean_estimated;
  return is_true() ? one.truth : one.estimated;
}

bool ComparedPictures::is_true() const {
  const auto fit = half(Half::current).fit;
  return fit == ReferenceFit::fits || fit == ReferenceFit::same_samples;
}

std::vector<NamedCurve> ComparedPictures::named_curves() const {
  return tyndall::named_curves(
      curves(Half::current), split_ ? &curves(Half::kept) : nullptr,
      half(Half::current).frame && half(Half::current).frame->clean ? &curves(Half::current, Kind::clean) : nullptr);
}

bool ComparedPictures::wanted(Measurement what) const {
  const bool newest = half(Half::current).newest, kept_newest = half(Half::kept).newest;
  switch (what) {
    case Measurement::map:
      return view_ == ErrorView::error;
    case Measurement::flip_map:
      return view_ == ErrorView::flip;
    case Measurement::truth:
      return is_true() && newest;
    case Measurement::kept_truth:
      return split_ && is_true() && kept_newest;
    case Measurement::pair:
      return split_ && newest && kept_newest;
    case Measurement::flip:
      return newest && (split_ ? kept_newest : is_true());
  }
  return false;
}

ComparisonOrder ComparedPictures::order_of(Measurement what) const {
  const bool between_halves = split_ && !is_truth(what);
  const ComparedHalf& measured = half(half_of(what));
  ComparisonOrder order;
  order.frame = measured.frame;
  if (between_halves)
    order.kept = half(Half::kept).frame;
  else
    order.reference = reference_;
  if (between_halves && !order.kept) return {};
  if (what == Measurement::map || what == Measurement::flip_map) order.map = view_;
  order.flip = what == Measurement::flip;
  const ErrorCurve& known = measured.clean_truth.current();
  const CleanFrame* clean = is_truth(what) && order.frame ? order.frame->clean.get() : nullptr;
  order.clean = clean && clean->spp > 0 &&
                (known.edit != order.frame->edit || known.points.empty() || known.points.back().spp != clean->spp);
  order.independent = measured.fit == ReferenceFit::fits;
  return order;
}

}  // namespace tyndall
