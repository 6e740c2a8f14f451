#include "app/cli/pictures.h"
#include "app/files/y4m.h"
#include "app/text/standard_streams.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"

#include <optional>

namespace tyndall {
namespace {

/// A film while its frames are rendered.
struct Animating {
  const CommandRequest& command;
  LoadedScene base;
  FramePlan plan{};
  FrameRange range{};
  /// By the names of outputs whose formats carry no settings.
  std::map<std::filesystem::path, FrameList> lists{};
  std::optional<Y4mFile> video{};
};

std::string frame_file(const std::filesystem::path& name, int frame) {
  return name_for(read_numbered_name(name.string()), frame);
}

Animating open_film(const CommandRequest& command) {
  Animating film{command, open_scene(command.scene)};
  const std::optional<Animation>& animation = film.base.scene.animation;
  film.plan = command.film;
  if (film.plan.frames == 0 && animation) film.plan.frames = animation->frames;
  if (film.plan.frames == 0)
    refuse("--frames: found no number, and no \"animation\" in {}, expected the number of frames",
           printable(film.base.name));
  if (!film.plan.turntable && (!animation || animation->keyed.empty()))
    complain(film.base.name + ": no value has keys, so that all frames show the same; --turntable moves the camera");
  film.range = command.range.value_or(FrameRange{0, film.plan.frames});
  if (film.range.last > film.plan.frames)
    refuse("--frame-range: found frames up to {}, expected at most {}, the number of frames", film.range.last,
           film.plan.frames);
  for (const std::filesystem::path& name : command.outputs) {
    const std::string ending = image_ending(name, {});
    if (ending == ".ppm" || ending == ".pfm" || ending == ".hdr")
      film.lists[name] = read_frame_list(name_for(read_numbered_name(name.string()), "frames") + ".list");
  }
  return film;
}

/// The command that renders a frame.
CommandRequest command_of(CommandRequest command, int frame) {
  command.frame = frame;
  for (auto& file : command.outputs) file = frame_file(file, frame);
  if (!command.stats.empty()) command.stats = frame_file(command.stats, frame);
  return command;
}

/// A job that renders a frame, and whose picture can be compared with what is there already. Throws SceneError where
/// the frame's scene is not valid.
RenderJob job_of(const Animating& film, int frame) {
  RenderJob job{command_of(film.command, frame)};
  check_outputs(outputs_of(job.command.outputs), film.base.files);
  job.loaded = at_frame(film.base, film.plan, frame);
  job.name = "frame " + std::to_string(frame);
  for (const auto& [name, list] : film.lists) job.lists[frame_file(name, frame)] = &list;
  set_up(job);
  return job;
}

/// What the video is of.
std::string video_mark(const Animating& film) {
  RenderJob job = job_of(film, film.range.first);
  job.loaded.scene.animation = film.base.scene.animation;  // each frame follows from the first and from the keys
  return hash_text(
      fnv1a(fmt::format("{} {} of {}{}{}", picture_mark(job), film.range.first, film.plan.frames,
                        film.plan.turntable ? " turntable" : "", film.plan.seed_per_frame ? "" : " one seed")));
}

void open_video(Animating& film) {
  const CommandRequest& command = film.command;
  if (command.video.empty()) return;
  check_outputs({{"--output", command.video}}, film.base.files);
  const Region region = command.region.value_or(Region{0, 0, film.base.scene.width, film.base.scene.height});
  film.video.emplace(command.video,
                     Y4mFormat{region.width(), region.height(), command.rate, command.rate_divisor, video_mark(film)},
                     command.fresh);
  const int frames = film.range.last - film.range.first;
  if (film.video->frames() > frames)
    refuse("{}: found {} frames, expected at most {}; --fresh replaces it", command.video.string(),
           film.video->frames(), frames);
}

std::string summary(const Animating& film, const Series& series, std::size_t kept) {
  const std::size_t made = series.made;
  std::vector<std::string> names;
  if (film.video) names.push_back(printable(film.command.video.string()));
  for (const auto& name : film.command.outputs)
    names.push_back(printable(frame_file(name, film.range.first)) + " to " +
                    printable(frame_file(name, film.range.last - 1)));
  return fmt::format("{}: {} frame{}{}, {}", joined(names), made, made == 1 ? "" : "s",
                     kept > 0 ? fmt::format(" rendered, {} kept", kept) : "", duration(series.seconds));
}

}  // namespace

int run_animate(const CommandRequest& command) {
  check_names(command_of(command, command.range ? command.range->first : 0));
  Animating film = open_film(command);
  std::map<int, PictureTask> tasks;  // of frames
  for (int frame = film.range.first; frame < film.range.last; ++frame) tasks[frame] = task_of(job_of(film, frame));
  open_video(film);
  const auto is_filmed_next = [&](int n) { return film.video && n >= film.range.first + film.video->frames(); };
  std::erase_if(tasks, [&](const auto& task) { return task.second.outputs.empty() && !is_filmed_next(task.first); });
  const auto all = static_cast<std::size_t>(film.range.last - film.range.first), kept = all - tasks.size();
  if (kept > 0) complain(fmt::format("{} of {} frames are there already", kept, all));
  Series series{ProgressReport(command.progress), tasks.size()};
  for (const auto& task : tasks) {
    RenderJob job = job_of(film, task.first);
    job.command.outputs = task.second.outputs, job.film = task.second.film;
    prepare(job);
    const auto made = [&](const RenderOutcome& outcome, bool written) {
      const auto& clean = outcome.result.clean;
      if (written && is_filmed_next(task.first))
        film.video->add(clean ? LinearImage{clean->width, clean->height, clean->rgb} : outcome.picture.image,
                        job.loaded.scene.display);
    };
    if (!make(series, job, made)) return output_failed;
    if (series.signals.received() != 0) {
      series.report.finish("interrupted: " + summary(film, series, kept));
      return 128 + series.signals.received();
    }
  }
  series.report.finish("done: " + summary(film, series, kept));
  return 0;
}

}  // namespace tyndall
