#include "app/cli/options_render.h"

#include "app/book/load_program.h"
#include "app/check/own_picture.h"
#include "app/cli/setting_options.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/base/thread_pool.h"
#include "core/render/clean_film.h"

namespace tyndall {
namespace {

using Text = const std::string&;

void add_time_and_error(CLI::App& app, double& time_limit, double& target_error, const char* of_error) {
  add_value(app, "--time", "SECONDS", "wall time of rendering; looked at between passes, after the first",
            [&](Text t) { time_limit = read_number(t, above(0), "a number of seconds > 0"); });
  add_value(app, "--target-error", "E",
            std::string("estimated relative error") + of_error + "; its square estimates relMSE",
            [&](Text t) { target_error = read_number(t, above(0), "a number > 0"); });
}

/// The window's limits: rendering pauses there, and goes on with the next edit, or with Space.
void add_view_limits(CLI::App& app, ViewCommand& command) {
  app.option_defaults()->group("Limits (the first one reached pauses the picture; Space goes on)");
  add_value(app, "--spp", "N", "samples per pixel [from the scene, else none]", [&](Text t) {
    set(command.scene.render, &RenderSettings::spp, static_cast<int>(read_whole(t, 1, max_samples)));
  });
  add_time_and_error(app, command.time_limit, command.target_error, "");
}

void add_output(CLI::App& app, RenderCommand& command) {
  app.option_defaults()->group("Output");
  add_outputs(app,
              ".png: 8-bit sRGB; .exr: float, linear, with layers and the film\n"
              "itself; .pfm, .hdr: float, linear; .ppm: 8-bit sRGB, as PNG; - for\n"
              "standard output; repeatable; required",
              command.outputs, command.form);
  add_picture_options(app, command);
  add_value(app, "--stats", "FILE.json", "write figures of the run", [&](Text t) { command.stats = t; });
  add_value(app, "--frame", "N", "the frame N of the scene's animation; its seed is the scene's and N",
            [&](Text t) { command.frame = static_cast<int>(read_whole(t, 0, max_frames - 1)); });
  add_value(app, "--replay", "X,Y,SAMPLE",
            "write no image; print the path of this sample of this pixel,\n"
            "vertex by vertex, as --isa scalar follows it",
            [&](Text t) { command.replay = read_sample_key(t); });
  add_keeping_options(app, command,
                      "start over; without it the same command goes on from the\n"
                      "unfinished film in its .exr output");
  app.add_flag("--resume", command.resume,
               "insist on going on: fail where the .exr output holds no film, also\n"
               "a finished one, of this scene and these settings");
  add_value(app, "--watch-at", "HOST[:PORT]",
            "stream the picture to a viewer that speaks tev's protocol: R, G, B,\n"
            "error and the clean view; one that fails or is slow is told in a\n"
            "line and costs less than 1 % of the time [port 14158]",
            [&](Text t) { command.viewer = read_viewer_address(t); });
  add_progress(app, command.progress);
}

}  // namespace

void add_image_options(CLI::App& app, SceneRequest& scene) {
  app.option_defaults()->group("Image");
  add_value(app, "--size", "WxH", "image size in pixels [from the scene]", [&](Text t) { scene.size = read_size(t); });
  add_settings(app, scene.display);
}

void add_limits(CLI::App& app, RenderCommand& command, const std::string& of) {
  app.option_defaults()->group("Limits (the first one reached ends the " + of + ")");
  add_value(app, "--spp", "N", "samples per pixel [without another limit: from the scene, else 64]",
            [&](Text t) { command.spp = static_cast<std::uint32_t>(read_whole(t, 1, max_samples)); });
  add_time_and_error(app, command.time_limit, command.target_error, ", with --denoise that of the filtered\npicture");
}

void add_picture_options(CLI::App& app, RenderCommand& command) {
  add_value(app, "--region", "X0,Y0,X1,Y1",
            "render the pixels X0 <= x < X1, Y0 <= y < Y1 only, y down;\n"
            "EXR gets a data window, other files the region's size",
            [&](Text t) { command.region = read_region(t); });
  app.add_flag("--denoise", command.denoise,
               "files hold the filtered picture: noise is taken away where the\n"
               "samples show that it is noise, and the error that is left is\n"
               "estimated; EXR files get both in denoised.R/G/B and\n"
               "denoised.error beside the raw picture; not with --samples");
}

void add_keeping_options(CLI::App& app, RenderCommand& command, const std::string& fresh) {
  add_value(app, "--checkpoint", "SECONDS",
            "how often the film of an .exr output is written meanwhile, so that\n"
            "a render that was killed can go on; 0: never\n"
            "[the longer of 30 s and 100 times what the last one took]",
            [&](Text t) { command.checkpoint = read_number(t, at_least(0), "a number of seconds >= 0"); });
  app.add_flag("--fresh", command.fresh, fresh);
}

void refuse_conflicts(const RenderCommand& c) {
  if (c.replay && !c.outputs.empty()) throw UsageError("--replay and -o exclude each other: a replay writes no image");
  if (c.replay && c.form.ppm == PpmCurve::gamma2)
    throw UsageError("--replay and --gamma2 exclude each other: a replay writes no image");
  if (c.replay && c.viewer) throw UsageError("--replay and --watch-at exclude each other: a replay shows no image");
  if (c.denoise && c.spp && *c.spp < min_clean_spp)
    throw UsageError("--denoise: found --spp " + std::to_string(*c.spp) + ", expected at least " +
                     std::to_string(min_clean_spp) + " samples a pixel");
  if (c.fresh && c.resume) throw UsageError("--fresh and --resume exclude each other: one starts over, one goes on");
  if (c.checkpoint > 0 && kept_film(c.outputs, c.form).empty())
    throw UsageError("--checkpoint needs an output that ends in .exr, and --exr-film yes");
  if (!c.samples) return;
  if (c.denoise) throw UsageError("--samples and --denoise exclude each other: a part is filtered when it is merged");
  const char* other = c.spp                  ? "--spp"
                      : c.time_limit < 1e300 ? "--time"
                      : c.target_error > 0   ? "--target-error"
                                             : nullptr;
  if (other)
    throw UsageError("--samples and " + std::string(other) +
                     " exclude each other: --samples says which samples to take");
}

void add_method_options(CLI::App& app, SceneRequest& scene) {
  app.option_defaults()->group("Method");
  add_settings(app, scene.render, {"spp"});
}

void add_machine_options(CLI::App& app, int& threads, std::string& isa) {
  app.option_defaults()->group("Machine");
  add_value(app, "-t,--threads", "N",
            "worker threads; the image is the same for any number\n[processors that this process may use: affinity, "
            "and quota rounded up]",
            [&](Text t) { threads = static_cast<int>(read_whole(t, 1, max_threads)); });
  add_isa(app, isa);
}

void add_isa(CLI::App& app, std::string& isa) {
  std::vector<std::string> names;
  for (const Target target : all_targets) names.emplace_back(name_of(target));
  const auto read = [&isa, names](Text t) { isa = names[read_name(t, names)]; };
  add_value(app, "--isa", "NAME", "scalar; sse4, avx2, avx512 (x86-64); neon (ARM)\n[the best that this CPU runs]",
            read, names);
}

void add_gamma2(CLI::App& app, const std::string& help, PpmCurve& ppm) {
  app.add_flag_callback(
      "--gamma2", [&ppm] { ppm = PpmCurve::gamma2; }, help);
}

void add_outputs(CLI::App& app, const std::string& help, std::vector<std::filesystem::path>& files, ImageForm& form) {
  add_values(app, "-o,--output", "FILE", help, [&](Text t) { files.push_back(t); });
  const std::vector<std::string> formats{"png", "exr", "pfm", "hdr", "ppm"};
  add_value(
      app, "--format", "NAME", "png, exr, pfm, hdr or ppm: the format of what goes to standard output",
      [&form, formats](Text t) { form.format = formats[read_name(t, formats)]; }, formats);
  add_forms(app, form);
}

void add_forms(CLI::App& app, ImageForm& form) {
  add_gamma2(app,
             "write PPM files as the books' programs do: by the square root in\nplace of sRGB's curve, rounded down, "
             "not dithered",
             form.ppm);
  add_value(app, "--exr-film", "yes|no",
            "whether .exr files hold the film itself, which merge, denoise,\n"
            "--resume and checkpoints need; without it they are smaller [yes]",
            [&](Text t) {
              form.exr_film = read_name(t, {"no", "yes"}) == 1;
            });
}

void add_progress(CLI::App& app, ProgressStyle& style) {
  const std::string help = wrapped("on standard error" + choices_text(style) + " [auto]", help_width);
  add_value(
      app, "--progress", "NAME", help, [&](Text t) { read_option(t, {}, style); }, choices(style));
  app.add_flag_callback(
      "-q,--quiet", [&style] { style = ProgressStyle::none; }, "no progress");
}

void add_scene(CLI::App& app, SceneRequest& scene, const std::string& note) {
  const auto take = [&app, &scene](const std::vector<std::string>& arguments) {
    scene.what = arguments[0];
    scene.program.allowed = true;
    scene.program.differs = differs_from_own;
    // Behind an unknown option stands its value, which is no argument: parse() tells of the option.
    const auto unknown = app.remaining();
    const bool complete = unknown.empty() || unknown[0] == "--";
    for (std::size_t k = 1; complete && k < arguments.size(); ++k) {
      if (!is_program(arguments[0]) || !is_program(arguments[k]))
        throw UsageError("unexpected argument " + in_quotes(arguments[k]) + " (see " + app.get_name() + " --help)");
      scene.program.more_files.emplace_back(arguments[k]);
    }
  };
  app.add_option_function<std::vector<std::string>>("SCENE", take,
                                                    "scene file, built-in scene (see tyndall scenes), PNG or EXR made\n"
                                                    "by Tyndall, - for standard input, or MAIN.cc (.cpp, .cxx): a\n"
                                                    "program of \"Ray Tracing in One Weekend\", which is compiled and\n"
                                                    "run; its other source files may follow" +
                                                        note)
      ->option_text(" ")
      ->type_name("")
      ->take_all();
  add_scene_options(app, scene);
}

void add_scene_options(CLI::App& app, SceneRequest& scene) {
  add_values(app, "--set", "POINTER=VALUE",
             "override one value of the scene's JSON before it is checked, e.g.\n"
             "/materials/gold/fuzz=0.2; VALUE is JSON, else a string;\n"
             "repeatable, in order",
             [&scene](Text t) { scene.overrides.push_back(read_override(t)); });
  add_values(app, "-I,--include", "DIR", "of a program: a folder of headers; repeatable",
             [&scene](Text t) { scene.program.include_folders.emplace_back(t); });
  app.add_flag("--trust", scene.program.trusted,
               "run a program also where the system cannot keep it from changing\nyour files (see tyndall --version)");
}

Command read_view(const std::vector<std::string>& arguments) {
  ViewCommand command;
  command.arguments = arguments;
  const auto app =
      new_command("view [SCENE] [options]",
                  "Opens a scene in the window. 'tyndall' alone opens the showroom, 'tyndall SCENE' a scene.\n\n"
                  "Where standard input (-) begins with P3 or P6, it is a picture: its rows are shown as a program\n"
                  "writes them, to be enlarged, exposed, compared with --reference and saved.",
                  "Examples:\n"
                  "  tyndall view cornell-box\n"
                  "  tyndall view fog.json --set /camera/vfov=30 --spp 256\n"
                  "  tyndall view snapshot.png --reference reference.exr\n"
                  "  ./mine | tyndall view - --reference cover.exr");
  add_scene(*app, command.scene, " [showroom]");
  add_view_limits(*app, command);
  add_image_options(*app, command.scene);
  add_method_options(*app, command.scene);
  add_machine_options(*app, command.threads, command.isa);
  add_value(
      *app, "--reference", "FILE",
      "an image of the same scene and size, to show the true error against;\nFILE.exr:LAYER takes a layer of an EXR",
      [&](Text t) { command.reference = t; });
  add_gamma2(
      *app,
      "a picture from standard input is read as the books' programs\nwrite it, by the square of its numbers, not by "
      "sRGB's curve",
      command.ppm);
  add_value(*app, "--ui-log", "FILE",
            "for tests: write what is on the screen and how long things took;\n- for standard output",
            [&](Text t) { command.ui_log = t; });
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !command.scene.what.empty(), "SCENE");
  return command;
}

Command read_render(const std::vector<std::string>& arguments) {
  RenderCommand command;
  command.scene.what.clear();
  const auto app =
      new_command("render SCENE -o FILE [options]", "Renders a scene without a window and writes the image.",
                  "Examples:\n"
                  "  tyndall render cornell-box -o box.png\n"
                  "  tyndall render fog.json --spp 1000 -o fog.exr -o fog.png --stats fog-stats.json\n"
                  "  tyndall render box.png --set /camera/vfov=30 -o closer.png\n"
                  "  tyndall render next-week -o week.exr --watch-at localhost    # seen in tev meanwhile");
  add_scene(*app, command.scene);
  add_output(*app, command);
  add_limits(*app, command, "render");
  add_value(*app, "--samples", "A:B",
            "exactly the samples A <= i < B of each pixel, for shards that\n"
            "'tyndall merge' adds; not with --spp, --time or --target-error",
            [&](Text t) { command.samples = read_samples(t); });
  add_image_options(*app, command.scene);
  add_method_options(*app, command.scene);
  add_machine_options(*app, command.threads, command.isa);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !command.scene.what.empty(), "SCENE");
  require(*app, command.replay || !command.outputs.empty(), "an output (-o FILE)");
  refuse_conflicts(command);
  return command;
}

Command read_verify(const std::vector<std::string>& arguments) {
  VerifyCommand command;
  const auto app =
      new_command("verify [NAME...] [options]",
                  "Renders pictures whose mean radiance is known, and prints a table: the expected mean, where it is\n"
                  "from, the measured one, its standard error, the deviation in standard errors (z), the verdict.\n\n"
                  "A case fails above |z| = 4 or if samples were rejected. The mean square of all z must be near 1:\n"
                  "otherwise the standard errors are wrong. Exit code 1 if anything fails.",
                  "Examples:\n"
                  "  tyndall verify\n"
                  "  tyndall verify plate fog-ball/ --isa scalar\n"
                  "  tyndall verify plate --fresnel schlick      # the books' rule fails");
  add_arguments(*app, "NAME", "beginnings of the names of cases, e.g. plate [all]", command.names);
  app->add_flag("--thorough", command.thorough, "standard errors of at most 1e-4 of the value instead of 1e-3");
  app->add_flag("--json", command.json, "print JSON");
  add_progress(*app, command.progress);
  app->option_defaults()->group("Method");
  add_settings(*app, command.method.render, {"spp", "adaptive"});
  add_machine_options(*app, command.threads, command.isa);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  return command;
}

}  // namespace tyndall
