#include "app/cli/pictures.h"
#include "app/report/contact_sheet.h"
#include "app/report/gain.h"
#include "app/text/markup.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/error.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/render/plan.h"
#include "core/scene/json_tree.h"

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

/// A sweep while its pictures are rendered. What is of each step stands in lists.
struct Sweeping {
  const CommandRequest& command;
  LoadedScene base;
  std::vector<PictureTask> tasks;        ///< its own files
  std::vector<std::string> rows{};       ///< of the table
  std::vector<SheetPicture> pictures{};  ///< of the sheet
  std::size_t middle = 0;                ///< its picture is the first one, and what the others are compared with
  int columns = 1;
  Film reference{};  ///< the film in the middle
};

/// The values of a step, one of each axis.
std::vector<std::string> values_of(const CommandRequest& command, std::size_t step) {
  std::vector<std::string> values;
  for (const SweepAxis& axis : command.axes) {
    values.push_back(axis.values[step % axis.values.size()]);
    step /= axis.values.size();
  }
  return values;
}

std::vector<PictureTask> tasks_of(const CommandRequest& command) {
  std::size_t count = 1;
  for (const SweepAxis& axis : command.axes) count *= axis.values.size();
  if (count > max_sweep_steps) refuse("--vary: found {} pictures, expected at most {}", count, max_sweep_steps);
  std::vector<PictureTask> tasks(count);
  for (std::size_t step = 0; step < count; ++step)
    for (const auto& name : command.outputs)
      tasks[step].outputs.emplace_back(
          name_for(read_valued_name(name.string()), joined(values_of(command, step), "_")));
  return tasks;
}

/// The scene of a step. Throws SceneError, which names it.
LoadedScene scene_of(const Sweeping& sweep, std::size_t step) {
  const std::vector<std::string> values = values_of(sweep.command, step);
  std::vector<Override> overrides;
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < values.size(); ++k) {
    overrides.push_back({sweep.command.axes[k].pointer, values[k]});
    settings.push_back(overrides[k].pointer + "=" + values[k]);
  }
  return open_variant(sweep.base, sweep.command.scene, overrides,
                      fmt::format("{}: step {} ({})", sweep.base.name, step + 1, joined(settings)));
}

/// A job whose picture can be compared with what is there already.
RenderJob job_of(const Sweeping& sweep, std::size_t step, double time_limit) {
  RenderJob job{sweep.command};
  job.command.outputs = sweep.tasks[step].outputs;
  job.command.time_limit = time_limit;
  check_names(job.command);
  job.loaded = scene_of(sweep, step);
  job.name = joined(values_of(sweep.command, step));
  job.film = sweep.tasks[step].film;
  set_up(job);
  return job;
}

/// Finds everything that can be wrong before the first sample.
void check_steps(Sweeping& sweep) {
  std::vector<Output> outputs{{"--output", sweep.command.sheet}, {"--csv", sweep.command.csv}};
  for (const PictureTask& task : sweep.tasks)
    for (const auto& file : task.outputs) outputs.push_back({"--each", file});
  check_outputs(outputs, sweep.base.files);
  check_can_write(std::vector<Output>(outputs.begin(), outputs.begin() + 2));
  for (std::size_t step = 0; step < sweep.tasks.size(); ++step) {
    const double limit = std::min(sweep.command.time_limit, sweep.command.total_time);
    sweep.tasks[step] = task_of(job_of(sweep, step, limit));
  }
}

/// Seconds that the next picture may take.
double time_limit(const Sweeping& sweep, const Series& series) {
  const double each = sweep.command.time_limit;
  if (!std::isfinite(sweep.command.total_time)) return each;
  const double left = std::max(1e-3, sweep.command.total_time - series.seconds);
  return std::min(each, left / static_cast<double>(series.count - series.made));
}

std::string percent(double part, double error) {
  const double size = std::max(std::abs(100 * error), 1e-9);
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
  return fmt::format("{:+.{}f} % ± {:.{}f} %", 100 * part, digits, 100 * error, digits);
}

/// What a value is called beneath pictures: the last step of its pointer, of two such names the last two.
std::string short_name(const std::string& pointer, bool longer) {
  const auto steps = pointer_steps(pointer);
  const std::string& last = steps->back();
  return longer && steps->size() > 1 ? (*steps)[steps->size() - 2] + " " + last : last;
}

std::string csv_row(const std::vector<std::string>& values, const RenderOutcome& outcome,
                    const FilmDifference& difference, double middle) {
  // Of a black picture in the middle there is no part: the fields are empty.
  const auto part = [middle](double value, int digits) {
    return middle == 0 ? std::string() : fmt::format("{:.{}g}", value / middle, digits);
  };
  const FilmMean mean = film_mean(outcome.result.film);
  std::string text;
  for (const std::string& value : values) text += in_csv(value) + ",";
  return text + fmt::format("{:.8g},{:.4g},{:.4g},{},{},{:.8g},{:.4g},{},{:.4g},{}\n", mean.mean, mean.error,
                            outcome.picture.estimate.relative_error, part(difference.mean, 8),
                            part(difference.mean_error, 4), difference.rms, difference.rms_error, outcome.picture.spp,
                            outcome.result.seconds, hash_text(outcome.picture.hash));
}

/// Says in table and sheet what has become of a picture.
void add_figures(Sweeping& sweep, std::size_t step, const RenderOutcome& outcome, const Display& display) {
  const RenderResult& result = outcome.result;
  const LinearImage& image = outcome.picture.image;
  const bool is_middle = step == sweep.middle;
  if (is_middle) sweep.reference = result.film;
  const double mean = film_mean(sweep.reference).mean;
  const FilmDifference difference = film_difference(result.film, sweep.reference);
  const std::vector<std::string> values = values_of(sweep.command, step);
  sweep.rows[step] = csv_row(values, outcome, difference, mean);
  const auto& axes = sweep.command.axes;
  const bool longer = axes.size() > 1 && short_name(axes[0].pointer, false) == short_name(axes[1].pointer, false);
  SheetPicture& shown = sweep.pictures[step];
  shown.picture = on_sheet(result.clean ? LinearImage{image.width, image.height, result.clean->rgb} : image, display,
                           sheet_cell(image.width, image.height, sweep.columns));
  for (std::size_t i = 0; i < axes.size(); ++i)
    shown.title += (i > 0 ? ", " : "") + short_name(axes[i].pointer, longer) + " " + values[i];
  shown.marked = is_middle;
  if (is_middle)
    shown.detail = "the others are compared with this one";
  else if (mean != 0 && std::isfinite(difference.mean_error))
    shown.detail = percent(difference.mean / mean, difference.mean_error / std::abs(mean));
}

void write_sheet(const Sweeping& sweep) {
  const auto& axes = sweep.command.axes;
  const std::string pointers = axes[0].pointer + (axes.size() > 1 ? " and " + axes[1].pointer : "");
  const std::string legend =
      fmt::format("beneath each value: the mean's change, and its standard error; {} samples a pixel, one seed for all",
                  labelled_spp(sweep.reference));
  const LinearImage image = light_of(
      contact_sheet(sweep.pictures, sweep.columns, printable(sweep.base.name) + ": " + printable(pointers), legend));
  const LoadedScene middle = scene_of(sweep, sweep.middle);
  const std::filesystem::path& file = sweep.command.sheet;
  const Scene scene = move_textures(middle.scene, middle.folder, file.parent_path());
  const bool png = image_ending(file, {}) == ".png";
  write_or_rescue(file, [&](const std::filesystem::path& to) {
    png ? write_png(to, image, 0, ToneMap::srgb, {write_scene(scene), "", label_for(scene, "")})
        : write_ppm(to, image, 0, ToneMap::srgb);
  });
}

}  // namespace

int run_sweep(const CommandRequest& command) {
  Sweeping sweep{command, open_scene(command.scene), tasks_of(command)};
  const std::size_t count = sweep.tasks.size(), first = command.axes[0].values.size();
  sweep.rows.resize(count), sweep.pictures.resize(count);
  sweep.middle = (first - 1) / 2 + first * ((count / first - 1) / 2);
  sweep.columns = static_cast<int>(first);
  if (command.axes.size() == 1)
    sweep.columns = sheet_columns(sweep.base.scene.width, sweep.base.scene.height, sweep.columns);
  check_steps(sweep);
  Series series{ProgressReport(command.progress), count};
  bool whole = true;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t step = i == 0 ? sweep.middle : i <= sweep.middle ? i - 1 : i;  // the middle goes first
    RenderJob job = job_of(sweep, step, time_limit(sweep, series));
    prepare(job);
    const auto made = [&](const RenderOutcome& outcome, bool) {
      add_figures(sweep, step, outcome, job.loaded.scene.display);
    };
    whole = make(series, job, made) && whole;
    if (series.signals.received() != 0) {
      const char* further = command.outputs.empty() ? "" : "; the same command goes on";
      complain(fmt::format("interrupted: no sheet and no table are written{}", further));
      return 128 + series.signals.received();
    }
  }
  series.report.finish(fmt::format("done: {} pictures, {}", count, duration(series.seconds)));
  if (!command.sheet.empty()) whole = written_or_told([&] { write_sheet(sweep); }) && whole;
  const std::string table =
      (command.axes.size() > 1 ? "value,value_2" : "value") +
      (",mean,mean_error,relative_error,change,change_error,difference,difference_error,spp,seconds,image_hash\n" +
       joined(sweep.rows, ""));
  if (!command.csv.empty()) whole = written_or_told([&] { write_text_or_rescue(command.csv, table); }) && whole;
  return whole ? 0 : output_failed;
}

}  // namespace tyndall
