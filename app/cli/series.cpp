#include "app/cli/kept_pictures.h"
#include "app/cli/pictures.h"
#include "app/files/checkpoint.h"
#include "app/files/memory.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/render/plan.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <new>

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
  const bool unfinished = outcome.result.interrupted || !at_end;
  const auto embedded = [&](const std::filesystem::path& file) {
    return embedded_in(job, film, file, embedded_stats_text(figures(job, outcome)), unfinished);
  };
  const auto layers = [&] { return layers_of(*job.prepared, film, outcome.result.kernels); };
  const CleanPicture* clean = outcome.result.clean ? &*outcome.result.clean : nullptr;
  std::vector<std::filesystem::path> files = job.command.outputs;
  if (!at_end) std::erase_if(files, is_stream);
  if (job.whole_only && unfinished) std::erase_if(files, [&](const auto& file) { return file != job.place.output; });
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
  const std::filesystem::path apart = job.place.beside();
  if (at_end && problems.empty() && !apart.empty()) std::filesystem::remove(apart, ignored);
  return problems.empty();
}

/// Writes the picture so far in the middle of a render. What cannot be written is told, and the render goes on.
void write_so_far(const RenderJob& job, const RenderResult& result) {
  try {
    if (totals(result.film).max_taken == 0) return;
    const RenderOutcome outcome{result, finished_picture(*job.prepared, result)};
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

/// What is done while the render goes on: checkpoints, or saying that there are none, the viewer, and SIGUSR1.
RenderBreaks breaks_of(const RenderJob& job, const SignalWatch& signals, ProgressReport& report,
                       Checkpoints& checkpoints, LiveView* view) {
  RenderBreaks breaks;
  breaks.result_due = [&signals] { return signals.take_save_request(); };
  breaks.take_result = [&job, &checkpoints](const RenderResult& result) {
    checkpoints.finish();
    write_so_far(job, result);
  };
  const bool wanted = job.command.checkpoint != 0, kept = wanted && !checkpoints.file().empty();
  const bool told = !wanted || !job.place.output.empty() || job.whole_only;
  breaks.film_due = [&checkpoints, &report, view, kept, said = told]() mutable {
    if (const auto problem = checkpoints.problem()) report.say(*problem);
    if (const auto problem = view ? view->problem() : std::nullopt) report.say(viewer_text(*problem));
    if (!kept && !said && checkpoints.due()) {
      said = true;
      report.say(
          "nothing is kept before the end; with a file as output that ends in .exr, and --exr-film yes, a killed "
          "render can go on");
    }
    return (kept && checkpoints.due()) || (view && view->due());
  };
  breaks.take_film = [&checkpoints, view, kept](const Film& film, ThreadPool& thread_pool) {
    if (kept && checkpoints.due()) checkpoints.take(film, thread_pool);
    if (view && view->due()) view->take(film, thread_pool);
  };
  return breaks;
}

/// Shows the finished picture in the viewer. Files are written by then, and nothing that fails here is an error.
void show_last(LiveView& view, const RenderResult& result) {
  try {
    if (!result.interrupted) view.finish(result.film, result.clean ? &*result.clean : nullptr);
    if (const auto problem = view.problem()) complain(viewer_text(*problem));
  } catch (const std::exception& error) {
    complain(std::string("--watch-at: ") + error.what());
  }
}

std::string summary(const RenderOutcome& outcome, const std::vector<std::filesystem::path>& outputs) {
  const RenderResult& r = outcome.result;
  const RenderProgress end{outcome.picture.spp, r.seconds,
                           r.seconds > 0 ? static_cast<double>(r.rays) / r.seconds * 1e-6 : 0,
                           outcome.picture.estimate.relative_error};
  const std::string clean =
      r.clean ? fmt::format(", filtered to {:.2g} in {:.2g} s", r.clean->relative_error, r.seconds_clean) : "";
  std::vector<std::string> files;
  for (const auto& file : outputs)
    if (file != "-") files.push_back(printable(file.string()));
  const FilmTotals& sum = outcome.picture.totals;
  std::string lacks = sum.rejected > 0 ? fmt::format(", {} samples rejected", sum.rejected) : "";
  if (sum.truncated > 0)
    lacks += fmt::format(", {:.2g} % of the throughput cut at the longest path", 100 * sum.cut_throughput);
  return (r.interrupted ? "interrupted: " : "done: ") + joined(files) + (files.empty() ? "" : ": ") +
         progress_text(end, {}) + clean + lacks;
}

}  // namespace

void check_names(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  if (is_image_output(command.stats))
    refuse("--stats: found {}, expected a name that ends in .json", in_quotes(command.stats.string()));
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
                .clean = command.clean,
                .checkpoints = command.checkpoint > 0,
                .files = command.outputs,
                .form = command.form},
               free_memory());
  if (!job.loaded.is_picture) find_start(job);  // of a picture there is no film to go on with
  if (job.film.empty()) return;
  job.begin = read_film_alone(job.film);  // to which nothing is added
  job.options.spp = labelled_spp(job.begin);
  job.options.time_limit = std::numeric_limits<double>::infinity();
  job.options.target_error = 0;
}

/// Renders, with checkpoints.
RenderResult Series::render(RenderJob& job, const std::string& name, LiveView* view) {
  const std::uint32_t spp = *job.options.spp;
  const ProgressGoal goal{totals(job.begin).min_taken, spp < max_samples ? spp : 0, job.command.time_limit,
                          job.command.target_error};
  const auto show = [&](const RenderProgress& now) {
    if (name.empty()) return report_.show(now.seconds, progress_fraction(now, goal), progress_text(now, goal));
    const double done = (static_cast<double>(made_) + progress_fraction(now, goal)) / static_cast<double>(count_);
    const double seconds = seconds_ + now.seconds;
    std::string text = fmt::format("{} ({}/{}), {}{} spp", name, made_ + 1, count_, now.spp,
                                   goal.spp > 0 ? fmt::format("/{}", goal.spp) : "");
    if (done > 0) text += ", " + duration(seconds * (1 - done) / done) + " left";
    report_.show(seconds, done, text);
  };
  const std::filesystem::path& kept = job.place.unfinished;
  Checkpoints checkpoints(kept, job.command.checkpoint,
                          [&job, &kept](const Film& film) { return embedded_in(job, film, kept, "", true); });
  job.options.breaks = breaks_of(job, signals_, report_, checkpoints, view);
  const auto go_on = [&](const RenderProgress& now) {
    show(now);
    return signals_.received() == 0;
  };
  try {
    RenderResult result = tyndall::render(*job.prepared, job.options, go_on, std::move(job.begin));
    checkpoints.finish();
    if (const auto problem = checkpoints.problem()) report_.say(*problem);  // of one that failed just before the end
    return result;
  } catch (const std::bad_alloc&) {
    const Region& r = *job.options.region;
    const auto bytes =
        static_cast<double>(bytes_per_pixel(needs_trait<&BsdfTraits::emits>(job.prepared->columns().features)));
    throw IoError(fmt::format("not enough memory: a film of {}x{} pixels takes {:.3g} GB{}", r.width(), r.height(),
                              1e-9 * bytes * r.width() * r.height(), memory_limit_text()));
  }
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
  std::string places;
  for (const RejectedSample& r : result.first_rejected)
    places +=
        fmt::format("{}{},{},{}", places.empty() ? "; the first are (pixel and index) " : " ", r.x, r.y, r.sample);
  tell(fmt::format("{} of {} samples were rejected: not finite, or brighter than any light of the scene explains{}",
                   sum.rejected, sum.samples, places));
}

bool Series::make(RenderJob& job, const std::string& name, const PictureSteps& steps) {
  if (begun_++ == 0) tell_remarks(job);
  const auto start = std::chrono::steady_clock::now();
  job.prepared = tyndall::prepare(job.loaded.scene);
  job.seconds_build = seconds_since(start);
  job.samples_before = totals(job.begin).samples;
  std::optional<LiveView> view;
  if (job.command.viewer) view.emplace(job);
  const RenderResult result = render(job, name, view ? &*view : nullptr);
  seconds_ += result.seconds;
  if (!result.interrupted) ++made_;
  const RenderOutcome outcome{result, finished_picture(*job.prepared, result)};
  if (name.empty()) report_.finish(summary(outcome, job.command.outputs));
  if (outcome.picture.totals.max_taken == 0) {
    if (name.empty()) complain("interrupted before the first samples: nothing written");
    return true;
  }
  warn(job, outcome, name);
  if (steps.writing && !result.interrupted) steps.writing();
  const bool written = write(job, outcome);
  if (steps.made && !result.interrupted) steps.made(outcome, written);
  if (view) show_last(*view, result);
  return written;
}

}  // namespace tyndall
