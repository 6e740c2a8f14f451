#include "app/cli/pictures.h"
#include "app/report/contents.h"
#include "app/report/replay.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/render/clean_film.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// Samples a pixel at which to stop.
std::uint32_t last_sample_count(const CommandRequest& command, const Scene& scene) {
  if (command.sample_range) return command.sample_range->last - command.sample_range->first;
  if (command.spp) return *command.spp;
  if (std::isfinite(command.time_limit) || command.target_error > 0) return max_samples;
  return static_cast<std::uint32_t>(scene.render.spp.value_or(64));
}

/// Own samples are no function of seed and index, so that nothing can be gone on with or put together.
void check_own_samples(const CommandRequest& command, const std::string& name) {
  const std::pair<bool, const char*> refused[] = {{command.sample_range.has_value(), "--samples"},
                                                  {command.resume, "--resume"},
                                                  {command.replay.has_value(), "--replay"},
                                                  {command.frame.has_value(), "--frame"},
                                                  {!command.scene.render.given.empty(), "an option of rendering"}};
  for (const auto& [given, option] : refused)
    if (given)
      refuse("{}: {}: found samples of the program's own, expected a scene; they are taken anew each time", name,
             option);
}

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

int print_replay(const CommandRequest& command) {
  OwnSamples own;
  const LoadedScene loaded = open_frame(command, own);
  const SampleKey& key = *command.replay;
  const Scene& scene = loaded.scene;
  if (key.x >= scene.width || key.y >= scene.height)
    refuse("--replay: found pixel {},{}, expected one of an image of {}x{}", key.x, key.y, scene.width, scene.height);
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  write_standard_output(replay_text(scene, prepared->columns(), replay(prepared->view(), key.x, key.y, key.sample)));
  return 0;
}

// How often a viewer gets pictures.
constexpr double shortest_interval = 0.25;  // seconds
constexpr double interval_over_cost = 200;  // of frames, and of clean views: together 1 %
constexpr double first_over_cost = 100;  // the first frame comes earlier: of a viewer that does not read it is the last
constexpr double seconds_per_pixel = 5e-8;        // of a frame, before the first one is measured
constexpr double clean_seconds_per_pixel = 2e-6;  // of one thread, before the first one is measured
constexpr double patience_over_elapsed = 0.005, shortest_patience = 0.02;

}  // namespace

Kernels find_kernels(const std::string& isa) {
  if (const auto kernels = choose_kernels(isa)) return *kernels;
  refuse("--isa: found {}, expected {}", in_quotes(isa), expected_targets(isa));
}

Kernels kernels_to_render(const std::string& isa) {
  const std::string warning = slow_build_warning();
  if (isa.empty() && !warning.empty()) refuse("{}; --isa scalar renders with them nevertheless", warning);
  return find_kernels(isa);
}

LoadedScene open_frame(const CommandRequest& command, OwnSamples& own) {
  LoadedScene loaded = open_scene_or_samples(command.scene, own);
  if (loaded.is_picture) check_own_samples(command, loaded.name);
  if (!command.frame) return loaded;
  if (!loaded.scene.animation)
    refuse("--frame: found no \"animation\" in {}, expected a scene with keys", printable(loaded.name));
  const int frames = loaded.scene.animation->frames;
  if (*command.frame >= frames)
    refuse("--frame: found {}, expected at most {}, the last frame of the scene's animation", *command.frame,
           frames - 1);
  return at_frame(std::move(loaded), {.frames = frames, .seed_per_frame = command.film.seed_per_frame}, *command.frame);
}

void set_up(RenderJob& job) {
  const CommandRequest& command = job.command;
  const Scene& scene = job.loaded.scene;
  job.kernels = kernels_to_render(command.isa);
  if (scene.render.adaptive && command.sample_range)
    refuse(
        "--samples and adaptive sampling exclude each other: it says which samples every pixel takes (it comes from "
        "--adaptive, or from /render/adaptive of the scene)");
  if (const auto& region = command.region; region && (region->x1 > scene.width || region->y1 > scene.height))
    refuse("--region: found X1,Y1 = {},{}, expected at most {},{}, the image's size", region->x1, region->y1,
           scene.width, scene.height);
  RenderOptions& options = job.options;
  options = command;
  options.region = command.region.value_or(Region{0, 0, scene.width, scene.height});
  options.first_sample = command.sample_range ? command.sample_range->first : 0;
  options.spp = last_sample_count(command, scene);
  options.adaptive = scene.render.adaptive;
}

void tell_remarks(const RenderJob& job) {
  const FilmPlace& film = job.place;
  for (const auto& file : job.command.outputs) {
    const FilePlace place = check_can_write(file);
    const bool keeps = file == film.output && job.command.checkpoint != 0;
    if (place.method != WriteMethod::in_place || (place.folder_problem.empty() && !keeps)) continue;
    std::string text =
        file.string() + ": cannot be replaced, as " + place.obstacle + "; the picture is written into it at the end";
    if (!place.folder_problem.empty()) text += "; its folder takes no new files (" + place.folder_problem + ")";
    if (keeps && film.beside().empty()) text += "; no checkpoints are kept, so that a killed render starts over";
    if (keeps && !film.beside().empty()) text += "; checkpoints go to " + film.beside().string();
    complain(text);
  }
  tell_ignored(job.command, job.loaded.scene.render);
  tell_alpha(job.loaded);
}

void tell_alpha(const LoadedScene& loaded) {
  const std::string note = alpha_note(contents_of(loaded.scene).with_alpha);
  if (!note.empty()) complain(loaded.name + ": " + note);
}

int run_render(const CommandRequest& command) {
  if (command.replay) return print_replay(command);
  check_names(command);
  RenderJob job{command};
  job.loaded = open_frame(command, job.own);
  prepare(job);
  if (!job.note.empty()) complain(job.note);
  if (job.complete) return 0;
  Series series(command.progress, 1);
  if (!series.make(job)) return output_failed;
  return series.made() == 1 ? 0 : 128 + series.signal();
}

LiveView::LiveView(const RenderJob& job)
    : job_(job), stream_(*job.command.viewer, job.loaded.name, job.loaded.scene.width, job.loaded.scene.height) {
  const double pixels = static_cast<double>(job.loaded.scene.width) * job.loaded.scene.height;
  cost_ = seconds_per_pixel * first_over_cost / interval_over_cost * pixels;
  clean_cost_ = clean_seconds_per_pixel * pixels / job.threads.count;
}

bool LiveView::due() const {
  return seconds_since(last_) >= std::max(shortest_interval, interval_over_cost * cost_) && stream_.ready();
}

void LiveView::take(const Film& film, ThreadPool& thread_pool) {
  const auto begin = Clock::now();
  if (totals(film).min_taken >= min_clean_spp && seconds_since(last_clean_) >= interval_over_cost * clean_cost_) {
    filter(film);
    clean_cost_ = seconds_since(begin), last_clean_ = Clock::now();
  }
  const auto after_clean = Clock::now();
  send(film, thread_pool);
  cost_ = seconds_since(after_clean), last_ = Clock::now();
}

void LiveView::filter(const Film& film) {
  clean_ = clean_film(film, *job_.prepared, job_.threads.count, job_.kernels.isa).rgb;
}

void LiveView::send(const Film& film, ThreadPool& thread_pool) {
  const std::vector<float> rgb = resolve(film), errors = pixel_relative_error(film, &thread_pool);
  ViewerFrame frame{film.region, {}};
  frame.values.reserve(viewer_channel_count * film.pixels.size());
  for (std::size_t i = 0; i < film.pixels.size(); ++i) {
    frame.values.insert(frame.values.end(), {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2], errors[i]});
    for (std::size_t c = 0; c < 3; ++c) frame.values.push_back(clean_.empty() ? 0.0f : clean_[3 * i + c]);
  }
  stream_.send(std::move(frame));
}

void LiveView::finish(const Film& film, const CleanPicture* clean) {
  const double patience = std::max(shortest_patience, patience_over_elapsed * seconds_since(start_));
  stream_.finish(patience);
  if (!stream_.ready()) return;
  if (clean)
    clean_ = clean->rgb;
  else if (totals(film).min_taken >= min_clean_spp)
    filter(film);
  ThreadPool thread_pool(job_.threads.count);
  send(film, thread_pool);
  stream_.finish(patience);
}

}  // namespace tyndall
