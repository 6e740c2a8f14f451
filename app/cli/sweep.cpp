#include "app/cli/kept_pictures.h"
#include "app/cli/pictures.h"
#include "app/report/contact_sheet.h"
#include "app/report/gain.h"
#include "app/text/markup.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/error.h"
#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/scene/json_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tyndall {
namespace {

/// One picture of a sweep, and what is found out about it.
struct SweepStep {
  std::vector<std::string> values;  ///< one of each axis
  PictureTask task{};               ///< its own files
  FilmMean mean{};
  FilmDifference difference{};  ///< to the picture in the middle
  double relative_error = 0, seconds = 0;
  std::uint32_t spp = 0;
  std::uint64_t hash = 0;
  ScreenPicture shown{};
};

struct Sweeping {
  const CommandRequest& command;
  LoadedScene base;
  std::vector<SweepStep> steps{};
  std::size_t middle = 0;  ///< its picture is what the others are compared with
  int columns = 1;
  Film reference{};  ///< the film in the middle

  const SweepStep& middle_step() const { return steps[middle]; }
};

std::vector<SweepStep> steps_of(const CommandRequest& command) {
  const std::vector<std::string> once{""};
  const auto& first = command.axes[0].values;
  const auto& second = command.axes.size() > 1 ? command.axes[1].values : once;
  if (first.size() * second.size() > max_sweep_steps)
    refuse("--vary: found {} pictures, expected at most {}", first.size() * second.size(), max_sweep_steps);
  std::vector<SweepStep> steps;
  for (const std::string& b : second)
    for (const std::string& a : first) {
      SweepStep step{{a}};
      if (command.axes.size() > 1) step.values.push_back(b);
      for (const auto& name : command.outputs)
        step.task.outputs.emplace_back(name_for(read_valued_name(name.string()), joined(step.values, "_")));
      steps.push_back(std::move(step));
    }
  return steps;
}

/// The scene of a step. Throws SceneError, which names it.
LoadedScene scene_of(const Sweeping& sweep, const SweepStep& step) {
  std::vector<Override> overrides;
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < step.values.size(); ++k) {
    overrides.push_back({sweep.command.axes[k].pointer, step.values[k]});
    settings.push_back(overrides[k].pointer + "=" + step.values[k]);
  }
  const auto number = &step - sweep.steps.data() + 1;
  return open_variant(sweep.base, sweep.command.scene, overrides,
                      fmt::format("{}: step {} ({})", sweep.base.name, number, joined(settings)));
}

/// A job whose picture can be compared with what is there already.
RenderJob job_of(const Sweeping& sweep, const SweepStep& step, double time_limit) {
  RenderJob job{sweep.command};
  job.command.outputs = step.task.outputs;
  job.command.time_limit = time_limit;
  check_names(job.command);
  job.loaded = scene_of(sweep, step);
  job.whole_only = true;
  job.film = step.task.film;
  set_up(job);
  return job;
}

/// Finds everything that can be wrong before the first sample.
void check_steps(Sweeping& sweep) {
  std::vector<Output> outputs{{"--output", sweep.command.sheet}, {"--csv", sweep.command.csv}};
  for (const SweepStep& step : sweep.steps)
    for (const auto& file : step.task.outputs) outputs.push_back({"--each", file});
  check_outputs(outputs, sweep.base.files);
  check_can_write(std::vector<Output>(outputs.begin(), outputs.begin() + 2));
  for (SweepStep& step : sweep.steps) {
    const RenderJob job = job_of(sweep, step, std::min(sweep.command.time_limit, sweep.command.total_time));
    step.task = task_of(job, [&](const auto& file) {  // pictures of other formats are made anew
      return is_exr(file) ? look_at_picture(file, job) : PictureState::nothing;
    });
  }
}

/// Seconds that the next picture may take.
double time_limit(const Sweeping& sweep, const Series& series) {
  const double each = sweep.command.time_limit;
  if (!std::isfinite(sweep.command.total_time)) return each;
  const double left = std::max(1e-3, sweep.command.total_time - series.seconds());
  return std::min(each, left / static_cast<double>(series.left()));
}

/// Takes what is needed of a picture.
void add_figures(Sweeping& sweep, SweepStep& step, const RenderOutcome& outcome, const Display& display) {
  const RenderResult& result = outcome.result;
  const LinearImage& image = outcome.picture.image;
  if (&step == &sweep.middle_step()) sweep.reference = result.film;
  step.mean = film_mean(result.film);
  step.difference = film_difference(result.film, sweep.reference);
  step.relative_error = outcome.picture.estimate.relative_error;
  step.seconds = result.seconds;
  step.spp = outcome.picture.spp;
  step.hash = outcome.picture.hash;
  step.shown = on_sheet(result.clean ? LinearImage{image.width, image.height, result.clean->rgb} : image, display,
                        sheet_cell(image.width, image.height, sweep.columns));
}

/// Renders a picture; false if something could not be written.
bool make_picture(Sweeping& sweep, SweepStep& step, Series& series) {
  RenderJob job = job_of(sweep, step, time_limit(sweep, series));
  prepare(job);
  const auto made = [&](const RenderOutcome& outcome, bool) {
    add_figures(sweep, step, outcome, job.loaded.scene.display);
  };
  return series.make(job, joined(step.values, ", "), {{}, made});
}

std::string percent(double part, double error) {
  const double size = std::max(std::abs(100 * error), 1e-9);
  const int digits = std::clamp(1 - static_cast<int>(std::floor(std::log10(size))), 0, 6);
  return fmt::format("{:+.{}f} % ± {:.{}f} %", 100 * part, digits, 100 * error, digits);
}

std::string csv_text(const Sweeping& sweep) {
  std::string text = sweep.command.axes.size() > 1 ? "value,value_2" : "value";
  text += ",mean,mean_error,relative_error,change,change_error,difference,difference_error,spp,seconds,image_hash\n";
  const double mean = sweep.middle_step().mean.mean;
  // Of a black picture in the middle there is no part: the fields are empty.
  const auto part = [mean](double value, int digits) {
    return mean == 0 ? std::string() : fmt::format("{:.{}g}", value / mean, digits);
  };
  for (const SweepStep& s : sweep.steps) {
    for (const std::string& value : s.values) text += in_csv(value) + ",";
    text += fmt::format("{:.8g},{:.4g},{:.4g},{},{},{:.8g},{:.4g},{},{:.4g},{}\n", s.mean.mean, s.mean.error,
                        s.relative_error, part(s.difference.mean, 8), part(s.difference.mean_error, 4),
                        s.difference.rms, s.difference.rms_error, s.spp, s.seconds, hash_text(s.hash));
  }
  return text;
}

/// What a value is called beneath pictures: the last step of its pointer, of two such names the last two.
std::string short_name(const std::string& pointer, bool longer) {
  const auto steps = pointer_steps(pointer);
  const std::string& last = steps->back();
  return longer && steps->size() > 1 ? (*steps)[steps->size() - 2] + " " + last : last;
}

ScreenPicture sheet_of(const Sweeping& sweep) {
  const auto& axes = sweep.command.axes;
  const bool longer = axes.size() > 1 && short_name(axes[0].pointer, false) == short_name(axes[1].pointer, false);
  std::vector<SheetPicture> pictures;
  const double mean = sweep.middle_step().mean.mean;
  for (const SweepStep& step : sweep.steps) {
    const bool is_middle = &step == &sweep.middle_step();
    SheetPicture picture{step.shown, "", is_middle ? "the others are compared with this one" : "", is_middle};
    for (std::size_t i = 0; i < axes.size(); ++i)
      picture.title += (i > 0 ? ", " : "") + short_name(axes[i].pointer, longer) + " " + step.values[i];
    if (!is_middle && mean != 0 && std::isfinite(step.difference.mean_error))
      picture.detail = percent(step.difference.mean / mean, step.difference.mean_error / std::abs(mean));
    pictures.push_back(std::move(picture));
  }
  const std::string pointers = axes[0].pointer + (axes.size() > 1 ? " and " + axes[1].pointer : "");
  const std::string legend =
      fmt::format("beneath each value: the mean's change, and its standard error; {} samples a pixel, one seed for all",
                  sweep.middle_step().spp);
  return contact_sheet(pictures, sweep.columns, printable(sweep.base.name) + ": " + printable(pointers), legend);
}

void write_sheet(const Sweeping& sweep) {
  const LinearImage image = light_of(sheet_of(sweep));
  const LoadedScene middle = scene_of(sweep, sweep.middle_step());
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
  Sweeping sweep{command, open_scene(command.scene)};
  sweep.steps = steps_of(command);
  const int count = static_cast<int>(sweep.steps.size()), first = static_cast<int>(command.axes[0].values.size());
  const auto middle_of = [](std::size_t steps) { return (steps - 1) / 2; };
  sweep.middle = middle_of(static_cast<std::size_t>(first)) +
                 static_cast<std::size_t>(first) * middle_of(static_cast<std::size_t>(count / first));
  sweep.columns =
      command.axes.size() > 1 ? first : sheet_columns(sweep.base.scene.width, sweep.base.scene.height, count);
  check_steps(sweep);
  Series series(command.progress, sweep.steps.size());
  std::vector<std::size_t> order{sweep.middle};
  for (std::size_t k = 0; k < sweep.steps.size(); ++k)
    if (k != sweep.middle) order.push_back(k);
  bool whole = true;
  for (const std::size_t k : order) {
    whole = make_picture(sweep, sweep.steps[k], series) && whole;
    if (series.signal() != 0) {
      const char* further = command.outputs.empty() ? "" : "; the same command goes on";
      complain(fmt::format("interrupted: no sheet and no table are written{}", further));
      return 128 + series.signal();
    }
  }
  series.finish(fmt::format("done: {} pictures, {}", count, duration(series.seconds())));
  if (!command.sheet.empty()) whole = written_or_told([&] { write_sheet(sweep); }) && whole;
  if (!command.csv.empty())
    whole = written_or_told([&] { write_text_or_rescue(command.csv, csv_text(sweep)); }) && whole;
  return whole ? 0 : output_failed;
}

}  // namespace tyndall
