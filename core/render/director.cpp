#include "core/render/director.h"

#include "core/accuracy/error.h"
#include "core/render/caustics.h"
#include "core/render/plan.h"
#include "core/render/preview.h"
#include "core/render/rare.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr double pass_budget = 0.15;  // seconds: how often a new picture should come while it sharpens

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// Samples a pixel at which to stop: a paused renderer still shows what it was given.
std::uint32_t limit_of(const Mailbox& mail) { return mail.paused ? std::min(mail.limit, 1u) : mail.limit; }

/// Whether only the view of the scene changed: then fluency counts more than sharpness.
bool only_camera_differs(const Scene& a, const Scene& b) {
  Scene c = a;
  c.camera = b.camera;
  return c == b;
}

}  // namespace

Director::Director(Mailbox& mail, Kernels kernels, int threads, std::function<void()> on_frame)
    : mail_(mail), kernels_(kernels), on_frame_(std::move(on_frame)), crew_(std::make_unique<Crew>(threads)) {}

void Director::run(const std::stop_token& stop) {
  const std::stop_callback leave(stop, [this] { mail_.give_up = true; });
  while (wait_for_work(stop)) {
    take_orders();
    if (stop.stop_requested()) return;
    if (!compiled_ || !has_work()) continue;
    const Clock::time_point start = Clock::now();
    Pass& pass = current_pass();
    const bool whole = pass.run(*crew_, kernels_, scene_view_->view(), film_, mail_.give_up);
    pass_seconds_ += seconds_between(start, Clock::now());
    if (whole) finish_pass(pass_seconds_);
  }
}

bool Director::has_work() const { return compiled_ && compiled_->width > 0 && taken_ < limit_; }

/// Sleeps until there is something to do; false: stop.
bool Director::wait_for_work(const std::stop_token& stop) {
  std::unique_lock lock(mail_.mutex);
  return mail_.wake.wait(lock, stop, [&] {
    return mail_.scene || mail_.restart || mail_.frame_outdated || !mail_.films.empty() ||
           (compiled_ && taken_ < limit_of(mail_)) || (mail_.threads > 0 && mail_.threads != crew_->size());
  }) && !stop.stop_requested();
}

void Director::take_orders() {
  std::unique_ptr<Scene> scene;
  bool restart = false, frame_outdated = false;
  int threads = 0;
  const Clock::time_point before = submitted_;
  {
    const std::lock_guard lock(mail_.mutex);
    scene = std::move(mail_.scene);
    restart = std::exchange(mail_.restart, false);
    frame_outdated = std::exchange(mail_.frame_outdated, false);
    view_ = mail_.view;
    threads = mail_.threads;
    limit_ = limit_of(mail_);
    if (scene) edit_ = mail_.edit, submitted_ = mail_.submitted;
    mail_.give_up = false;
  }
  if (threads > 0 && threads != crew_->size()) crew_ = std::make_unique<Crew>(threads);
  if (scene) {
    take_scene(std::move(*scene), before);
  } else if (restart && compiled_) {
    submitted_ = Clock::now();
    start_over();
  }
  answer_films();
  if (frame_outdated && compiled_ && (taken_ > 0 || coarse_done_)) publish();
}

void Director::take_scene(Scene scene, Clock::time_point before) {
  try {
    auto compiled = std::make_shared<const RenderScene>(compile(scene, compiled_.get()));
    const bool only_camera = compiled_ && only_camera_differs(scene_, scene);
    budget_ = picture_budget(only_camera, seconds_between(before, submitted_));
    compiled_ = std::move(compiled);
    scene_view_ = std::make_unique<SceneViewOf>(*compiled_);
    scene_ = std::move(scene);
    first_hits_.clear();
    costs_due_ = true;
    chance_of_caustics_.reset();
    start_over();
    const std::lock_guard lock(mail_.mutex);
    mail_.compiled = compiled_;
    mail_.problem = nullptr;
  } catch (const std::exception& e) {
    if (compiled_ && film_.pixels.size() != static_cast<std::size_t>(pixels())) compiled_.reset();
    {
      const std::lock_guard lock(mail_.mutex);
      mail_.problem = std::make_shared<const RenderProblem>(RenderProblem{edit_, e.what()});
    }
    if (on_frame_) on_frame_();
  }
}

void Director::start_over() {
  const Region all{0, 0, compiled_->width, compiled_->height};
  if (film_.pixels.size() == static_cast<std::size_t>(pixels())) {  // the first pass replaces what the pixels hold
    film_.width = compiled_->width, film_.height = compiled_->height, film_.region = all,
    film_.unit = compiled_->film_unit, film_.cut_throughput = {};
    film_.planned.clear();
  } else {
    film_ = make_film(compiled_->width, compiled_->height, all, 0, compiled_->film_unit);
  }
  pass_.reset();
  taken_ = 0;
  coarse_done_ = false;
  seconds_ = pass_seconds_ = 0;
  rejected_ = truncated_ = 0;
  error_ = std::numeric_limits<double>::infinity();
  rare_bright_paths_ = false;
  next_rare_check_ = 8;
  next_estimate_ = Clock::now();
  first_picture_due_ = true;
  step_ = preview_step(pixels(), first_paths_per_second_, std::max(budget_ - picture_seconds_, budget_ / 4), step_);
}

/// The pass that is under way, or the next: coarse, the rest of the first sample, then more and more samples.
Pass& Director::current_pass() {
  if (pass_) return *pass_;
  const Region all = film_.region;
  pass_seconds_ = 0;
  pass_is_coarse_ = taken_ == 0 && !coarse_done_ && step_ > 1;
  pass_end_ = 1;
  if (pass_is_coarse_)
    pass_ = std::make_unique<Pass>(all, 0, 1, step_);
  else if (taken_ == 0)
    pass_ = std::make_unique<Pass>(all, 0, 1, 1, coarse_done_ ? step_ : 0);
  else
    pass_ = further_pass();
  return *pass_;
}

std::unique_ptr<Pass> Director::further_pass() {
  const std::uint32_t more = pass_samples(taken_, pixels(), paths_per_second_, pass_budget);
  pass_end_ = std::min(taken_ + more, limit_);
  if (scene_.render.adaptive) pass_end_ = std::min(pass_end_, end_of_round(film_, taken_, crew_.get()));
  if (planned_unevenly(film_)) return std::make_unique<Pass>(film_, counts_at(film_, pass_end_));
  return std::make_unique<Pass>(film_.region, taken_, pass_end_);
}

void Director::finish_pass(double seconds) {
  seconds_ += seconds;
  mrays_per_s_ = static_cast<double>(pass_->rays()) / seconds * 1e-6;
  paths_per_second_ = static_cast<double>(pass_->paths()) / seconds;
  // Passes of one sample are slower than the ones that follow.
  if (pass_end_ == 1)
    first_paths_per_second_ =
        first_paths_per_second_ > 0 ? std::sqrt(first_paths_per_second_ * paths_per_second_) : paths_per_second_;
  if (pass_is_coarse_)
    coarse_done_ = true;
  else
    taken_ = pass_end_;
  rejected_ += pass_->rejected();
  truncated_ += pass_->truncated();
  pass_.reset();
  if (taken_ >= 2 && (taken_ < 16 || Clock::now() >= next_estimate_ || taken_ >= limit_)) {
    error_ = estimated_relative_error(film_, crew_.get());
    next_estimate_ = Clock::now() + std::chrono::milliseconds(400);
  }
  look_for_rare_paths();
  publish();
}

/// Whenever the samples have doubled: it takes longer than the estimate.
void Director::look_for_rare_paths() {
  if (taken_ < next_rare_check_) return;
  if (!chance_of_caustics_) chance_of_caustics_ = chance_of_caustics(scene_);
  rare_bright_paths_ = has_rare_bright_paths(film_, taken_, *chance_of_caustics_, crew_.get());
  next_rare_check_ = 2 * taken_;
}

/// Until they are found, the old ones are shown: edits that follow each other closely interrupt this.
void Director::find_due_costs() {
  if (!costs_due_) return;
  std::vector<float> found = find_costs(kernels_, scene_view_->view(), *crew_, mail_.give_up);
  if (found.empty()) return;
  costs_ = std::move(found);
  costs_due_ = false;
}

void Director::draw(std::vector<float>& rgba) {
  switch (view_) {
    case View::beauty:
      beauty_rgba(film_, taken_ == 0 ? step_ : 1, *crew_, rgba);
      return;
    case View::noise:
      rgba = taken_ == 0 ? grey_rgba(film_.pixels.size(), 1) : noise_rgba(film_);
      return;
    case View::samples:
      rgba = taken_ == 0 ? grey_rgba(film_.pixels.size(), 0) : samples_rgba(film_);
      return;
    case View::cost:
      find_due_costs();
      rgba = costs_.size() == film_.pixels.size() ? relative_rgba(costs_) : grey_rgba(film_.pixels.size(), 0);
      return;
    case View::albedo:
    case View::normal:
    case View::depth:
      break;
  }
  if (first_hits_.empty()) first_hits_ = find_first_hits(kernels_, scene_view_->view(), *crew_);
  rgba = first_hit_rgba(first_hits_, view_);
}

void Director::publish() {
  const std::shared_ptr<Frame> frame = frame_memory_.take();
  frame->edit = edit_;
  frame->pass = ++frames_;
  frame->width = film_.width, frame->height = film_.height;
  const Clock::time_point start = Clock::now();
  draw(frame->rgba);
  if (view_ != View::beauty && taken_ > 0) beauty_rgba(film_, 1, *crew_, frame->beauty);
  picture_seconds_ = seconds_between(start, Clock::now());
  if (first_picture_due_) first_picture_ms_ = 1000 * seconds_between(submitted_, Clock::now());
  first_picture_due_ = false;
  frame->view = view_;
  frame->step = taken_ == 0 ? step_ : 1;
  frame->spp = taken_;
  frame->finished = taken_ >= limit_;
  frame->relative_error = error_;
  frame->rare_bright_paths = rare_bright_paths_;
  frame->seconds = seconds_;
  frame->mrays_per_s = mrays_per_s_;
  frame->first_picture_ms = first_picture_ms_;
  frame->rejected = rejected_, frame->truncated = truncated_;
  const double samples =
      static_cast<double>(taken_) * static_cast<double>(pixels()) + (pass_ ? static_cast<double>(pass_->paths()) : 0);
  if (samples > 0) frame->cut_throughput = film_.cut_throughput.value() / samples;
  frame->film_bytes = film_.pixels.size() * sizeof(FilmPixel);
  frame->isa = kernels_.isa;
  frame->lanes = kernels_.lanes, frame->threads = crew_->size();
  {
    const std::lock_guard lock(mail_.mutex);
    frame->finished = taken_ >= mail_.limit;
    mail_.latest = frame;
  }
  if (on_frame_) on_frame_();
}

/// Between passes, when a film has the samples it is to have everywhere, unless the rest of a pass is not to come.
void Director::answer_films() {
  if (pass_ && has_work()) return;
  std::vector<std::promise<Film>> films;
  {
    const std::lock_guard lock(mail_.mutex);
    films.swap(mail_.films);
  }
  for (auto& film : films) film.set_value(taken_ > 0 ? film_ : Film{});
}

}  // namespace tyndall
