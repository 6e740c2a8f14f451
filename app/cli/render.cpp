#include "app/cli/pictures.h"
#include "app/files/memory.h"
#include "app/report/contents.h"
#include "app/report/replay.h"
#include "app/text/standard_streams.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/render/plan.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

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

/// The scene of a command, with --frame the one of that frame.
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

/// The kernels for commands that may run for hours: "" must find more than the scalar ones where the CPU runs wider
/// ones.
Kernels kernels_to_render(const std::string& isa) {
  const std::string warning = slow_build_warning();
  if (isa.empty() && !warning.empty()) refuse("{}; --isa scalar renders with them nevertheless", warning);
  return find_kernels(isa);
}

}  // namespace

Kernels find_kernels(const std::string& isa) {
  if (const auto kernels = choose_kernels(isa)) return *kernels;
  refuse("--isa: found {}, expected {}", in_quotes(isa), expected_targets(isa));
}

void set_up(RenderJob& job) {
  CommandRequest& command = job.command;
  const Scene& scene = job.loaded.scene;
  job.kernels = kernels_to_render(command.isa);
  if (scene.render.adaptive && command.sample_range)
    refuse(
        "--samples and adaptive sampling exclude each other: it says which samples every pixel takes (it comes from "
        "--adaptive, or from /render/adaptive of the scene)");
  if (const auto& region = command.region; region && (region->x1 > scene.width || region->y1 > scene.height))
    refuse("--region: found X1,Y1 = {},{}, expected at most {},{}, the image's size", region->x1, region->y1,
           scene.width, scene.height);
  command.region = command.region.value_or(Region{0, 0, scene.width, scene.height});
  const bool limited = std::isfinite(command.time_limit) || command.target_error > 0;
  if (!command.spp) command.spp = limited ? max_samples : static_cast<std::uint32_t>(scene.render.spp.value_or(64));
  if (const auto& range = command.sample_range)
    command.first_sample = range->first, command.spp = range->last - range->first;
  command.adaptive = scene.render.adaptive;
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
  if (const std::string note = alpha_note(contents_of(loaded.scene).with_alpha); !note.empty())
    complain(loaded.name + ": " + note);
}

void check_names(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  if (is_image_output(command.stats))
    refuse("--stats: found {}, expected a name that ends in .json", in_quotes(command.stats.string()));
  kernels_to_render(command.isa);
}

void prepare(RenderJob& job) {
  CommandRequest& command = job.command;
  set_up(job);
  command.threads = job.loaded.is_picture ? std::max(command.threads, 1) : job.threads.count;
  if (job.loaded.is_picture) command.samples = job.own.function()->source();
  const std::vector<Output> outputs = outputs_of(command.outputs, command.stats);
  check_outputs(outputs, job.loaded.files);
  check_can_write(outputs);
  // Without --checkpoint only renders of more than half a minute copy their film, and only if there is memory for it.
  check_memory({.width = command.region->width(),
                .height = command.region->height(),
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
  command.spp = labelled_spp(job.begin);
  command.time_limit = std::numeric_limits<double>::infinity();
  command.target_error = 0;
}

int run_render(const CommandRequest& command) {
  if (command.replay) return print_replay(command);
  check_names(command);
  RenderJob job{command};
  job.loaded = open_frame(command, job.own);
  prepare(job);
  if (!job.note.empty()) complain(job.note);
  if (job.complete) return 0;
  Series series{ProgressReport(command.progress), 1};
  if (!make(series, job)) return output_failed;
  return series.made == 1 ? 0 : 128 + series.signals.received();
}

}  // namespace tyndall
