#include "app/cli/commands.h"
#include "app/cli/live_view.h"
#include "app/cli/render_setup.h"
#include "app/cli/signals.h"
#include "app/files/checkpoint.h"
#include "app/files/memory.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/report/replay.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/files/stats.h"
#include "core/render/clean_film.h"
#include "core/system/processors.h"

#include <fmt/core.h>

#include <chrono>
#include <memory>
#include <new>
#include <utility>

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

/// One headless render from command to files.
struct Job {
  const RenderCommand& command;
  Clock::time_point start = Clock::now();
  LoadedScene loaded{};
  ThreadCount threads = thread_count(command.threads);
  RenderOptions options{};
  Kernels kernels{};
  RenderStart begin{};
  std::shared_ptr<const PreparedScene> prepared{};
  std::unique_ptr<LiveView> view{};  ///< in a viewer; null: none
  std::uint64_t samples_before = 0;
  double seconds_build = 0;
};

/// What a render has come to, at its end or when it is asked for in between.
struct Outcome {
  const RenderResult& result;
  FinishedPicture picture;
  bool unfinished = false;  ///< more samples are to come
};

Outcome outcome_of(const Job& job, const RenderResult& result, bool unfinished) {
  return {result, finished_picture(*job.prepared, result), unfinished};
}

/// Tells the user if an option asks for what the integrator does not do.
void check_if_ignored(const RenderCommand& command, const RenderSettings& settings) {
  if (settings.integrator == Integrator::mis) return;
  const auto& given = command.scene.render.given;
  const auto ignored = [&](const std::string& option, const char* what) {
    complain(option + ": ignored, because " + what + " part of integrator mis, and this is " +
             std::string(name_of(settings.integrator)));
  };
  if (given.contains("caustics") && settings.caustics == Caustics::chains) ignored("--caustics chains", "chains are a");
  if (given.contains("sharing") && settings.sharing) ignored("--sharing on", "sharing is a");
}

MemoryPlan memory_plan(const RenderCommand& command, const LoadedScene& loaded, const Region& region) {
  // Without the option only renders of more than half a minute copy their film, and only if there is memory for it.
  const bool copies = command.checkpoint > 0;
  return {.width = region.width(),
          .height = region.height(),
          .place = loaded.name + ": /image",
          .emission = has_lights(loaded.scene),
          .clean = command.denoise,
          .checkpoints = copies,
          .files = command.outputs,
          .form = command.form};
}

/// Finds everything that can be wrong before the first sample.
void prepare(Job& job) {
  const RenderCommand& command = job.command;
  check_image_names(command.outputs, command.form, command.stats);
  if (is_image_output(command.stats))
    throw UsageError("--stats: found " + in_quotes(command.stats.string()) + ", expected a name that ends in .json");
  job.kernels = find_kernels(command.isa);
  job.loaded = open_scene(command.scene);
  job.options = render_options(command, job.loaded);
  job.options.threads = job.threads.count;
  std::vector<Output> outputs = outputs_of("--output", command.outputs);
  outputs.push_back({"--stats", command.stats});
  check_outputs(outputs, job.loaded.files);
  check_can_write(outputs);
  check_memory(memory_plan(command, job.loaded, *job.options.region), free_memory());
  job.begin = find_start(command, job.loaded, job.options, job.kernels);
  job.samples_before = totals(job.begin.film).samples;
  if (!job.begin.note.empty()) complain(job.begin.note);
  if (job.begin.as_requested) return;
  for (const std::string& remark : remarks_on_outputs(command, job.begin.place)) complain(remark);
  check_if_ignored(command, job.loaded.scene.render);
  tell_alpha(job.loaded);
}

/// What the picture lacks, if it lacks anything.
std::string losses(const FilmTotals& sum) {
  std::string text;
  if (sum.rejected > 0) text += ", " + std::to_string(sum.rejected) + " samples rejected";
  if (sum.truncated == 0) return text;
  return text + fmt::format(", {:.2g} % of the throughput cut at the longest path", 100 * sum.cut_throughput);
}

std::string summary(const Outcome& outcome, const std::vector<std::filesystem::path>& outputs) {
  const RenderResult& r = outcome.result;
  const RenderProgress end{outcome.picture.spp, r.seconds,
                           r.seconds > 0 ? static_cast<double>(r.rays) / r.seconds * 1e-6 : 0,
                           outcome.picture.estimate.relative_error};
  const std::string clean =
      r.clean ? fmt::format(", filtered to {:.2g} in {:.2g} s", r.clean->relative_error, r.seconds_clean) : "";
  std::string files;
  for (const auto& file : outputs)
    if (file != "-") files += (files.empty() ? "" : ", ") + printable(file.string());
  return (r.interrupted ? "interrupted: " : "done: ") + files + (files.empty() ? "" : ": ") + progress_text(end, {}) +
         clean + losses(outcome.picture.totals);
}

RunFigures figures(const Job& job, const Outcome& outcome) {
  return {job.loaded.name,    *job.prepared,     outcome.result,           outcome.picture,
          job.samples_before, job.seconds_build, seconds_since(job.start), job.threads.from};
}

/// What an image or film at that place carries beside the picture.
Embedded embedded_in(const Job& job, const Film& film, const std::filesystem::path& file, std::string stats,
                     bool unfinished) {
  return {embedded_scene(job.loaded.scene, job.loaded.folder, film, file),
          std::move(stats),
          {TYNDALL_VERSION, job.kernels.isa, unfinished}};
}

/// Tells if the pixels have different numbers of samples, which the figures and the files say as min_spp and max_spp.
void warn_if_uneven(const Job& job, const Outcome& outcome) {
  const std::string text = uneven_text(job.loaded.scene, outcome.picture.totals);
  if (!text.empty()) complain(text);
}

/// Writes all that can be written; false if something could not. at_end: also what goes to standard output or pipes.
bool write(const Job& job, const Outcome& outcome, bool at_end = true) {
  const Film& film = outcome.result.film;
  const auto embedded = [&](const std::filesystem::path& file) {
    return embedded_in(job, film, file, embedded_stats_text(figures(job, outcome)), outcome.unfinished);
  };
  const auto layers = [&] { return layers_of(*job.prepared, film, outcome.result.kernels); };
  const CleanPicture* clean = outcome.result.clean ? &*outcome.result.clean : nullptr;
  std::vector<std::filesystem::path> files = job.command.outputs;
  if (!at_end) std::erase_if(files, is_stream);
  auto problems = write_images(
      {film, outcome.picture.image, job.loaded.scene.display, embedded, layers, clean, job.command.form}, files);
  const std::filesystem::path& stats = job.command.stats;
  try {
    const bool due = !stats.empty() && (at_end || !is_stream(stats));
    if (due && stats == "-") write_standard_output(stats_text(figures(job, outcome)));
    if (due && stats != "-") write_text_or_rescue(stats, stats_text(figures(job, outcome)));
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
void write_so_far(const Job& job, const RenderResult& result) {
  try {
    if (totals(result.film).max_taken == 0) return;
    const Outcome outcome = outcome_of(job, result, true);
    warn_if_uneven(job, outcome);
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

/// Shows the finished picture in the viewer. Files are written by then, and nothing that fails here is an error.
void show_last(const Job& job, const Outcome& outcome) {
  if (!job.view) return;
  try {
    const auto& clean = outcome.result.clean;
    if (!outcome.result.interrupted)
      job.view->finish(outcome.result.film, outcome.picture.image.rgb, clean ? &*clean : nullptr);
    if (const auto problem = job.view->problem()) complain(viewer_text(*problem));
  } catch (const std::exception& error) {
    complain(std::string("--watch-at: ") + error.what());
  }
}

/// What is done while the render goes on: checkpoints, or saying that there are none, and SIGUSR1.
RenderBreaks breaks_of(const Job& job, const SignalWatch& signals, ProgressReport& report, Checkpoints& checkpoints) {
  RenderBreaks breaks;
  breaks.result_due = [&signals] { return signals.take_save_request(); };
  breaks.take_result = [&job, &checkpoints](const RenderResult& result) {
    checkpoints.finish();
    write_so_far(job, result);
  };
  if (job.command.checkpoint == 0) return breaks;
  const bool kept = !checkpoints.file().empty(), told = !job.begin.place.output.empty();
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

ProgressGoal goal_of(const Job& job) {
  const bool counted = *job.options.spp < max_samples;
  return {totals(job.begin.film).min_taken, counted ? *job.options.spp : 0, job.command.time_limit,
          job.command.target_error};
}

RenderResult render(Job& job, const SignalWatch& signals, ProgressReport& report) {
  const Clock::time_point start = Clock::now();
  job.prepared = prepare(job.loaded.scene);
  job.seconds_build = seconds_since(start);
  const auto progress = [&](const RenderProgress& now) {
    report.show(now);
    return signals.received() == 0;
  };
  const std::filesystem::path& kept = job.begin.place.unfinished;
  Checkpoints checkpoints(kept, job.command.checkpoint,
                          [&job, &kept](const Film& film) { return embedded_in(job, film, kept, "", true); });
  if (job.command.viewer)
    job.view = std::make_unique<LiveView>(*job.command.viewer, job.loaded.name, *job.prepared, job.kernels.isa,
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

/// Prints warnings, also with -q, which only turns progress off.
void warn(const Job& job, const Outcome& outcome) {
  const RenderResult& result = outcome.result;
  if (outcome.picture.rare_bright_paths)
    complain(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (job.options.clean && !result.clean)
    complain("--denoise: the picture is not filtered, as some pixels have fewer than 2 samples");
  warn_if_uneven(job, outcome);
  const FilmTotals& sum = outcome.picture.totals;
  if (sum.rejected == 0) return;
  std::string text = std::to_string(sum.rejected) + " of " + std::to_string(sum.samples) +
                     " samples were rejected: not finite, or brighter than any light of the scene explains";
  for (const RejectedSample& r : result.first_rejected)
    text += (&r == result.first_rejected.data() ? "; the first are (pixel and index) " : " ") + std::to_string(r.x) +
            "," + std::to_string(r.y) + "," + std::to_string(r.sample);
  complain(text);
}

int print_replay(const RenderCommand& command) {
  const LoadedScene loaded = open_scene(command.scene);
  const SampleKey& key = *command.replay;
  const Scene& scene = loaded.scene;
  if (key.x >= scene.width || key.y >= scene.height)
    throw UsageError("--replay: found pixel " + std::to_string(key.x) + "," + std::to_string(key.y) +
                     ", expected one of an image of " + std::to_string(scene.width) + "x" +
                     std::to_string(scene.height));
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  write_standard_output(replay_text(scene, prepared->columns(), replay(prepared->view(), key.x, key.y, key.sample)));
  return 0;
}

}  // namespace

int run(const RenderCommand& command) {
  if (command.replay) return print_replay(command);
  Job job{command};
  prepare(job);
  if (job.begin.as_requested) return 0;
  const SignalWatch signals;
  ProgressReport report(command.progress, goal_of(job));
  const RenderResult result = render(job, signals, report);
  const Outcome outcome = outcome_of(job, result, result.interrupted);
  report.finish(summary(outcome, command.outputs));
  const int code = result.interrupted ? 128 + signals.received() : 0;
  if (outcome.picture.totals.max_taken == 0) {
    complain("interrupted before the first samples: nothing written");
    return code;
  }
  warn(job, outcome);
  const bool written = write(job, outcome);
  show_last(job, outcome);
  return written ? code : output_failed;
}

}  // namespace tyndall
