#include "app/book/load_program.h"
#include "app/check/own_picture.h"
#include "app/cli/options_render.h"
#include "core/base/text.h"

namespace tyndall {
namespace {

using Text = const std::string&;

void add_baseline_options(CLI::App& app, CompareCommand& command) {
  app.option_defaults()->group("Baseline (a folder of pictures that renders should go on looking like)");
  add_value(app, "--baseline", "DIR",
            "compare each image with the one of its name in this folder, by the\n"
            "tolerances that are kept there, else --max-flip 0.02; that one also\n"
            "fails where relMSE among values outside [0, 1], which FLIP clips, is\n"
            "above 0.01",
            [&](Text t) { command.baseline.folder = t; });
  app.add_flag("--update", command.update,
               "put the images into the folder, and the limits of --max-... as their\n"
               "tolerances; without limits these stay. Nothing is changed where an\n"
               "image cannot be read or has values that are not finite");
  add_value(app, "--report", "FILE.html", "write one page with numbers, both pictures behind a slider, and FLIP",
            [&](Text t) { command.report = read_file_name(t, ".html"); });
  add_value(app, "--junit", "FILE.xml", "write the results as JUnit does",
            [&](Text t) { command.junit = read_file_name(t, ".xml"); });
}

/// Puts the images where they belong. Throws UsageError for too few or too many, and for options that do not go
/// together.
void finish_compare(const CLI::App& app, const std::vector<std::string>& images, CompareCommand& command) {
  const bool baseline = !command.baseline.folder.empty();
  require(app, !images.empty(), "IMAGE");
  if (baseline) {
    command.baseline.images.assign(images.begin(), images.end());
    command.baseline.limits = command.limits;
    if (!command.heatmap.empty() || command.json)
      throw UsageError("--baseline goes with --report and --junit, not with --heatmap or --json");
    if (command.update && (!command.report.empty() || !command.junit.empty()))
      throw UsageError("--update compares nothing, so it writes no report");
    return;
  }
  require(app, images.size() > 1, "REFERENCE");
  for (std::size_t k = 2; k < images.size(); ++k) {
    if (!is_program(images[1]) || !is_program(images[k]))
      throw UsageError("unexpected argument " + in_quotes(images[k]) + " (see tyndall compare --help)");
    command.scene.program.more_files.emplace_back(images[k]);
  }
  if (command.update || !command.report.empty() || !command.junit.empty())
    throw UsageError("--update, --report and --junit need --baseline");
  command.image = images[0] == "-" ? "/dev/stdin" : images[0];
  command.reference = command.scene.what = images[1];
  command.scene.program.allowed = true;
  command.scene.program.differs = differs_from_own;
}

/// The options that turn the comparison into a test.
void add_checks(CLI::App& app, CompareCommand& command) {
  app.option_defaults()->group("Checks");
  const auto limit = [&app](const char* name, const char* help, std::optional<double>& value) {
    add_value(app, name, "X", help, [&value](Text t) { value = read_number(t, at_least(0), "a number >= 0"); });
  };
  limit("--max-rmse", "fail if RMSE is above X", command.limits.rmse);
  limit("--max-relmse", "fail if relMSE is above X", command.limits.rel_mse);
  limit("--max-flip", "fail if FLIP is above X", command.limits.flip);
  add_value(app, "--max-z", "Z",
            "fail if the mean of a channel, a block of 16x16 pixels, or the\n"
            "number of outliers differs by more than Z standard errors of the\n"
            "noise that both pictures carry, corrected for the number of tests;\n"
            "EXR as render writes them, or a.pfm with a.error.pfm",
            [&](Text t) { command.limits.z = read_number(t, above(0), "a number > 0"); });
}

}  // namespace

Command read_compare(const std::vector<std::string>& arguments) {
  CompareCommand command;
  const auto app = new_command(
      "compare IMAGE REFERENCE | IMAGE SCENE | IMAGE... --baseline DIR [options]",
      "Says how far an image is from a reference: MSE, RMSE, relMSE, PSNR, FLIP and the means.\n\n"
      "MSE and RMSE are of linear values. relMSE is the mean over pixels and channels of\n"
      "(x - ref)^2 / (ref^2 + 0.01), so it depends on the unit of radiance: the same scene with all\n"
      "lights ten times as bright gives another number. PSNR (in dB) and FLIP (a difference that eyes\n"
      "see, 0 to 1, at 67 pixels a degree) are of the sRGB images clipped to [0, 1].\n\n"
      "What a file says of its pixels (exposure, curve, orientation) is honoured or refused; what is read\n"
      "in another way than the file says, such as other primaries than sRGB's, is told in a line.\n\n"
      "Two EXR files that Tyndall made also tell their noise: then z-scores of blocks of 16x16 pixels say\n"
      "whether the difference is more than noise. --max-z makes that a test without a tolerance: with Z = 4\n"
      "two pictures of the same scene fail once in 16,000 times at most, whatever their seeds.\n\n"
      "With a scene in place of REFERENCE (its name, its file, or MAIN.cc) the scene is rendered in the\n"
      "image's size, and the answer says whether they agree within the noise; else which objects differ,\n"
      "and which usual mistake in a program of \"Ray Tracing in One Weekend\" explains that: each one is\n"
      "rendered. What editions do otherwise (gamma, Schlick's rule, fuzz on the sphere, frame) is said, and\n"
      "is no mistake. PNG and EXR are images here, even if they carry a scene.\n\n"
      "EXR files of one display window and different data windows (a region, overscan) are compared by\n"
      "position, over the pixels that both have. Beside an EXR, a picture of another format is its display\n"
      "window if it has the size of that, else its data window.",
      "Exit code 1: an error is above its --max-...; a value of one of the images is not finite (NaN and\n"
      "infinity are equal to nothing, with --max-... or without); or --baseline found no image.\n\n"
      "Examples:\n"
      "  tyndall compare out.png snapshot.png\n"
      "  tyndall compare a.exr reference.exr --max-relmse 0.01 --heatmap difference.png\n"
      "  ./mine | tyndall compare - main.cc\n"
      "  tyndall compare A.exr B.exr --max-z 4\n"
      "  tyndall compare a.exr --baseline kept --report report.html");
  std::vector<std::string> images;
  add_arguments(*app, "IMAGE REFERENCE",
                "PNG, PPM, JPEG, BMP, TGA, PFM, HDR or EXR, or FILE.exr:LAYER for a\n"
                "layer, a part, a view or a channel of an EXR; the second one is what\n"
                "the first should look like, of the same size, or a scene; the first\n"
                "one may be - for standard input. With --baseline: any number of\n"
                "images, and folders of them, with all folders in them",
                images);
  add_gamma2(*app,
             "read PPM files as the books' programs write them, by the square of\ntheir numbers, not by sRGB's curve",
             command.baseline.ppm);
  add_value(*app, "--heatmap", "FILE.png", "write FLIP of each pixel, in colours, with their scale beneath",
            [&](Text t) { command.heatmap = read_file_name(t, ".png"); });
  app->add_flag("--json", command.json, "print JSON");
  app->option_defaults()->group("With a scene");
  add_value(*app, "--time", "SECONDS",
            "wall time, once the scene is loaded; what any answer needs is done in\n"
            "any case [20]",
            [&](Text t) { command.seconds = read_number(t, above(0), "a number of seconds > 0"); });
  add_scene_options(*app, command.scene);
  add_checks(*app, command);
  add_baseline_options(*app, command);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  finish_compare(*app, images, command);
  return command;
}

}  // namespace tyndall
