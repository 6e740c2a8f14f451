#include "app/window/accuracy/live_accuracy.h"

#include <utility>

namespace tyndall {
namespace {

constexpr const char* clean_suffix = " + clean";

std::optional<ReferenceFit> fit_to(const std::shared_ptr<const Reference>& reference, const ComparedHalf& half) {
  return reference ? std::optional(fit_of(*reference, *half.scene)) : std::nullopt;
}

}  // namespace

LiveAccuracy::LiveAccuracy(const std::function<void()>& on_result, std::function<double()> clock)
    : clock_(std::move(clock)),
      measured_{{{{0.003}}, {{0.003}}, {{0.002}}, {{0.01}}, {{0.1}}, {{0.008}}}},
      quick_(on_result),
      slow_(on_result) {}

void LiveAccuracy::set_reference(std::shared_ptr<const Reference> reference) {
  reference_ = std::move(reference);
  for (ComparedHalf& one : halves_) one.truth.clear(), one.clean_truth.clear(), one.fit = fit_to(reference_, one);
  forget_results();
  consider();
}

void LiveAccuracy::set_scene(Half which, std::shared_ptr<const Scene> scene) {
  ComparedHalf& one = half(which);
  one.scene = std::move(scene);
  one.newest = false;
  renew_maps();
  const auto before = std::exchange(one.fit, fit_to(reference_, one));
  if (one.fit != before) ++generation_, pair_ = {};
}

void LiveAccuracy::set_view(ErrorView view) {
  if (std::exchange(view_, view) == view) return;
  map_.reset();
  renew_maps();
  for (const Measurement what : {Measurement::map, Measurement::flip_map}) measured(what).newest = {};
  consider();
}

/// The user waits for a map after each edit, so its fraction of the processors does not hold it back.
void LiveAccuracy::renew_maps() {
  for (const Measurement what : {Measurement::map, Measurement::flip_map}) measured(what).budget.renew();
}

void LiveAccuracy::set_split(bool split) {
  if (std::exchange(split_, split) == split) return;
  half(Half::kept) = {};
  forget_results();
}

void LiveAccuracy::clear() {
  for (ComparedHalf& one : halves_) one.estimated = one.truth = one.clean_estimated = one.clean_truth = {};
  forget_results();
}

/// Drops all results, because they were measured for another pair of pictures. The curves stay.
void LiveAccuracy::forget_results() {
  ++generation_;
  pair_ = {};
  map_.reset();
  for (Measured& one : measured_) one.budget.renew(), one.newest = {}, one.seconds = 0;
}

void LiveAccuracy::set_resting(bool resting) {
  if (std::exchange(resting_, resting) != resting) consider();
}

void LiveAccuracy::shown(Half which, std::shared_ptr<const Frame> frame, const std::string& method, bool newest) {
  ComparedHalf& one = half(which);
  const double error = frame->relative_error, rel_mse = error * error;
  one.estimated.add(frame->edit, method, {frame->seconds, rel_mse, frame->spp, rel_mse});
  if (const auto& clean = frame->clean; clean && clean->spp > 0) {
    const double rest = clean->relative_error * clean->relative_error;
    one.clean_estimated.add(frame->edit, method + clean_suffix, {clean->seconds, rest, clean->spp, rest});
  }
  one.frame = std::move(frame);
  one.method = method;
  one.newest = newest;
  consider();
}

const Convergence& LiveAccuracy::curves(Half which, Kind kind) const {
  const ComparedHalf& one = half(which);
  if (kind == Kind::clean) return is_true() ? one.clean_truth : one.clean_estimated;
  return is_true() ? one.truth : one.estimated;
}

bool LiveAccuracy::is_true() const {
  const auto fit = half(Half::current).fit;
  return fit == ReferenceFit::fits || fit == ReferenceFit::same_samples;
}

std::vector<NamedCurve> LiveAccuracy::named_curves() const {
  return tyndall::named_curves(
      curves(Half::current), split_ ? &curves(Half::kept) : nullptr,
      half(Half::current).frame && half(Half::current).frame->clean ? &curves(Half::current, Kind::clean) : nullptr);
}

/// Whether there is a use for this measurement.
bool LiveAccuracy::wanted(Measurement what) const {
  const bool newest = half(Half::current).newest, kept_newest = half(Half::kept).newest;
  if (what == Measurement::map) return view_ == ErrorView::error;
  if (what == Measurement::flip_map) return view_ == ErrorView::flip;
  if (what == Measurement::truth) return is_true() && newest;
  if (what == Measurement::kept_truth) return split_ && is_true() && kept_newest;
  if (what == Measurement::pair) return split_ && newest && kept_newest;
  return newest && (split_ ? kept_newest : is_true());  // Measurement::flip
}

ComparisonOrder LiveAccuracy::order_of(Measurement what) const {
  const ComparedHalf& measured = half(half_of(what));
  ComparisonOrder order;
  order.frame = measured.frame;
  if (!split_ || is_truth(what))
    order.reference = reference_;
  else
    order.kept = half(Half::kept).frame;
  if (what == Measurement::map || what == Measurement::flip_map) order.map = view_;
  order.flip = what == Measurement::flip;
  const ErrorCurve& known = measured.clean_truth.current();
  const CleanFrame* clean = is_truth(what) && order.frame ? order.frame->clean.get() : nullptr;
  order.clean = clean && clean->spp > 0 &&
                (known.edit != order.frame->edit || known.points.empty() || known.points.back().spp != clean->spp);
  order.independent = measured.fit == ReferenceFit::fits;
  return order;
}

bool LiveAccuracy::collect() {
  quick_.collect();
  slow_.collect();
  return std::exchange(news_, false);
}

bool LiveAccuracy::due(Measurement what, double now) const {
  if (!wanted(what)) return false;
  const ComparisonOrder order = order_of(what);
  if (!can_compare(order) || id_of(order) == measured(what).newest) return false;
  if (resting_) return true;
  // FLIP takes a second and says little about the noise of the first samples: it waits for 16.
  if (what == Measurement::flip && (order.frame->spp < 16 || !has_grown(what, order, 2))) return false;
  // At the start of a curve the error falls fast, so points are wanted close to each other, although measuring has used
  // up its fraction of the processors; over the first second they take little time in all.
  return measured(what).budget.due(now) || (is_truth(what) && has_grown(what, order, 1.25));
}

/// Whether the picture has rendered `times` times as long as when this was measured last, or has begun anew.
bool LiveAccuracy::has_grown(Measurement what, const ComparisonOrder& order, double times) const {
  const Measured& last = measured(what);
  const double seconds = order.frame->seconds;
  return order.frame->edit != last.newest.edit || seconds > times * last.seconds || seconds < last.seconds;
}

LiveAccuracy::PairId LiveAccuracy::id_of(const ComparisonOrder& order) {
  PairId id{order.frame->edit, 0, order.frame->pass, 0};
  if (order.kept) id.kept_edit = order.kept->edit, id.kept_pass = order.kept->pass;
  return id;
}

/// Starts everything that is due and whose worker is free.
void LiveAccuracy::consider() {
  const double now = clock_();
  for (std::size_t k = 0; k < measurement_count; ++k) {
    const auto what = static_cast<Measurement>(k);
    if (worker(what).idle() && due(what, now)) start(what, now);
  }
}

void LiveAccuracy::start(Measurement what, double now) {
  const ComparisonOrder order = order_of(what);
  measured(what).newest = id_of(order);
  measured(what).seconds = order.frame->seconds;
  const std::string& method = half(half_of(what)).method;
  worker(what).run([this, what, order, now, method, generation = generation_] {
    std::optional<ComparisonResult> found;
    try {
      found = compare(order);
    } catch (const std::bad_alloc&) {
      // No memory is left for it. The next picture is tried again.
    }
    return [this, what, order, now, method, generation, result = std::move(found)]() mutable {
      if (result) measured(what).budget.spent(now, result->cpu_seconds, threads_);
      if (result && generation == generation_) take(what, order, method, std::move(*result));
      consider();
    };
  });
}

void LiveAccuracy::take(Measurement what, const ComparisonOrder& order, const std::string& method,
                        ComparisonResult result) {
  news_ = news_ || resting_ || !result.map.empty();
  const Frame& frame = *order.frame;
  if (is_truth(what)) {
    ComparedHalf& one = half(half_of(what));
    const double noise = frame.relative_error * frame.relative_error;
    one.truth.add(frame.edit, method, {frame.seconds, result.rel_mse, frame.spp, noise});
    if (result.clean_rel_mse)
      one.clean_truth.add(frame.edit, method + clean_suffix,
                          {frame.clean->seconds, *result.clean_rel_mse, frame.clean->spp, 0});
    if (split_) return;  // this was no comparison of the two halves
  }
  if (!is_slow(what)) pair_.rel_mse = result.rel_mse;
  if (result.flip) pair_.flip = result.flip, pair_.flip_spp = frame.spp;
  if (!result.map.empty() && order.map == view_)
    map_ = std::make_shared<const ErrorMap>(ErrorMap{frame.width, frame.height, order.map, std::move(result.map)});
}

}  // namespace tyndall
