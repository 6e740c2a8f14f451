#include "app/window/accuracy/live_accuracy.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {

LiveAccuracy::LiveAccuracy(const std::function<void()>& on_result, std::function<double()> clock)
    : clock_(std::move(clock)),
      measured_{{{ProcessorShare(0.003)},
                 {ProcessorShare(0.003)},
                 {ProcessorShare(0.002)},
                 {ProcessorShare(0.01)},
                 {ProcessorShare(0.1)},
                 {ProcessorShare(0.008)}}},
      quick_jobs_(on_result),
      slow_jobs_(on_result) {}

void LiveAccuracy::set_reference(std::shared_ptr<const Reference> reference) {
  reference_ = std::move(reference);
  for (Side& one : sides_) one.truth.clear(), judge(one);
  forget_results();
  consider();
}

void LiveAccuracy::judge(Side& one) const {
  one.fit.reset();
  if (reference_) one.fit = fit_of(*reference_, *one.scene);
}

void LiveAccuracy::set_scene(Half half, std::shared_ptr<const Scene> scene) {
  Side& one = side(half);
  const auto before = one.fit;
  one.scene = std::move(scene);
  judge(one);
  one.newest = false;
  for (const Task task : {map_task, flip_map_task}) measured_[task].share.renew();
  if (one.fit != before) ++generation_, pair_ = {};
}

bool LiveAccuracy::is_true() const {
  const auto fit = side(Half::current).fit;
  return fit == ReferenceFit::fits || fit == ReferenceFit::same_samples;
}

void LiveAccuracy::set_view(ErrorView view) {
  if (view == view_) return;
  view_ = view;
  map_.reset();
  for (const Task task : {map_task, flip_map_task}) measured_[task].newest = {}, measured_[task].share.renew();
  consider();
}

void LiveAccuracy::set_split(bool split) {
  if (split == split_) return;
  split_ = split;
  side(Half::kept) = {};
  forget_results();
}

void LiveAccuracy::clear() {
  for (Side& one : sides_) one.estimated.clear(), one.truth.clear();
  forget_results();
}

/// Drops all results, because they were measured for another pair of pictures. The curves stay.
void LiveAccuracy::forget_results() {
  ++generation_;
  pair_ = {};
  map_.reset();
  for (Measured& task : measured_) task.share.renew(), task.newest = {}, task.seconds = 0;
}

void LiveAccuracy::set_resting(bool resting) {
  resting_ = resting;
  consider();
}

void LiveAccuracy::shown(Half half, std::shared_ptr<const Frame> frame, const std::string& method, bool newest) {
  Side& one = side(half);
  const double error = frame->relative_error, rel_mse = error * error;
  one.estimated.add(frame->edit, method, {frame->seconds, rel_mse, frame->spp, rel_mse});
  one.frame = std::move(frame);
  one.method = method;
  one.newest = newest;
  consider();
}

bool LiveAccuracy::collect() {
  quick_jobs_.collect();
  slow_jobs_.collect();
  return std::exchange(news_, false);
}

const Convergence& LiveAccuracy::curves(Half half) const { return is_true() ? side(half).truth : side(half).estimated; }

std::vector<NamedCurve> LiveAccuracy::named_curves() const {
  return tyndall::named_curves(curves(Half::current), split_ ? &curves(Half::kept) : nullptr);
}

bool LiveAccuracy::wanted(Task task) const {
  const bool newest = side(Half::current).newest, kept_newest = side(Half::kept).newest;
  switch (task) {
    case map_task:
      return view_ == ErrorView::error;
    case flip_map_task:
      return view_ == ErrorView::flip;
    case truth_task:
      return is_true() && newest;
    case kept_truth_task:
      return split_ && is_true() && kept_newest;
    case pair_task:
      return split_ && newest && kept_newest;
    case flip_task:
      return newest && (split_ ? kept_newest : is_true());
    case task_count:
      break;
  }
  return false;
}

ComparisonOrder LiveAccuracy::order_of(Task task) const {
  const bool of_kept = task == kept_truth_task, truth = of_kept || task == truth_task;
  ComparisonOrder order;
  order.frame = side(of_kept ? Half::kept : Half::current).frame;
  if (split_ && !truth)
    order.kept = side(Half::kept).frame;
  else
    order.reference = reference_;
  if (split_ && !truth && !order.kept) return {};
  if (task == map_task || task == flip_map_task) order.map = view_;
  order.flip = task == flip_task;
  order.independent = side(half_of(task)).fit == ReferenceFit::fits;
  return order;
}

bool LiveAccuracy::due(Task task, double now) const {
  if (!wanted(task)) return false;
  const ComparisonOrder order = order_of(task);
  const Measured& measured = measured_[task];
  if (!can_compare(order)) return false;
  if (id_of(order) == measured.newest) return false;
  if (resting_) return true;
  // FLIP takes a second and says little about the noise of the first samples: it waits for 16.
  if (task == flip_task && (order.frame->spp < 16 || !has_grown(task, order, 2))) return false;
  return measured.share.due(now) || is_early(task, order);
}

/// Whether a point is measured before its share of the processors allows it: at the start of a curve the error falls
/// fast, so points are wanted close to each other. After a second, what they took is little again.
bool LiveAccuracy::is_early(Task task, const ComparisonOrder& order) const {
  return (task == truth_task || task == kept_truth_task) && has_grown(task, order, 1.25);
}

/// Whether the picture has rendered `times` times as long as when this was measured last, or has begun anew.
bool LiveAccuracy::has_grown(Task task, const ComparisonOrder& order, double times) const {
  const Measured& measured = measured_[task];
  const double seconds = order.frame->seconds;
  return order.frame->edit != measured.newest.edit || seconds > times * measured.seconds || seconds < measured.seconds;
}

LiveAccuracy::PairId LiveAccuracy::id_of(const ComparisonOrder& order) {
  PairId id{order.frame->edit, 0, order.frame->pass, 0};
  if (order.kept) id.kept_edit = order.kept->edit, id.kept_pass = order.kept->pass;
  return id;
}

void LiveAccuracy::consider() {
  const double now = clock_();
  for (int k = 0; k < task_count; ++k) {
    const Task task = static_cast<Task>(k);
    if (!busy_[is_slow(task)] && due(task, now)) start(task, now);
  }
}

void LiveAccuracy::start(Task task, double now) {
  const ComparisonOrder order = order_of(task);
  bool& busy = busy_[is_slow(task)];
  busy = true;
  measured_[task].newest = id_of(order);
  measured_[task].seconds = order.frame->seconds;
  JobQueue& jobs = is_slow(task) ? slow_jobs_ : quick_jobs_;
  jobs.run([this, task, order, now, &busy, method = side(half_of(task)).method, generation = generation_] {
    return [this, task, order, now, &busy, method, generation, result = compare(order)]() mutable {
      busy = false;
      measured_[task].share.spent(now, result.cpu_seconds, threads_);
      if (generation == generation_) take(task, order, method, std::move(result));
      consider();
    };
  });
}

void LiveAccuracy::take(Task task, const ComparisonOrder& order, const std::string& method, ComparisonResult result) {
  news_ = news_ || resting_ || !result.map.empty();
  const Frame& frame = *order.frame;
  const bool truth = task == truth_task || task == kept_truth_task;
  if (truth) {
    const double noise = frame.relative_error * frame.relative_error;
    side(half_of(task)).truth.add(frame.edit, method, {frame.seconds, result.rel_mse, frame.spp, noise});
  }
  if (truth && split_) return;  // no pair of halves
  if (!is_slow(task)) pair_.rel_mse = result.rel_mse;
  if (result.flip) pair_.flip = result.flip, pair_.flip_spp = frame.spp;
  if (!result.map.empty() && order.map == view_)
    map_ = std::make_shared<const ErrorMap>(ErrorMap{frame.width, frame.height, order.map, std::move(result.map)});
}

}  // namespace tyndall
