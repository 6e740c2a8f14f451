#include "app/cli/options_render.h"
#include "app/files/sweep_values.h"
#include "app/text/name_pattern.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <cstdlib>

namespace tyndall {
namespace {

using Text = const std::string&;

/// Reads the name of a file that stands for many, for the message "--output: found X, expected Y".
void check_pattern(const char* option, const std::string& name, NamePattern (*read)(const std::string&)) {
  try {
    read(name);
  } catch (const UsageError& error) {
    throw UsageError(std::string(option) + ": " + error.what());
  }
}

bool is_video(const std::filesystem::path& file) {
  return file == "-" || lower_case(file.extension().string()) == ".y4m";
}

void add_frames(CLI::App& app, AnimateCommand& command) {
  app.option_defaults()->group("Film");
  add_value(app, "--frames", "N", "how many [from the scene's animation]",
            [&](Text t) { command.frames = static_cast<int>(read_whole(t, 1, max_frames)); });
  add_value(app, "--frame-range", "A:B", "the frames A <= n < B alone, for parts of a film on many machines",
            [&](Text t) { command.range = read_frames(t); });
  app.add_flag("--turntable", command.turntable, "the camera goes once around look_at, about vup; needs no keys");
  add_value(app, "--seed-per-frame", "on|off",
            "on: the seed of frame n is the scene's and n, so that noise does not\n"
            "stand still on the screen; off: all frames have the scene's seed [on]",
            [&](Text t) {
              command.seed_per_frame = read_name(t, {"off", "on"}) == 1;
            });
  add_value(app, "--fps", "N", "frames a second of a .y4m, such as 24 or 30000/1001 [24]", [&](Text t) {
    const std::size_t slash = t.find('/');
    command.rate = static_cast<int>(read_whole(t.substr(0, slash), 1, 1000000));
    command.rate_divisor = slash == t.npos ? 1 : static_cast<int>(read_whole(t.substr(slash + 1), 1, 1000000));
  });
}

/// Takes the video out of the outputs, and checks the names of the others.
void sort_outputs(AnimateCommand& command) {
  std::vector<std::filesystem::path> pictures;
  for (const std::filesystem::path& file : command.render.outputs) {
    if (!is_video(file)) {
      check_pattern("--output", file.string(), read_numbered_name);
      pictures.push_back(file);
      continue;
    }
    if (!command.video.empty()) throw UsageError("--output: found two films, expected one .y4m or -");
    command.video = file;
  }
  command.render.outputs = std::move(pictures);
  if (!command.render.stats.empty()) check_pattern("--stats", command.render.stats.string(), read_numbered_name);
}

}  // namespace

Command read_sweep(const std::vector<std::string>& arguments) {
  SweepCommand command;
  RenderCommand& render = command.render;
  render.scene.what.clear();
  const auto app = new_command(
      "sweep SCENE --vary POINTER=FROM:TO:STEPS -o SHEET.png [options]",
      "Renders a scene with one or two of its values in steps: a sheet of all pictures with the values\n"
      "beneath them, and a table of how far each differs from the one in the middle.\n\n"
      "All pictures have one seed, so that most of their noise is the same, and differences are several times\n"
      "cleaner than between pictures of different seeds. Their error is estimated from the two halves of the\n"
      "difference itself.",
      "Examples:\n"
      "  tyndall sweep showroom --vary /materials/gold/fuzz=0:0.4:9 -o fuzz.png --csv fuzz.csv\n"
      "  tyndall sweep glass-spheres --vary /materials/glass/refractive_index=[1.3,1.5,1.8] -o glass.png\n"
      "  tyndall sweep showroom --vary /objects/0/material=gold,glass --vary /camera/vfov=20:40:3 -o two.png");
  add_scene(*app, render.scene);
  app->option_defaults()->group("Values");
  add_values(*app, "--vary", "POINTER=VALUES",
             "the value to vary, as --set names it, and in what steps:\n"
             "FROM:TO:STEPS, both ends included; a list such as [0,0.1,0.5];\n"
             "or names such as gold,glass; required, at most twice",
             [&](Text t) { command.axes.push_back(read_sweep_axis(t)); });
  app->option_defaults()->group("Output");
  add_value(*app, "-o,--output", "SHEET.png", "sheet of all pictures, .png or .ppm",
            [&](Text t) { command.sheet = t; });
  add_value(*app, "--csv", "FILE.csv",
            "table: values; mean; errors; change and difference to the picture\n"
            "in the middle, each with its own error; samples; seconds; hash",
            [&](Text t) { command.csv = t; });
  add_values(*app, "--each", "NAME",
             "a file for each picture, any of render's formats; %v stands for the\n"
             "value: 'dir/%v.exr'. A sweep with .exr that was killed goes on",
             [&](Text t) {
               read_valued_name(t);
               render.outputs.emplace_back(t);
             });
  add_forms(*app, render.form);
  add_picture_options(*app, render);
  add_keeping_options(*app, render, "replace the pictures that are there; without it those in .exr files\nare kept");
  add_progress(*app, render.progress);
  add_limits(*app, render, "picture");
  add_value(*app, "--total-time", "SECONDS", "wall time of rendering all pictures",
            [&](Text t) { command.total_time = read_number(t, above(0), "a number of seconds > 0"); });
  add_image_options(*app, render.scene);
  add_method_options(*app, render.scene);
  add_machine_options(*app, render.threads, render.isa);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !render.scene.what.empty(), "SCENE");
  require(*app, !command.axes.empty(), "a value to vary (--vary POINTER=FROM:TO:STEPS)");
  if (command.axes.size() > 2)
    throw UsageError("--vary: found it " + std::to_string(command.axes.size()) + " times, expected it once or twice");
  require(*app, !command.sheet.empty() || !command.csv.empty() || !render.outputs.empty(), "an output (-o SHEET.png)");
  refuse_conflicts(render);
  return command;
}

Command read_animate(const std::vector<std::string>& arguments) {
  AnimateCommand command;
  RenderCommand& render = command.render;
  render.scene.what.clear();
  const auto app = new_command(
      "animate SCENE --frames N -o 'f/%04d.png' [options]",
      "Renders the frames of a film: the values that have keys in the scene's \"animation\" follow them, and\n"
      "--turntable moves the camera once around. Frames count from 0.\n\n"
      "The same command goes on where it was stopped: frames that are there stay if their scene, settings and\n"
      "version are the same, and are refused if not.",
      "Examples:\n"
      "  tyndall animate showroom --turntable --frames 48 --spp 16 -o 'turn-%04d.png'\n"
      "  tyndall animate showroom --turntable --frames 48 --spp 16 -o turn.y4m\n"
      "  tyndall animate film.json --frame-range 0:24 -o 'f/%04d.exr'\n"
      "  tyndall animate film.json -o - |\n"
      "    ffmpeg -i - -vf format=yuv420p,crop -crf 4 -x264-params chroma-qp-offset=-12 -colorspace smpte170m \\\n"
      "      -color_primaries bt709 -color_trc iec61966-2-1 -color_range tv film.mp4");
  add_scene(*app, render.scene);
  add_frames(*app, command);
  app->option_defaults()->group("Output");
  add_values(*app, "-o,--output", "FILE",
             "'f/%04d.png', a file for each frame, any of render's formats;\n"
             ".y4m, or - for standard output: 8 bits, 4:4:4, BT.601; repeatable;\nrequired",
             [&](Text t) { render.outputs.emplace_back(t); });
  add_forms(*app, render.form);
  add_picture_options(*app, render);
  add_value(*app, "--stats", "NAME", "figures of each frame: 'f/%04d.json'", [&](Text t) { render.stats = t; });
  add_keeping_options(*app, render, "replace the frames that are there; without it those that fit are kept");
  add_progress(*app, render.progress);
  add_limits(*app, render, "frame");
  add_image_options(*app, render.scene);
  add_method_options(*app, render.scene);
  add_machine_options(*app, render.threads, render.isa);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !render.scene.what.empty(), "SCENE");
  require(*app, !render.outputs.empty(), "an output (-o 'f/%04d.png')");
  sort_outputs(command);
  refuse_conflicts(render);
  return command;
}

}  // namespace tyndall
