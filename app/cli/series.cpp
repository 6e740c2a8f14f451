#include "app/cli/series.h"

#include "app/cli/kept_pictures.h"
#include "app/cli/live_view.h"
#include "app/files/checkpoint.h"
#include "app/files/memory.h"
#include "app/files/outputs.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/render/plan.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

namespace tyndall {
namespace {

RunFigures figures(const RenderJob& job, const RenderOutcome& outcome) {
  return {job.loaded.name,    *job.prepared,     outcome.result,           outcome.picture,
          job.samples_before, job.seconds_build, seconds_since(job.start), job.threads.from};
}

/// What an image or film at that place carries beside the picture.
Embedded embedded_in(const RenderJob& job, const Film& film, const std::filesystem::path& file, std::string stats,
                     bool unfinished) {
  if (job.loaded.is_picture)
    return {"", "{\"own_samples\": " + nlohmann::json(job.own.reason()).dump() + "}", {}, false};
  return {embedded_scene(job.loaded.scene, job.loaded.folder, film, file), std::move(stats),
          label_for(job.loaded.scene, job.kernels.isa, unfinished)};
}

/// Writes all that can be written; false if something could not. at_end: also what goes to standard output or pipes.
bool write(const RenderJob& job, const RenderOutcome& outcome, bool at_end = true) {
  const Film& film = outcome.result.film;
  const auto embedded = [&](const std::filesystem::path& file) {
    return embedded_in(job, film, file, embedded_stats_text(figures(job, outcome)), outcome.unfinished);
  };
  const auto layers = [&] { return layers_of(*job.prepared, film, outcome.result.kernels); };
  const CleanPicture* clean = outcome.result.clean ? &*outcome.result.clean : nullptr;
  std::vector<std::filesystem::path> files = job.command.outputs;
  if (!at_end) std::erase_if(files, is_stream);
  if (job.whole_only && outcome.unfinished)
    std::erase_if(files, [&](const auto& file) { return file != job.begin.place.output; });
  auto problems = write_images(
      {film, outcome.picture.image, job.loaded.scene.display, embedded, layers, clean, job.command.form}, files);
  const std::filesystem::path& stats = job.command.stats;
  try {
    if (!stats.empty() && (at_end || !is_stream(stats))) write_text_or_rescue(stats, stats_text(figures(job, outcome)));
  } catch (const std::exception& error) {
    problems.emplace_back(error.what());
  }
  for (const std::string& problem : problems) complain(problem);
  std::error_code ignored;  // what the file beside the output holds is in the output now
  const std::filesystem::path apart = job.begin.place.beside();
  if (at_end && problems.empty() && !apart.empty()) std::filesystem::remove(apart, ignored);
  return problems.empty();
}

/// Writes the picture so far in the middle of a render. What cannot be written is told, and the render goes on.
void write_so_far(const RenderJob& job, const RenderResult& result) {
  try {
    if (totals(result.film).max_taken == 0) return;
    const RenderOutcome outcome{result, finished_picture(*job.prepared, result), true};
    const std::string uneven = uneven_text(job.loaded.scene, outcome.picture.totals);
    if (!uneven.empty()) complain(uneven);
    write(job, outcome, false);
  } catch (const std::exception& error) {
    complain(std::string("SIGUSR1: the picture so far was not written: ") + error.what());
  }
}

std::string viewer_text(const std::string& problem) {
  return "--watch-at: " + problem + "; the render goes on without it";
}

/// Shows the picture in the viewer whenever that is due, beside what else is done with the film.
void add_view(LiveView& view, ProgressReport& report, RenderBreaks& breaks) {
  const auto others_due = std::make_shared<bool>(false);
  breaks.film_due = [&view, &report, others = std::move(breaks.film_due), others_due] {
    if (const auto problem = view.problem()) report.say(viewer_text(*problem));
    *others_due = *others_due || (others && others());
    return *others_due || view.due();
  };
  breaks.take_film = [&view, others = std::move(breaks.take_film), others_due](const Film& film, ThreadPool& pool) {
    if (std::exchange(*others_due, false)) others(film, pool);
    if (view.due()) view.take(film, pool);
  };
}

/// What is done while the render goes on: checkpoints, or saying that there are none, and SIGUSR1.
RenderBreaks breaks_of(const RenderJob& job, const SignalWatch& signals, ProgressReport& report,
                       Checkpoints& checkpoints) {
  RenderBreaks breaks;
  breaks.result_due = [&signals] { return signals.take_save_request(); };
  breaks.take_result = [&job, &checkpoints](const RenderResult& result) {
    checkpoints.finish();
    write_so_far(job, result);
  };
  if (job.command.checkpoint == 0) return breaks;
  const bool kept = !checkpoints.file().empty(), told = !job.begin.place.output.empty() || job.whole_only;
  breaks.film_due = [&checkpoints, &report, kept, said = told]() mutable {
    if (const auto problem = checkpoints.problem()) report.say(*problem);
    if (kept || said || !checkpoints.due()) return kept && checkpoints.due();
    said = true;
    report.say(
        "nothing is kept before the end; with a file as output that ends in .exr, and --exr-film yes, a killed render "
        "can go on");
    return false;
  };
  breaks.take_film = [&checkpoints](const Film& film, ThreadPool& thread_pool) { checkpoints.take(film, thread_pool); };
  return breaks;
}

/// Renders, with checkpoints. show: gets the progress.
RenderResult render_film(RenderJob& job, const SignalWatch& signals, ProgressReport& report,
                         const std::function<void(const RenderProgress&)>& show) {
  const auto start = std::chrono::steady_clock::now();
  job.prepared = prepare(job.loaded.scene);
  job.seconds_build = seconds_since(start);
  const auto progress = [&](const RenderProgress& now) {
    show(now);
    return signals.received() == 0;
  };
  job.samples_before = totals(job.begin.film).samples;
  const std::filesystem::path& kept = job.begin.place.unfinished;
  Checkpoints checkpoints(kept, job.command.checkpoint,
                          [&job, &kept](const Film& film) { return embedded_in(job, film, kept, "", true); });
  if (job.command.viewer)
    job.view = std::make_shared<LiveView>(*job.command.viewer, job.loaded.name, *job.prepared, job.kernels.isa,
                                          job.threads.count);
  job.options.breaks = breaks_of(job, signals, report, checkpoints);
  if (job.view) add_view(*job.view, report, job.options.breaks);
  try {
    RenderResult result = render(*job.prepared, job.options, progress, std::move(job.begin.film));
    checkpoints.finish();
    if (const auto problem = checkpoints.problem()) report.say(*problem);  // of one that failed just before the end
    return result;
  } catch (const std::bad_alloc&) {
    const Region& r = *job.options.region;
    const auto bytes =
        static_cast<double>(bytes_per_pixel(needs_trait<&BsdfTraits::emits>(job.prepared->columns().features)));
    throw IoError(fmt::format("not enough memory: a film of {}x{} pixels takes {:.3g} GB{}", r.width(), r.height(),
                              1e-9 * bytes * r.width() * r.height(), memory_limit_text()));
  }
}

/// Shows the finished picture in the viewer. Files are written by then, and nothing that fails here is an error.
void show_last(const RenderJob& job, const RenderOutcome& outcome) {
  if (!job.view) return;
  try {
    const auto& clean = outcome.result.clean;
    if (!outcome.result.interrupted) job.view->finish(outcome.result.film, clean ? &*clean : nullptr);
    if (const auto problem = job.view->problem()) complain(viewer_text(*problem));
  } catch (const std::exception& error) {
    complain(std::string("--watch-at: ") + error.what());
  }
}

}  // namespace

void check_names(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  if (is_image_output(command.stats))
    throw UsageError("--stats: found " + in_quotes(command.stats.string()) + ", expected a name that ends in .json");
  kernels_to_render(command.isa);
}

void prepare(RenderJob& job) {
  const CommandRequest& command = job.command;
  set_up(job);
  job.options.threads = job.threads.count;
  if (job.loaded.is_picture) {
    job.options.samples = job.own.function()->source();
    job.options.threads = std::max(command.threads, 1);
  }
  const std::vector<Output> outputs = outputs_of(command.outputs, command.stats);
  check_outputs(outputs, job.loaded.files);
  check_can_write(outputs);
  // Without --checkpoint only renders of more than half a minute copy their film, and only if there is memory for it.
  check_memory({.width = job.options.region->width(),
                .height = job.options.region->height(),
                .place = job.loaded.name + ": /image",
                .emission = has_lights(job.loaded.scene),
                .clean = command.denoise,
                .checkpoints = command.checkpoint > 0,
                .files = command.outputs,
                .form = command.form},
               free_memory());
  if (!job.loaded.is_picture) job.begin = find_start(job);  // of a picture there is no film to go on with
}

RenderResult Series::render(RenderJob& job, const std::string& name) {
  const std::uint32_t spp = *job.options.spp;
  const ProgressGoal goal{totals(job.begin.film).min_taken, spp < max_samples ? spp : 0, job.command.time_limit,
                          job.command.target_error};
  const std::string place = name + " (" + std::to_string(made_ + 1) + "/" + std::to_string(count_) + "), ";
  const auto show = [&](const RenderProgress& now) {
    if (name.empty()) return report_.show(now.seconds, progress_fraction(now, goal), progress_text(now, goal));
    const double done = (static_cast<double>(made_) + progress_fraction(now, goal)) / static_cast<double>(count_);
    const double seconds = seconds_ + now.seconds;
    std::string text = place + std::to_string(now.spp) + (goal.spp > 0 ? "/" + std::to_string(goal.spp) : "") + " spp";
    if (done > 0) text += ", " + duration(seconds * (1 - done) / done) + " left";
    report_.show(seconds, done, text);
  };
  RenderResult result = render_film(job, signals_, report_, show);
  seconds_ += result.seconds;
  if (!result.interrupted) ++made_;
  return result;
}

/// Tells what users should know of a picture, also with -q, which only turns progress off; what holds for several,
/// once.
void Series::warn(const RenderJob& job, const RenderOutcome& outcome, const std::string& name) {
  const auto tell = [&](const std::string& text) {
    if (told_.insert(text).second)
      report_.say((name.empty() ? "" : name + ": ") + text + (count_ > 1 ? " (told once for all)" : ""));
  };
  const RenderResult& result = outcome.result;
  const FilmTotals& sum = outcome.picture.totals;
  if (outcome.picture.rare_bright_paths)
    tell(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (job.options.clean && !result.clean)
    tell("--denoise: the picture is not filtered, as some pixels have fewer than 2 samples");
  const std::string uneven = uneven_text(job.loaded.scene, sum);
  if (!uneven.empty()) tell(uneven);
  if (sum.rejected == 0) return;
  std::string text = std::to_string(sum.rejected) + " of " + std::to_string(sum.samples) +
                     " samples were rejected: not finite, or brighter than any light of the scene explains";
  for (const RejectedSample& r : result.first_rejected)
    text += (&r == result.first_rejected.data() ? "; the first are (pixel and index) " : " ") + std::to_string(r.x) +
            "," + std::to_string(r.y) + "," + std::to_string(r.sample);
  tell(text);
}

bool Series::make(RenderJob& job, const std::string& name, const PictureSteps& steps) {
  if (begun_++ == 0) tell_remarks(job);
  const RenderResult result = render(job, name);
  const RenderOutcome outcome{result, finished_picture(*job.prepared, result), result.interrupted};
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
  job.begin.film = std::move(film);
}

}  // namespace tyndall
