#include "app/cli/option_rows.h"

#include "app/text/values.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/base/thread_pool.h"

#include <functional>

namespace tyndall {
namespace {

using Text = const std::string&;
namespace fs = std::filesystem;

/// What a function reads from the text; without one the text as it is, for a name, a file or a word.
template <class T, class Read = std::identity>
Taker to(T CommandRequest::*member, Read read = {}) {
  return {[member, read](CommandRequest& request, Text t) { request.*member = read(t); }};
}
template <class T, class Read = std::identity>
Taker add_to(T CommandRequest::*member, Read read = {}) {
  return {[member, read](CommandRequest& request, Text t) { (request.*member).emplace_back(read(t)); }, Takes::each};
}
Taker on(bool CommandRequest::*member) {
  return {[member](CommandRequest& request, Text) { request.*member = true; }, Takes::flag};
}
/// For what is not a member of the request itself.
template <class Take>
Taker by(Take take, Takes takes = Takes::once) {
  return {take, takes};
}

/// Readers of values in a range.
auto whole(std::int64_t low, std::int64_t high) {
  return [low, high](Text t) { return static_cast<int>(read_whole(t, low, high)); };
}
auto number(Valid valid, const char* expected) {
  return [valid, expected](Text t) { return read_number(t, valid, expected); };
}
auto seconds() { return number(above(0), "a number of seconds > 0"); }
auto file(const char* ending) {
  return [ending](Text t) { return read_file_name(t, ending); };
}
/// One of two names, which mean no and yes.
auto one_of(const char* no, const char* yes) {
  return [no, yes](Text t) { return read_name(t, {no, yes}) == 1; };
}
Taker limit(std::optional<double> Tolerance::*member, Valid valid, const char* expected) {
  return by([=](CommandRequest& request, Text t) { request.limits.*member = read_number(t, valid, expected); });
}

/// The name of one of these.
Taker name_to(std::string CommandRequest::*member, const std::vector<std::string>& names) {
  return {[member, names](CommandRequest& request, Text t) { request.*member = names[read_name(t, names)]; },
          Takes::once, names};
}

std::vector<std::string> names_of_targets() {
  std::vector<std::string> names;
  for (const Target target : all_targets) names.emplace_back(name_of(target));
  return names;
}

const std::vector<std::string> formats{"png", "exr", "pfm", "hdr", "ppm"};

void read_rate(CommandRequest& request, Text t) {
  const std::size_t slash = t.find('/');
  request.rate = static_cast<int>(read_whole(t.substr(0, slash), 1, 1000000));
  request.rate_divisor = slash == t.npos ? 1 : static_cast<int>(read_whole(t.substr(slash + 1), 1, 1000000));
}

fs::path read_scene_output(Text t) {
  const std::string ending = lower_case(fs::path(t).extension().string());
  const bool foreign = ending == ".pbrt" || ending == ".xml" || ending == ".py";
  return t == "-" || foreign ? fs::path(t) : read_file_name(t, ".json");
}

fs::path read_each(Text t) {
  read_valued_name(t);
  return t;
}

/// An option of 0.2.0.
void refuse_accuracy(CommandRequest&, Text) {
  throw UsageError(
      "--accuracy is no option any more: its table stands in tests/README.md, \"What approximations "
      "cost\", and \"tyndall_bench approximations\" makes it anew");
}

constexpr const char* of_threads =
    "worker threads; the image is the same for any number\n[processors that this "
    "process may use: affinity, and quota rounded up]";
constexpr const char* of_files =
    "scene file, built-in scene (see tyndall scenes), PNG or EXR made\n"
    "by Tyndall, - for standard input, or MAIN.cc (.cpp, .cxx): a\n"
    "program of \"Ray Tracing in One Weekend\", which is compiled and\n"
    "run; its other source files may follow";
const Taker gamma2 = by([](CommandRequest& request, Text) { request.form.ppm = PpmCurve::gamma2; }, Takes::flag);

std::vector<OptionRow> scene_rows() {
  return {
      {"SCENE", " ", add_to(&CommandRequest::operands), of_files + std::string(" [showroom]"), "view"},
      {"SCENE", " ", add_to(&CommandRequest::operands), of_files},
      {"--set", "POINTER=VALUE",
       by([](CommandRequest& request, Text t) { request.scene.overrides.push_back(read_override(t)); }, Takes::each),
       "override one value of the scene's JSON before it is checked, e.g.\n"
       "/materials/gold/fuzz=0.2; VALUE is JSON, else a string;\n"
       "repeatable, in order"},
      {"-I,--include", "DIR",
       by([](CommandRequest& request, Text t) { request.scene.program.sources.include_folders.emplace_back(t); },
          Takes::each),
       "of a program: a folder of headers; repeatable"},
      {"--trust", "", by([](CommandRequest& request, Text) { request.scene.program.trusted = true; }, Takes::flag),
       "run a program also where the system cannot keep it from changing\nyour files (see tyndall --version)"},
      {"--size", "WxH", by([](CommandRequest& request, Text t) { request.scene.size = read_size(t); }),
       "image size in pixels [the scene's, made smaller to 65,536 pixels]", "chart"},
      {"--size", "WxH", by([](CommandRequest& request, Text t) { request.scene.size = read_size(t); }),
       "image size in pixels [from the scene]"},
      {"-t,--threads", "N", to(&CommandRequest::threads, whole(1, max_threads)),
       "worker threads [the processors that this process may use:\naffinity, and quota rounded up]", "chart"},
      {"-t,--threads", "N", to(&CommandRequest::threads, whole(1, max_threads)), of_threads},
      {"--isa", "NAME", name_to(&CommandRequest::isa, names_of_targets()),
       "scalar; sse4, avx2, avx512 (x86-64); neon (ARM)\n[the best that this CPU runs]"},
  };
}

std::vector<OptionRow> output_rows() {
  return {
      {"-o,--output", "FILE", add_to(&CommandRequest::outputs),
       ".png: 8-bit sRGB; .exr: float, linear, with layers and the film\n"
       "itself; .pfm, .hdr: float, linear; .ppm: 8-bit sRGB, as PNG; - for\n"
       "standard output; repeatable; required",
       "render"},
      {"-o,--output", "FILE", add_to(&CommandRequest::outputs),
       ".png .exr .pfm .hdr .ppm or -, as for render; repeatable; required", "merge"},
      {"-o,--output", "FILE", add_to(&CommandRequest::outputs),
       ".png .pfm .hdr .ppm: the filtered picture; .exr: the film, beside\n"
       "it denoised.R/G/B and denoised.error; - for standard output;\n"
       "repeatable; required",
       "denoise"},
      {"-o,--output", "FILE", add_to(&CommandRequest::outputs),
       "'f/%04d.png', a file for each frame, any of render's formats;\n"
       ".y4m, or - for standard output: 8 bits, 4:4:4, BT.601; repeatable;\nrequired",
       "animate"},
      {"-o,--output", "SHEET.png", to(&CommandRequest::sheet), "sheet of all pictures, .png or .ppm", "sweep"},
      {"-o,--output", "FILE.svg", to(&CommandRequest::output), "the chart; required", "chart"},
      {"-o,--output", "FILE", to(&CommandRequest::output, read_scene_output),
       ".json, .pbrt, .xml or .py, or - for JSON on standard output; required", "convert"},
      {"--format",
       "NAME",
       {[](CommandRequest& request, Text t) { request.form.format = formats[read_name(t, formats)]; }, Takes::once,
        formats},
       "png, exr, pfm, hdr or ppm: the format of what goes to standard output"},
      {"--gamma2", "", gamma2,
       "a picture from standard input is read as the books' programs\nwrite it, by the square of its numbers, not by "
       "sRGB's curve",
       "view"},
      {"--gamma2", "", gamma2,
       "read PPM files as the books' programs write them, by the square of\ntheir numbers, not by sRGB's curve",
       "compare"},
      {"--gamma2", "", gamma2,
       "write PPM files as the books' programs do: by the square root in\nplace of sRGB's curve, rounded down, "
       "not dithered"},
      {"--exr-film", "yes|no",
       by([](CommandRequest& request, Text t) { request.form.exr_film = one_of("no", "yes")(t); }),
       "whether .exr files hold the film itself, which merge, denoise,\n"
       "--resume and checkpoints need; without it they are smaller [yes]"},
      {"--csv", "FILE.csv", to(&CommandRequest::csv),
       "table: values; mean; errors; change and difference to the picture\n"
       "in the middle, each with its own error; samples; seconds; hash"},
      {"--each", "NAME", add_to(&CommandRequest::outputs, read_each),
       "a file for each picture, any of render's formats; %v stands for the\n"
       "value: 'dir/%v.exr'. A sweep with .exr that was killed goes on"},
      {"--stats", "FILE.json", to(&CommandRequest::stats),
       "write the filtered picture's estimated error, its hash and the time", "denoise"},
      {"--stats", "NAME", to(&CommandRequest::stats), "figures of each frame: 'f/%04d.json'", "animate"},
      {"--stats", "FILE.json", to(&CommandRequest::stats), "write figures of the run"},
      {"--progress",
       "NAME",
       {[](CommandRequest& request, Text t) { read_option(t, {}, request.progress); }, Takes::once,
        choices(ProgressStyle::automatic)},
       wrapped("on standard error" + choices_text(ProgressStyle::automatic) + " [auto]", help_width)},
      {"-q,--quiet", "", by([](CommandRequest& request, Text) { request.progress = ProgressStyle::none; }, Takes::flag),
       "no progress"},
      {"--json", "", on(&CommandRequest::json), "print JSON"},
  };
}

// A table, which may be as long as it has rows.
std::vector<OptionRow> render_rows() {  // NOLINT(readability-function-size)
  return {
      {"--region", "X0,Y0,X1,Y1", to(&CommandRequest::region, read_region),
       "render the pixels X0 <= x < X1, Y0 <= y < Y1 only, y down;\n"
       "EXR gets a data window, other files the region's size"},
      {"--denoise", "", on(&CommandRequest::denoise),
       "files hold the filtered picture, as with 'tyndall render --denoise'", "merge"},
      {"--denoise", "", on(&CommandRequest::denoise),
       "files hold the filtered picture: noise is taken away where the\n"
       "samples show that it is noise, and the error that is left is\n"
       "estimated; EXR files get both in denoised.R/G/B and\n"
       "denoised.error beside the raw picture; not with --samples"},
      {"--frame", "N", to(&CommandRequest::frame, whole(0, max_frames - 1)),
       "the frame N of the scene's animation; its seed is the scene's and N"},
      {"--replay", "X,Y,SAMPLE", to(&CommandRequest::replay, read_sample_key),
       "write no image; print the path of this sample of this pixel,\n"
       "vertex by vertex, as --isa scalar follows it"},
      {"--checkpoint", "SECONDS", to(&CommandRequest::checkpoint, number(at_least(0), "a number of seconds >= 0")),
       "how often the film of an .exr output is written meanwhile, so that\n"
       "a render that was killed can go on; 0: never\n"
       "[the longer of 30 s and 100 times what the last one took]"},
      {"--fresh", "", on(&CommandRequest::fresh),
       "start over; without it the same command goes on from the\nunfinished film in its .exr output", "render"},
      {"--fresh", "", on(&CommandRequest::fresh),
       "replace the pictures that are there; without it those in .exr files\nare kept", "sweep"},
      {"--fresh", "", on(&CommandRequest::fresh),
       "replace the frames that are there; without it those that fit are kept", "animate"},
      {"--resume", "", on(&CommandRequest::resume),
       "insist on going on: fail where the .exr output holds no film, also\n"
       "a finished one, of this scene and these settings"},
      {"--watch-at", "HOST[:PORT]", to(&CommandRequest::viewer, read_viewer_address),
       "stream the picture to a viewer that speaks tev's protocol: R, G, B,\n"
       "error and the clean view; one that fails or is slow is told in a\n"
       "line and costs less than 1 % of the time [port 14158]"},
      {"--spp", "N", by([](CommandRequest& request, Text t) {
         set(request.scene.render, &RenderSettings::spp, whole(1, max_samples)(t));
       }),
       "samples per pixel [from the scene, else none]", "view"},
      {"--spp", "N", by([](CommandRequest& request, Text t) {
         request.spp = static_cast<std::uint32_t>(read_whole(t, 1, max_samples));
       }),
       "samples per pixel [without another limit: from the scene, else 64]"},
      {"--time", "SECONDS", to(&CommandRequest::seconds, seconds()),
       "wall time, once the scene is loaded; what any answer needs is done in\nany case [20]", "compare"},
      {"--time", "SECONDS", to(&CommandRequest::time_limit, seconds()),
       "wall time of rendering; looked at between passes, after the first"},
      {"--target-error", "E", to(&CommandRequest::target_error, number(above(0), "a number > 0")),
       "estimated relative error; its square estimates relMSE", "view"},
      {"--target-error", "E", to(&CommandRequest::target_error, number(above(0), "a number > 0")),
       "estimated relative error, with --denoise that of the filtered\npicture; its square estimates relMSE"},
      {"--samples", "A:B", to(&CommandRequest::samples, read_samples),
       "exactly the samples A <= i < B of each pixel, for shards that\n"
       "'tyndall merge' adds; not with --spp, --time or --target-error"},
      {"--total-time", "SECONDS", to(&CommandRequest::total_time, seconds()), "wall time of rendering all pictures"},
      {"--vary", "POINTER=VALUES", add_to(&CommandRequest::axes, read_sweep_axis),
       "the value to vary, as --set names it, and in what steps:\n"
       "FROM:TO:STEPS, both ends included; a list such as [0,0.1,0.5];\n"
       "or names such as gold,glass; required, at most twice"},
      {"--frames", "N", to(&CommandRequest::frames, whole(1, max_frames)), "how many [from the scene's animation]"},
      {"--frame-range", "A:B", to(&CommandRequest::range, read_frames),
       "the frames A <= n < B alone, for parts of a film on many machines"},
      {"--turntable", "", on(&CommandRequest::turntable),
       "the camera goes once around look_at, about vup; needs no keys"},
      {"--seed-per-frame", "on|off", to(&CommandRequest::seed_per_frame, one_of("off", "on")),
       "on: the seed of frame n is the scene's and n, so that noise does not\n"
       "stand still on the screen; off: all frames have the scene's seed [on]"},
      {"--fps", "N", by(read_rate), "frames a second of a .y4m, such as 24 or 30000/1001 [24]"},
  };
}

std::vector<OptionRow> other_rows() {
  const Valid positive = at_least(0);
  return {
      {"--reference", "FILE", to(&CommandRequest::reference),
       "image to measure errors against, of the same size; FILE.exr:LAYER\ntakes a layer of an EXR [rendered]",
       "chart"},
      {"--reference", "FILE", to(&CommandRequest::reference),
       "an image of the same scene and size, to show the true error against;\nFILE.exr:LAYER takes a layer of an EXR"},
      {"--ui-log", "FILE", to(&CommandRequest::ui_log),
       "for tests: write what is on the screen and how long things took;\n- for standard output"},
      {"--method", "NAME=FLAGS", add_to(&CommandRequest::methods, read_method),
       "a curve: the scene's settings, and what its flags change\n"
       "(those of Method in 'tyndall render', and --isa); repeatable"},
      {"--budget", "SECONDS", to(&CommandRequest::budget, seconds()), "time for all, the reference included [50]"},
      {"NAME", " ", add_to(&CommandRequest::operands), "beginnings of the names of cases, e.g. plate [all]"},
      {"--thorough", "", on(&CommandRequest::thorough), "standard errors of at most 1e-4 of the value instead of 1e-3"},
      {"PART", " ", add_to(&CommandRequest::operands), "EXR files that hold films of the same scene, in any order"},
      {"FILM.exr", " ", to(&CommandRequest::image), "an EXR that 'tyndall render' or 'tyndall merge' wrote"},
      {"--measure", "", on(&CommandRequest::measure),
       "measure how much faster the kernel is than the full one,\nand what chains gain over chance (4 s)"},
      {"--accuracy", "", by(refuse_accuracy, Takes::flag), ""},
      {"IMAGE REFERENCE", " ", add_to(&CommandRequest::operands),
       "PNG, PPM, JPEG, BMP, TGA, PFM, HDR or EXR, or FILE.exr:LAYER for a\n"
       "layer, a part, a view or a channel of an EXR; the second one is what\n"
       "the first should look like, of the same size, or a scene; the first\n"
       "one may be - for standard input. With --baseline: any number of\n"
       "images, and folders of them, with all folders in them"},
      {"--heatmap", "FILE.png", to(&CommandRequest::heatmap, file(".png")),
       "write FLIP of each pixel, in colours, with their scale beneath"},
      {"--max-rmse", "X", limit(&Tolerance::rmse, positive, "a number >= 0"), "fail if RMSE is above X"},
      {"--max-relmse", "X", limit(&Tolerance::rel_mse, positive, "a number >= 0"), "fail if relMSE is above X"},
      {"--max-flip", "X", limit(&Tolerance::flip, positive, "a number >= 0"), "fail if FLIP is above X"},
      {"--max-z", "Z", limit(&Tolerance::z, above(0), "a number > 0"),
       "fail if the mean of a channel, a block of 16x16 pixels, or the\n"
       "number of outliers differs by more than Z standard errors of the\n"
       "noise that both pictures carry, corrected for the number of tests;\n"
       "EXR as render writes them, or a.pfm with a.error.pfm"},
      {"--baseline", "DIR", by([](CommandRequest& request, Text t) { request.baseline.folder = t; }),
       "compare each image with the one of its name in this folder, by the\n"
       "tolerances that are kept there, else --max-flip 0.02; that one also\n"
       "fails where relMSE among values outside [0, 1], which FLIP clips, is\n"
       "above 0.01"},
      {"--update", "", on(&CommandRequest::update),
       "put the images into the folder, and the limits of --max-... as their\n"
       "tolerances; without limits these stay. Nothing is changed where an\n"
       "image cannot be read or has values that are not finite"},
      {"--report", "FILE.html", to(&CommandRequest::report, file(".html")),
       "write one page with numbers, both pictures behind a slider, and FLIP"},
      {"--junit", "FILE.xml", to(&CommandRequest::junit, file(".xml")), "write the results as JUnit does"},
  };
}

}  // namespace

const OptionRow& option_row(std::string_view name, std::string_view command) {
  static const std::vector<std::vector<OptionRow>> all{scene_rows(), output_rows(), render_rows(), other_rows()};
  for (const auto& rows : all)
    for (const OptionRow& row : rows)
      if ((row.commands.empty() || row.commands == command) &&
          (row.names == name || std::string_view(row.names).ends_with("," + std::string(name))))
        return row;
  throw std::logic_error("no option " + std::string(name));
}

}  // namespace tyndall
