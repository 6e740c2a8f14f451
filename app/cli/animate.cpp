#include "app/cli/kept_pictures.h"
#include "app/cli/requests.h"
#include "app/cli/series.h"
#include "app/files/open_scene.h"
#include "app/files/y4m.h"
#include "app/text/standard_streams.h"
#include "app/text/values.h"
#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"

#include <algorithm>
#include <optional>

namespace tyndall {
namespace {

/// Numbered files of one format.
struct FrameFiles {
  NamePattern pattern;
  std::optional<FrameList> list{};  ///< of settings, which the format does not carry; absent: it does
};

/// What is to be done for one frame.
struct FrameTask {
  int frame = 0;
  std::vector<std::filesystem::path> outputs;  ///< to be written
  std::filesystem::path film;                  ///< whole already; empty: to be rendered
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

FramePlan plan_of(const CommandRequest& command, const LoadedScene& base) {
  const std::optional<Animation>& animation = base.scene.animation;
  if (!command.frames && !animation)
    throw UsageError("--frames: found no number, and no \"animation\" in " + printable(base.name) +
                     ", expected the number of frames");
  if (!command.turntable && (!animation || animation->keyed.empty()))
    complain(base.name + ": no value has keys, so that all frames show the same; --turntable moves the camera");
  return {command.frames ? *command.frames : animation->frames, command.turntable, command.seed_per_frame};
}

FrameRange range_of(const CommandRequest& command, const FramePlan& plan) {
  if (!command.range) return {0, plan.frames};
  if (command.range->last > plan.frames)
    throw UsageError("--frame-range: found frames up to " + std::to_string(command.range->last) +
                     ", expected at most " + std::to_string(plan.frames) + ", the number of frames");
  return *command.range;
}

std::vector<FrameFiles> files_of(const CommandRequest& command) {
  std::vector<FrameFiles> all;
  for (const std::filesystem::path& name : command.outputs) {
    FrameFiles files{read_numbered_name(name.string())};
    const std::string ending = image_ending(name, {});
    if (ending == ".ppm" || ending == ".pfm" || ending == ".hdr")
      files.list.emplace(files.pattern.before + "frames" + files.pattern.after + ".list");
    all.push_back(std::move(files));
  }
  return all;
}

/// The command that renders a frame into these files.
CommandRequest command_of(const CommandRequest& command, int frame, std::vector<std::filesystem::path> outputs) {
  CommandRequest made = command;
  made.outputs = std::move(outputs);
  if (!made.stats.empty()) made.stats = name_for(read_numbered_name(made.stats.string()), frame);
  return made;
}

/// A job that renders a frame into these files, and whose picture can be compared with what is there already.
RenderJob job_of(const Animating& film, int frame, std::vector<std::filesystem::path> outputs) {
  RenderJob job{command_of(film.command, frame, std::move(outputs))};
  job.loaded = at_frame(film.base, film.plan, frame);
  job.whole_only = true;
  set_up(job);
  return job;
}

/// Looks at what there is of a frame. Throws where it is of something else, or the frame's scene is not valid.
FrameTask task_of(const Animating& film, int frame) {
  std::vector<std::filesystem::path> names;
  for (const FrameFiles& files : film.files) names.emplace_back(name_for(files.pattern, frame));
  check_outputs(outputs_of(names), film.base.files);
  const RenderJob job = job_of(film, frame, names);
  FrameTask task{frame, {}, {}};
  const std::string mark = picture_mark(job);
  for (std::size_t k = 0; k < names.size(); ++k) {
    PictureState kept = PictureState::nothing;
    const auto& list = film.files[k].list;
    if (!film.command.fresh) kept = list ? look_at_list(names[k], *list, frame, mark) : look_at_picture(names[k], job);
    if (kept != PictureState::whole) task.outputs.push_back(names[k]);
    if (kept == PictureState::whole && task.film.empty() && is_exr(names[k]) && read_film_label(names[k]))
      task.film = names[k];
  }
  return task;
}

/// What the video is of.
std::string video_mark(const Animating& film) {
  RenderJob job = job_of(film, film.range.first, {});
  job.loaded.scene.animation = film.base.scene.animation;  // each frame follows from the first and from the keys
  return hash_text(fnv1a(picture_mark(job) + " " + std::to_string(film.range.first) + " of " +
                         std::to_string(film.plan.frames) + (film.plan.turntable ? " turntable" : "") +
                         (film.plan.seed_per_frame ? "" : " one seed")));
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
    throw UsageError(command.video.string() + ": found " + std::to_string(film.video->frames()) +
                     " frames, expected at most " + std::to_string(frames) + "; --fresh replaces it");
}

/// Says in the lists what a frame's files are: before they are written, and when they are whole.
void list_frame(Animating& film, const RenderJob& job, int frame, bool whole) {
  for (FrameFiles& files : film.files) {
    const std::filesystem::path name = name_for(files.pattern, frame);
    const auto& outputs = job.command.outputs;
    if (files.list && std::find(outputs.begin(), outputs.end(), name) != outputs.end())
      files.list->add(frame, {picture_mark(job), whole});
  }
}

/// Renders a frame and writes it; false if something could not be written.
bool make_frame(Animating& film, const FrameTask& task, Series& series) {
  RenderJob job = job_of(film, task.frame, task.outputs);
  prepare(job);
  if (!task.film.empty()) take_film(job, read_film_alone(task.film));
  const auto made = [&](const RenderOutcome& outcome, bool written) {
    if (!written) return;
    list_frame(film, job, task.frame, true);
    const auto& clean = outcome.result.clean;
    if (film.video && task.frame >= film.range.first + film.video->frames())
      film.video->add(clean ? LinearImage{clean->width, clean->height, clean->rgb} : outcome.picture.image,
                      job.loaded.scene.display);
  };
  const auto list = [&] { list_frame(film, job, task.frame, false); };
  return series.make(job, "frame " + std::to_string(task.frame), {{}, list, made});
}

std::string summary(const Animating& film, const Series& series, std::size_t kept) {
  const std::size_t made = series.made();
  std::string names = film.video ? printable(film.command.video.string()) : "";
  for (const FrameFiles& files : film.files)
    names += (names.empty() ? "" : ", ") + printable(name_for(files.pattern, film.range.first)) + " to " +
             printable(name_for(files.pattern, film.range.last - 1));
  return names + ": " + std::to_string(made) + (made == 1 ? " frame" : " frames") +
         (kept > 0 ? " rendered, " + std::to_string(kept) + " kept" : "") + ", " + duration(series.seconds());
}

}  // namespace

int run_animate(const CommandRequest& command) {
  check_names(command_of(command, 0, {}));
  Animating film{command, open_scene(command.scene)};
  film.plan = plan_of(command, film.base);
  film.range = range_of(command, film.plan);
  film.files = files_of(command);
  std::vector<FrameTask> tasks;
  for (int frame = film.range.first; frame < film.range.last; ++frame) tasks.push_back(task_of(film, frame));
  check_names(command_of(command, film.range.first, tasks[0].outputs));
  open_video(film);
  std::erase_if(tasks, [&](const FrameTask& task) {
    return task.outputs.empty() && !(film.video && task.frame >= film.range.first + film.video->frames());
  });
  const auto all = static_cast<std::size_t>(film.range.last - film.range.first), kept = all - tasks.size();
  if (kept > 0) complain(std::to_string(kept) + " of " + std::to_string(all) + " frames are there already");
  Series series(command.progress, tasks.size());
  for (const FrameTask& task : tasks) {
    if (!make_frame(film, task, series)) return output_failed;
    if (series.signal() != 0) {
      series.finish("interrupted: " + summary(film, series, kept));
      return 128 + series.signal();
    }
  }
  series.finish("done: " + summary(film, series, kept));
  return 0;
}

}  // namespace tyndall
