#include "app/cli/pictures.h"
#include "app/files/checkpoint.h"
#include "app/files/viewer_stream.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/render/clean_film.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

namespace tyndall {
namespace {

// How often a viewer gets pictures.
constexpr double shortest_interval = 0.25;  // seconds
constexpr double interval_over_cost = 200;  // of frames, and of clean views: together 1 %
constexpr double first_over_cost = 100;  // the first frame comes earlier: of a viewer that does not read it is the last
constexpr double seconds_per_pixel = 5e-8;        // of a frame, before the first one is measured
constexpr double clean_seconds_per_pixel = 2e-6;  // of one thread, before the first one is measured
constexpr double patience_over_elapsed = 0.005, shortest_patience = 0.02;

/// Shows the picture of a job in its viewer, if it has one. Makes the frames, which takes the threads' time, and so
/// seldom that this costs less than 1 % of it; of a viewer that is not there, or does not read, none are made. The
/// clean view takes most of the time, so it comes more seldom, and always at the end.
class LiveView {
 public:
  /// The job is prepared, and lives longer.
  explicit LiveView(const RenderJob& job) : job_(job) {
    const Scene& scene = job.loaded.scene;
    if (job.command.viewer) stream_.emplace(*job.command.viewer, job.loaded.name, scene.width, scene.height);
    const double pixels = static_cast<double>(scene.width) * scene.height;
    cost_ = seconds_per_pixel * first_over_cost / interval_over_cost * pixels;
    clean_cost_ = clean_seconds_per_pixel * pixels / job.threads.count;
  }

  bool due() const {
    return stream_ && seconds_since(last_) >= std::max(shortest_interval, interval_over_cost * cost_) &&
           stream_->ready();
  }
  /// Sends the film as it is. thread_pool: idle.
  void take(const Film& film, ThreadPool& thread_pool) {
    const auto begin = Clock::now();
    if (totals(film).min_taken >= min_clean_spp && seconds_since(last_clean_) >= interval_over_cost * clean_cost_) {
      filter(film);
      clean_cost_ = seconds_since(begin), last_clean_ = Clock::now();
    }
    const auto after_clean = Clock::now();
    send(film, thread_pool);
    cost_ = seconds_since(after_clean), last_ = Clock::now();
  }
  /// Sends the finished picture and waits until the viewer has it, as ViewerStream::finish() does. Files are written by
  /// then, and nothing that fails here is an error.
  void finish(const RenderResult& result) {
    try {
      if (stream_ && !result.interrupted) send_last(result);
      if (const auto told = problem()) complain(*told);
    } catch (const std::exception& error) {
      complain(std::string("--watch-at: ") + error.what());
    }
  }
  /// What went wrong with the viewer, once.
  std::optional<std::string> problem() {
    const auto problem = stream_ ? stream_->problem() : std::nullopt;
    if (!problem) return {};
    return "--watch-at: " + *problem + "; the render goes on without it";
  }

 private:
  void filter(const Film& film) { clean_ = clean_film(film, *job_.prepared, job_.threads.count, job_.kernels.isa).rgb; }
  void send(const Film& film, ThreadPool& thread_pool) {
    const std::vector<float> rgb = resolve(film), errors = pixel_relative_error(film, &thread_pool);
    ViewerFrame frame{film.region, {}};
    frame.values.reserve(viewer_channel_count * film.pixels.size());
    for (std::size_t i = 0; i < film.pixels.size(); ++i) {
      frame.values.insert(frame.values.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], errors[i]});
      for (std::size_t c = 0; c < 3; ++c) frame.values.push_back(clean_.empty() ? 0.0f : clean_[3 * i + c]);
    }
    stream_->send(std::move(frame));
  }
  void send_last(const RenderResult& result) {
    const double patience = std::max(shortest_patience, patience_over_elapsed * seconds_since(start_));
    stream_->finish(patience);
    if (!stream_->ready()) return;
    if (result.clean)
      clean_ = result.clean->rgb;
    else if (totals(result.film).min_taken >= min_clean_spp)
      filter(result.film);
    ThreadPool thread_pool(job_.threads.count);
    send(result.film, thread_pool);
    stream_->finish(patience);
  }

  const RenderJob& job_;
  std::optional<ViewerStream> stream_{};
  std::vector<float> clean_{};  ///< the newest; empty: none yet
  Clock::time_point start_ = Clock::now(), last_ = start_, last_clean_ = start_;
  double cost_ = 0;        ///< seconds that the last frame took, or an estimate
  double clean_cost_ = 0;  ///< likewise the clean view
};

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
  RunFigures figures{
      job.loaded.name, *job.prepared, outcome.result, outcome.picture, job.samples_before, job.seconds_build, 0,
      job.threads.from};
  const bool unfinished = outcome.result.interrupted || !at_end;
  const auto embedded = [&](const std::filesystem::path& file) {
    return embedded_in(job, film, file, embedded_stats_text(figures), unfinished);
  };
  const auto layers = [&] { return layers_of(*job.prepared, film, outcome.result.kernels); };
  const CleanPicture* clean = outcome.result.clean ? &*outcome.result.clean : nullptr;
  std::vector<std::filesystem::path> files = job.command.outputs;
  if (!at_end) std::erase_if(files, is_stream);
  if (!job.name.empty() && unfinished) std::erase_if(files, [&](const auto& file) { return file != job.place.output; });
  auto problems = write_images(
      {film, outcome.picture.image, job.loaded.scene.display, embedded, layers, clean, job.command.form}, files);
  const std::filesystem::path& stats = job.command.stats;
  figures.seconds_total = seconds_since(job.start);
  try {
    if (!stats.empty() && (at_end || !is_stream(stats))) write_text_or_rescue(stats, stats_text(figures));
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
    if (const auto uneven = uneven_text(job.loaded.scene, outcome.picture.totals); !uneven.empty()) complain(uneven);
    write(job, outcome, false);
  } catch (const std::exception& error) {
    complain(std::string("SIGUSR1: the picture so far was not written: ") + error.what());
  }
}

/// What is done while the render goes on: checkpoints, or saying that there are none, the viewer, and SIGUSR1.
RenderBreaks breaks_of(Series& series, const RenderJob& job, Checkpoints& checkpoints, LiveView& view) {
  RenderBreaks breaks;
  breaks.result_due = [&series] { return series.signals.take_save_request(); };
  breaks.take_result = [&job, &checkpoints](const RenderResult& result) {
    checkpoints.finish();
    write_so_far(job, result);
  };
  const bool wanted = job.command.checkpoint != 0, kept = wanted && !checkpoints.file().empty();
  const bool told = !wanted || !job.place.output.empty() || !job.name.empty();
  breaks.film_due = [&checkpoints, &series, &view, kept, told] {
    for (const auto& problem : {checkpoints.problem(), view.problem()})
      if (problem) series.report.say(*problem);
    if (!kept && !told && checkpoints.due() && series.told.insert("nothing is kept").second)
      series.report.say(
          "nothing is kept before the end; with a file as output that ends in .exr, and --exr-film yes, a killed "
          "render can go on");
    return (kept && checkpoints.due()) || view.due();
  };
  breaks.take_film = [&checkpoints, &view, kept](const Film& film, ThreadPool& thread_pool) {
    if (kept && checkpoints.due()) checkpoints.take(film, thread_pool);
    if (view.due()) view.take(film, thread_pool);
  };
  return breaks;
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

/// Renders, with checkpoints.
RenderResult render(Series& series, RenderJob& job, LiveView& view) {
  const std::uint32_t before = totals(job.begin).min_taken;
  const auto show = [&](const RenderProgress& now) {
    const double part = progress_fraction(now, job.command, before);
    if (job.name.empty()) return series.report.show(now.seconds, part, progress_text(now, job.command, before));
    const double done = (static_cast<double>(series.made) + part) / static_cast<double>(series.count);
    const double seconds = series.seconds + now.seconds;
    std::string text =
        fmt::format("{} ({}/{}), {}", job.name, series.made + 1, series.count, samples_text(now, job.command));
    if (done > 0) text += ", " + duration(seconds * (1 - done) / done) + " left";
    series.report.show(seconds, done, text);
  };
  const std::filesystem::path& kept = job.place.unfinished;
  Checkpoints checkpoints(kept, job.command.checkpoint,
                          [&job, &kept](const Film& film) { return embedded_in(job, film, kept, "", true); });
  job.command.breaks = breaks_of(series, job, checkpoints, view);
  const auto go_on = [&](const RenderProgress& now) {
    show(now);
    return series.signals.received() == 0;
  };
  try {
    RenderResult result = tyndall::render(*job.prepared, job.command, go_on, std::move(job.begin));
    checkpoints.finish();
    if (const auto problem = checkpoints.problem())
      series.report.say(*problem);  // of one that failed just before the end
    return result;
  } catch (const std::bad_alloc&) {
    const Region& r = *job.command.region;
    const auto bytes =
        static_cast<double>(bytes_per_pixel(needs_trait<&BsdfTraits::emits>(job.prepared->columns().features)));
    throw IoError(fmt::format("not enough memory: a film of {}x{} pixels takes {:.3g} GB{}", r.width(), r.height(),
                              1e-9 * bytes * r.width() * r.height(), memory_limit_text()));
  }
}

/// Whether a pixel's samples are the same again and again, as those of a program that seeds its generator anew for each
/// pixel: in most pixels that differ from those beside them both halves are equal. At the edges of things of one colour
/// each that happens by chance, in a third of them.
bool repeats(const Film& film) {
  constexpr std::size_t fewest = 4;  // pixels, and samples of a half
  std::size_t differ = 0, equal = 0;
  for (std::size_t k = 1; k + 1 < film.pixels.size(); ++k) {
    const FilmPixel* pixel = &film.pixels[k];
    const Vec3f mean = half_mean(film, *pixel, 0);
    if (counted(film, *pixel, 1) < fewest || mean == half_mean(film, pixel[-1], 0) ||
        mean == half_mean(film, pixel[1], 0))
      continue;
    ++differ, equal += mean == half_mean(film, *pixel, 1) ? 1 : 0;
  }
  return equal >= fewest && 2 * equal > differ;
}

/// Tells what users should know of a picture, also with -q, which only turns progress off; what holds for several,
/// once.
void warn(Series& series, const RenderJob& job, const RenderOutcome& outcome) {
  const auto tell = [&](const std::string& text) {
    if (series.told.insert(text).second)
      series.report.say((job.name.empty() ? "" : job.name + ": ") + text +
                        (series.count > 1 ? " (told once for all)" : ""));
  };
  const RenderResult& result = outcome.result;
  const FilmTotals& sum = outcome.picture.totals;
  if (outcome.picture.rare_bright_paths)
    tell(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (job.command.clean && !result.clean)
    tell("--denoise: the picture is not filtered, as some pixels have fewer than 2 samples");
  if (const std::string uneven = uneven_text(job.loaded.scene, sum); !uneven.empty()) tell(uneven);
  if (sum.rejected == 0) return;
  std::string places;
  for (const RejectedSample& r : result.first_rejected)
    places +=
        fmt::format("{}{},{},{}", places.empty() ? "; the first are (pixel and index) " : " ", r.x, r.y, r.sample);
  tell(fmt::format("{} of {} samples were rejected: not finite, or brighter than any light of the scene explains{}",
                   sum.rejected, sum.samples, places));
}

}  // namespace

bool make(Series& series, RenderJob& job, const std::function<void(const RenderOutcome&, bool written)>& made) {
  if (series.made == 0) tell_remarks(job);
  const auto start = Clock::now();
  job.prepared = tyndall::prepare(job.loaded.scene);
  job.seconds_build = seconds_since(start);
  job.samples_before = totals(job.begin).samples;
  LiveView view(job);
  const RenderResult result = render(series, job, view);
  series.seconds += result.seconds;
  if (!result.interrupted) ++series.made;
  FinishedPicture picture = finished_picture(*job.prepared, result);
  const bool unknown = job.loaded.is_picture && repeats(result.film);
  if (unknown) picture.estimate.relative_error = std::numeric_limits<double>::infinity();
  const RenderOutcome outcome{result, std::move(picture)};
  if (job.name.empty()) series.report.finish(summary(outcome, job.command.outputs));
  if (outcome.picture.totals.max_taken == 0) {
    if (job.name.empty()) complain("interrupted before the first samples: nothing written");
    return true;
  }
  warn(series, job, outcome);
  if (unknown)
    series.report.say("the program's samples of a pixel are the same again and again: the error is not known");
  if (!result.interrupted) list_outputs(job, "begun");
  const bool written = write(job, outcome);
  if (!result.interrupted && written) list_outputs(job, "whole");
  if (!result.interrupted && made) made(outcome, written);
  view.finish(result);
  return written;
}

}  // namespace tyndall
