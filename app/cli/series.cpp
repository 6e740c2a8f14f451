#include "app/cli/series.h"

#include "core/render/plan.h"

#include <limits>
#include <utility>

namespace tyndall {

RenderResult Series::render(RenderJob& job, const std::string& name) {
  const ProgressGoal goal = goal_of(job);
  const std::string place = name + " (" + std::to_string(made_ + 1) + "/" + std::to_string(count_) + "), ";
  const auto show = [&](const RenderProgress& now) {
    if (name.empty()) return report_.show(now.seconds, progress_fraction(now, goal), progress_text(now, goal));
    const double done = (static_cast<double>(made_) + progress_fraction(now, goal)) / static_cast<double>(count_);
    const double seconds = seconds_ + now.seconds;
    std::string text = place + std::to_string(now.spp) + (goal.spp > 0 ? "/" + std::to_string(goal.spp) : "") + " spp";
    if (done > 0) text += ", " + duration(seconds * (1 - done) / done) + " left";
    report_.show(seconds, done, text);
  };
  RenderResult result = tyndall::render(job, signals_, report_, show);
  seconds_ += result.seconds;
  if (!result.interrupted) ++made_;
  return result;
}

/// Tells what users should know of a picture; what holds for several, once.
void Series::warn(const RenderJob& job, const RenderOutcome& outcome, const std::string& name) {
  for (const std::string& text : warnings(job, outcome))
    if (told_.insert(text).second)
      report_.say((name.empty() ? "" : name + ": ") + text + (count_ > 1 ? " (told once for all)" : ""));
}

bool Series::make(RenderJob& job, const std::string& name, const PictureSteps& steps) {
  if (begun_++ == 0) tell_remarks(job);
  const RenderResult result = render(job, name);
  const RenderOutcome outcome = outcome_of(job, result, result.interrupted);
  if (steps.rendered) steps.rendered(outcome);
  if (outcome.picture.totals.max_taken == 0) return true;
  warn(job, outcome, name);
  if (steps.writing && !result.interrupted) steps.writing();
  const bool written = job.is_there || write(job, outcome);
  if (steps.made && !result.interrupted) steps.made(outcome, written);
  show_last(job, outcome);
  return written;
}

void take_film(RenderJob& job, Film film) {
  job.options.spp = labelled_spp(film);
  job.options.time_limit = std::numeric_limits<double>::infinity();
  job.options.target_error = 0;
  job.samples_before = totals(film).samples;
  job.begin.film = std::move(film);
}

}  // namespace tyndall
