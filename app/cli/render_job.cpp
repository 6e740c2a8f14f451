#include "app/cli/render_job.h"

#include "app/files/checkpoint.h"
#include "app/files/memory.h"
#include "app/files/outputs.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/files/film_files.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <new>
#include <utility>

namespace tyndall {
namespace {

/// Tells the user if an option asks for what the integrator does not do.
void tell_ignored(const CommandRequest& command, const RenderSettings& settings) {
  if (settings.integrator == Integrator::mis) return;
  const auto& given = command.scene.render.given;
  const auto ignored = [&](const std::string& option, const char* what) {
    complain(option + ": ignored, because " + what + " part of integrator mis, and this is " +
             std::string(name_of(settings.integrator)));
  };
  if (given.contains("caustics") && settings.caustics == Caustics::chains) ignored("--caustics chains", "chains are a");
  if (given.contains("sharing") && settings.sharing) ignored("--sharing on", "sharing is a");
}

MemoryPlan memory_plan(const CommandRequest& command, const LoadedScene& loaded, const Region& region) {
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

/// Writes the picture so far in the middle of a render. What cannot be written is told, and the render goes on.
void write_so_far(const RenderJob& job, const RenderResult& result) {
  try {
    if (totals(result.film).max_taken == 0) return;
    const RenderOutcome outcome = outcome_of(job, result, true);
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

}  // namespace

RenderOutcome outcome_of(const RenderJob& job, const RenderResult& result, bool unfinished) {
  return {result, finished_picture(*job.prepared, result), unfinished};
}

void check_names(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  if (is_image_output(command.stats))
    throw UsageError("--stats: found " + in_quotes(command.stats.string()) + ", expected a name that ends in .json");
  kernels_to_render(command.isa);
}

void prepare(RenderJob& job) {
  const CommandRequest& command = job.command;
  job.kernels = kernels_to_render(command.isa);
  job.options = render_options(command, job.loaded);
  job.options.threads = job.threads.count;
  if (job.loaded.is_picture) {
    job.options.samples = job.own.function()->source();
    job.options.threads = std::max(command.threads, 1);
  }
  std::vector<Output> outputs = outputs_of("--output", command.outputs);
  outputs.push_back({"--stats", command.stats});
  check_outputs(outputs, job.loaded.files);
  check_can_write(outputs);
  check_memory(memory_plan(command, job.loaded, *job.options.region), free_memory());
  if (job.loaded.is_picture) return;  // there is no film to go on with
  job.begin = find_start(command, job.loaded, job.options, job.kernels);
  job.samples_before = totals(job.begin.film).samples;
}

void tell_remarks(const RenderJob& job) {
  for (const std::string& remark : remarks_on_outputs(job.command, job.begin.place)) complain(remark);
  tell_ignored(job.command, job.loaded.scene.render);
  tell_alpha(job.loaded);
}

ProgressGoal goal_of(const RenderJob& job) {
  const bool counted = *job.options.spp < max_samples;
  return {totals(job.begin.film).min_taken, counted ? *job.options.spp : 0, job.command.time_limit,
          job.command.target_error};
}

RenderResult render(RenderJob& job, const SignalWatch& signals, ProgressReport& report,
                    const std::function<void(const RenderProgress&)>& show) {
  const auto start = std::chrono::steady_clock::now();
  job.prepared = prepare(job.loaded.scene);
  job.seconds_build = seconds_since(start);
  const auto progress = [&](const RenderProgress& now) {
    show(now);
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

std::vector<std::string> warnings(const RenderJob& job, const RenderOutcome& outcome) {
  const RenderResult& result = outcome.result;
  std::vector<std::string> texts;
  if (outcome.picture.rare_bright_paths)
    texts.push_back(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (job.options.clean && !result.clean)
    texts.emplace_back("--denoise: the picture is not filtered, as some pixels have fewer than 2 samples");
  const std::string uneven = uneven_text(job.loaded.scene, outcome.picture.totals);
  if (!uneven.empty()) texts.push_back(uneven);
  const FilmTotals& sum = outcome.picture.totals;
  if (sum.rejected == 0) return texts;
  std::string text = std::to_string(sum.rejected) + " of " + std::to_string(sum.samples) +
                     " samples were rejected: not finite, or brighter than any light of the scene explains";
  for (const RejectedSample& r : result.first_rejected)
    text += (&r == result.first_rejected.data() ? "; the first are (pixel and index) " : " ") + std::to_string(r.x) +
            "," + std::to_string(r.y) + "," + std::to_string(r.sample);
  texts.push_back(text);
  return texts;
}

bool write(const RenderJob& job, const RenderOutcome& outcome, bool at_end) {
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

void show_last(const RenderJob& job, const RenderOutcome& outcome) {
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

}  // namespace tyndall
