#include "app/cli/pictures.h"
#include "app/files/y4m.h"
#include "app/text/standard_streams.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"

#include <optional>

namespace tyndall {
namespace {

/// Numbered files of one format.
struct FrameFiles {
  NamePattern pattern;
  FrameList list{};  ///< of settings, which the format does not carry; without a name: it does
};

/// A film while its frames are rendered.
struct Animating {
  const CommandRequest& command;
  LoadedScene base;
  FramePlan plan{};
  FrameRange range{};
  std::vector<FrameFiles> files{};
  std::optional<Y4mFile> video{};
};

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
    FrameFiles& files = film.files.emplace_back(FrameFiles{read_numbered_name(name.string())});
    const std::string ending = image_ending(name, {});
    if (ending == ".ppm" || ending == ".pfm" || ending == ".hdr")
      files.list = read_frame_list(files.pattern.before + "frames" + files.pattern.after + ".list");
  }
  return film;
}

/// The command that renders a frame into these files.
CommandRequest command_of(const CommandRequest& command, int frame, std::vector<std::filesystem::path> outputs) {
  CommandRequest made = command;
  made.frame = frame;
  made.outputs = std::move(outputs);
  if (!made.stats.empty()) made.stats = name_for(read_numbered_name(made.stats.string()), frame);
  return made;
}

/// A job that renders a frame into these files, and whose picture can be compared with what is there already.
RenderJob job_of(const Animating& film, int frame, const PictureTask& task) {
  RenderJob job{command_of(film.command, frame, task.outputs)};
  job.loaded = at_frame(film.base, film.plan, frame);
  job.whole_only = true;
  job.film = task.film;
  for (const FrameFiles& files : film.files)
    if (!files.list.file.empty()) job.lists[name_for(files.pattern, frame)] = &files.list;
  set_up(job);
  return job;
}

/// Looks at what there is of a frame. Throws where it is of something else, or the frame's scene is not valid.
PictureTask task_of(const Animating& film, int frame) {
  std::vector<std::filesystem::path> names;
  for (const FrameFiles& files : film.files) names.emplace_back(name_for(files.pattern, frame));
  check_outputs(outputs_of(names), film.base.files);
  const RenderJob job = job_of(film, frame, {names, {}});
  return task_of(job, [&](const std::filesystem::path& file) { return is_whole(file, job); });
}

/// What the video is of.
std::string video_mark(const Animating& film) {
  RenderJob job = job_of(film, film.range.first, {});
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

/// Whether the video lacks a frame.
bool is_filmed_next(const Animating& film, int frame) {
  return film.video && frame >= film.range.first + film.video->frames();
}

/// Renders a frame and writes it; false if something could not be written.
bool make_frame(Animating& film, int frame, const PictureTask& task, Series& series) {
  RenderJob job = job_of(film, frame, task);
  prepare(job);
  const auto made = [&](const RenderOutcome& outcome, bool written) {
    const auto& clean = outcome.result.clean;
    if (written && is_filmed_next(film, frame))
      film.video->add(clean ? LinearImage{clean->width, clean->height, clean->rgb} : outcome.picture.image,
                      job.loaded.scene.display);
  };
  return make(series, job, "frame " + std::to_string(frame), made);
}

std::string summary(const Animating& film, const Series& series, std::size_t kept) {
  const std::size_t made = series.made;
  std::vector<std::string> names;
  if (film.video) names.push_back(printable(film.command.video.string()));
  for (const FrameFiles& files : film.files)
    names.push_back(printable(name_for(files.pattern, film.range.first)) + " to " +
                    printable(name_for(files.pattern, film.range.last - 1)));
  return fmt::format("{}: {} frame{}{}, {}", joined(names), made, made == 1 ? "" : "s",
                     kept > 0 ? fmt::format(" rendered, {} kept", kept) : "", duration(series.seconds));
}

}  // namespace

int run_animate(const CommandRequest& command) {
  check_names(command_of(command, 0, {}));
  Animating film = open_film(command);
  std::map<int, PictureTask> tasks;  // of frames
  for (int frame = film.range.first; frame < film.range.last; ++frame) tasks[frame] = task_of(film, frame);
  check_names(command_of(command, film.range.first, tasks.begin()->second.outputs));
  open_video(film);
  std::erase_if(tasks,
                [&](const auto& task) { return task.second.outputs.empty() && !is_filmed_next(film, task.first); });
  const auto all = static_cast<std::size_t>(film.range.last - film.range.first), kept = all - tasks.size();
  if (kept > 0) complain(fmt::format("{} of {} frames are there already", kept, all));
  Series series{ProgressReport(command.progress), tasks.size()};
  for (const auto& [frame, task] : tasks) {
    if (!make_frame(film, frame, task, series)) return output_failed;
    if (series.signals.received() != 0) {
      series.report.finish("interrupted: " + summary(film, series, kept));
      return 128 + series.signals.received();
    }
  }
  series.report.finish("done: " + summary(film, series, kept));
  return 0;
}

}  // namespace tyndall
