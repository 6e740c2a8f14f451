#include "app/cli/requests.h"
#include "app/manual/page.h"
#include "core/base/target.h"
#include "core/base/thread_pool.h"
#include "core/scene/json_tree.h"

#include <functional>

namespace tyndall {
namespace {

using Text = const std::string&;
using Names = std::vector<std::string>;
using R = CommandRequest;
namespace fs = std::filesystem;

/// A member of the request, of that member, and so on: in(&R::scene, &SceneRequest::size).
template <class... Member>
auto in(Member... members) {
  return [=](R& request) -> decltype(auto) { return (request.*....*members); };
}
/// Puts what a function reads from the text into a place of the request: without a function the text as it is, for a
/// name, a file or a word.
template <class Place, class Read = std::identity>
Taker to(Place place, Read read = {}, const Names& choices = {}) {
  return {[=](R& request, Text t) { std::invoke(place, request) = read(t); }, choices};
}
template <class Place, class Read = std::identity>
Taker add_to(Place place, Read read = {}) {
  return {[=](R& request, Text t) { std::invoke(place, request).emplace_back(read(t)); }, {}, true};
}
template <class Place, class Value = bool>
Taker on(Place place, Value value = true) {
  return {[=](R& request, Text) { std::invoke(place, request) = value; }};
}

/// Readers of values in a range.
auto whole(std::int64_t low, std::int64_t high) {
  return [low, high](Text t) { return static_cast<int>(read_whole(t, low, high)); };
}
auto number(Valid valid, const char* expected) {
  return [valid, expected](Text t) { return read_number(t, valid, expected); };
}
auto file(const Names& endings) {
  return [endings](Text t) { return read_file_name(t, endings); };
}
/// One of two names, which mean no and yes.
auto one_of(const char* no, const char* yes) {
  return [no, yes](Text t) { return read_name(t, {no, yes}) == 1; };
}
/// The name of one of these.
auto one_of(const Names& names) {
  return [names](Text t) { return names[read_name(t, names)]; };
}

void read_rate(R& request, Text t) {
  const std::size_t slash = t.find('/');
  request.rate = whole(1, 1000000)(t.substr(0, slash));
  request.rate_divisor = slash == t.npos ? 1 : whole(1, 1000000)(t.substr(slash + 1));
}

fs::path read_scene_output(Text t) {
  const std::string ending = lower_case(fs::path(t).extension().string());
  const bool foreign = ending == ".pbrt" || ending == ".xml" || ending == ".py";
  return t == "-" || foreign ? fs::path(t) : read_file_name(t, {".json"});
}

/// The text as it is, if that function takes it.
template <class Read>
auto checked_by(Read read) {
  return [read](Text t) -> fs::path {
    read(t);
    return t;
  };
}

/// A video, or the names of frames.
void read_frame_output(R& request, Text t) {
  if (t != "-" && lower_case(fs::path(t).extension().string()) != ".y4m") {
    read_numbered_name(t);
    request.outputs.emplace_back(t);
    return;
  }
  if (!request.video.empty()) refuse("found two films, expected one .y4m or -");
  request.video = t;
}

SweepAxis read_axis(Text t) {
  SweepAxis axis = read_sweep_axis(t);
  const auto steps = pointer_steps(axis.pointer);
  if (steps && steps->front() == "image")
    refuse("found {}, expected a value that leaves all pictures one size", in_quotes(axis.pointer));
  return axis;
}

/// An option of 0.2.0.
void refuse_accuracy(R&, Text) {
  refuse(
      "--accuracy is no option any more: its table stands in tests/README.md, \"What approximations cost\", and "
      "\"tyndall_bench approximations\" makes it anew");
}

constexpr const char* of_files =
    "scene file, built-in scene (see tyndall scenes), PNG or EXR made by Tyndall, - for standard input, or MAIN.cc "
    "(.cpp, .cxx): a program of \"Ray Tracing in One Weekend\", which is compiled and run; its other source files may "
    "follow";

// A table, which may be as long as it has rows.
std::vector<OptionRow> make_rows() {  // NOLINT(readability-function-size)
  const auto positive = number(at_least(0), "a number >= 0"), above_zero = number(above(0), "a number > 0"),
             seconds = number(above(0), "a number of seconds > 0");
  const Taker operands = add_to(&R::operands), outputs = add_to(&R::outputs), stats = to(&R::stats),
              fresh = on(&R::fresh), denoise = on(&R::clean), size = to(in(&R::scene, &SceneRequest::size), read_size),
              threads = to(&R::threads, whole(1, max_threads)),
              gamma2 = on(in(&R::form, &ImageForm::ppm), PpmCurve::gamma2),
              target_error = to(&R::target_error, above_zero);
  const Names formats{"png", "exr", "pfm", "hdr", "ppm"}, styles{"auto", "plain", "none"};
  Names targets;
  for (const Target target : all_targets) targets.emplace_back(name_of(target));
  return {
      {"SCENE", " ", operands, of_files + std::string(" [showroom]"), "view"},
      {"SCENE", " ", operands, of_files},
      {"--set", "POINTER=VALUE", add_to(in(&R::scene, &SceneRequest::overrides), read_override),
       "override one value of the scene's JSON before it is checked, e.g. /materials/gold/fuzz=0.2; VALUE is JSON, "
       "else a string; repeatable, in order"},
      {"-I,--include", "DIR",
       add_to(in(&R::scene, &SceneRequest::program, &ProgramParts::sources, &ProgramSources::include_folders)),
       "of a program: a folder of headers; repeatable"},
      {"--trust", "", on(in(&R::scene, &SceneRequest::program, &ProgramParts::trusted)),
       "run a program also where the system cannot keep it from changing your files (see tyndall --version)"},
      {"--size", "WxH", size, "image size in pixels [the scene's, made smaller to 65,536 pixels]", "chart"},
      {"--size", "WxH", size, "image size in pixels [from the scene]"},
      {"-t,--threads", "N", threads,
       "worker threads [the processors that this process may use:\naffinity, and quota rounded up]", "chart"},
      {"-t,--threads", "N", threads,
       "worker threads; the image is the same for any number [processors that this process may use: affinity, and "
       "quota rounded up]"},
      {"--isa", "NAME", to(&R::isa, one_of(targets), targets),
       "scalar; sse4, avx2, avx512 (x86-64); neon (ARM) [the best that this CPU runs]"},
      {"-o,--output", "FILE", outputs,
       ".png: 8-bit sRGB; .exr: float, linear, with layers and the film itself; .pfm, .hdr: float, linear; .ppm: 8-bit "
       "sRGB, as PNG; - for standard output; repeatable; required",
       "render"},
      {"-o,--output", "FILE", outputs, ".png .exr .pfm .hdr .ppm or -, as for render; repeatable; required", "merge"},
      {"-o,--output", "FILE", outputs,
       ".png .pfm .hdr .ppm: the filtered picture; .exr: the film, beside it denoised.R/G/B and denoised.error; - for "
       "standard output; repeatable; required",
       "denoise"},
      {"-o,--output", "FILE", Taker{read_frame_output, {}, true},
       "'f/%04d.png', a file for each frame, any of render's formats; .y4m, or - for standard output: 8 bits, 4:4:4, "
       "BT.601; repeatable; required",
       "animate"},
      {"-o,--output", "SHEET.png", to(&R::sheet, file({".png", ".ppm"})), "sheet of all pictures, .png or .ppm",
       "sweep"},
      {"-o,--output", "FILE.svg", to(&R::output), "the chart; required", "chart"},
      {"-o,--output", "FILE", to(&R::output, read_scene_output),
       ".json, .pbrt, .xml or .py, or - for JSON on standard output; required", "convert"},
      {"--format", "NAME", to(in(&R::form, &ImageForm::format), one_of(formats), formats),
       "png, exr, pfm, hdr or ppm: the format of what goes to standard output"},
      {"--gamma2", "", gamma2,
       "a picture from standard input is read as the books' programs\nwrite it, by the square of its numbers, not by "
       "sRGB's curve",
       "view"},
      {"--gamma2", "", on(in(&R::baseline, &BaselineRequest::ppm), PpmCurve::gamma2),
       "read PPM files as the books' programs write them, by the square of their numbers, not by sRGB's curve",
       "compare"},
      {"--gamma2", "", gamma2,
       "write PPM files as the books' programs do: by the square root in place of sRGB's curve, rounded down, not "
       "dithered"},
      {"--exr-film", "yes|no", to(in(&R::form, &ImageForm::exr_film), one_of("no", "yes"), {"yes", "no"}),
       "whether .exr files hold the film itself, which merge, denoise, --resume and checkpoints need; without it they "
       "are smaller [yes]"},
      {"--csv", "FILE.csv", to(&R::csv),
       "table: values; mean; errors; change and difference to the picture in the middle, each with its own error; "
       "samples; seconds; hash"},
      {"--each", "NAME", add_to(&R::outputs, checked_by(read_valued_name)),
       "a file for each picture, any of render's formats; %v stands for the\n"
       "value: 'dir/%v.exr'. A sweep with .exr that was killed goes on"},
      {"--stats", "FILE.json", stats, "write the filtered picture's estimated error, its hash and the time", "denoise"},
      {"--stats", "NAME", to(&R::stats, checked_by(read_numbered_name)), "figures of each frame: 'f/%04d.json'",
       "animate"},
      {"--stats", "FILE.json", stats, "write figures of the run"},
      {"--progress", "NAME",
       to(
           &R::progress, [styles](Text t) { return static_cast<ProgressStyle>(read_name(t, styles)); }, styles),
       "on standard error: auto (a bar on a terminal, else plain); plain (a line now and then); none [auto]"},
      {"-q,--quiet", "", on(&R::progress, ProgressStyle::none), "no progress"},
      {"--json", "", on(&R::json), "print JSON"},
      {"--region", "X0,Y0,X1,Y1", to(&R::region, read_region),
       "render the pixels X0 <= x < X1, Y0 <= y < Y1 only, y down;\n"
       "EXR gets a data window, other files the region's size"},
      {"--denoise", "", denoise, "files hold the filtered picture, as with 'tyndall render --denoise'", "merge"},
      {"--denoise", "", denoise,
       "files hold the filtered picture: noise is taken away where the\n"
       "samples show that it is noise, and the error that is left is\n"
       "estimated; EXR files get both in denoised.R/G/B and\n"
       "denoised.error beside the raw picture; not with --samples"},
      {"--frame", "N", to(&R::frame, whole(0, max_frames - 1)),
       "the frame N of the scene's animation; its seed is the scene's and N"},
      {"--replay", "X,Y,SAMPLE", to(&R::replay, read_sample_key),
       "write no image; print the path of this sample of this pixel, vertex by vertex, as --isa scalar follows it"},
      {"--checkpoint", "SECONDS", to(&R::checkpoint, number(at_least(0), "a number of seconds >= 0")),
       "how often the film of an .exr output is written meanwhile, so that a render that was killed can go on; 0: "
       "never [the longer of 30 s and 100 times what the last one took]"},
      {"--fresh", "", fresh,
       "start over; without it the same command goes on from the unfinished film in its .exr output", "render"},
      {"--fresh", "", fresh, "replace the pictures that are there; without it those in .exr files\nare kept", "sweep"},
      {"--fresh", "", fresh, "replace the frames that are there; without it those that fit are kept", "animate"},
      {"--resume", "", on(&R::resume),
       "insist on going on: fail where the .exr output holds no film, also a finished one, of this scene and these "
       "settings"},
      {"--watch-at", "HOST[:PORT]", to(&R::viewer, read_viewer_address),
       "stream the picture to a viewer that speaks tev's protocol: R, G, B,\n"
       "error and the clean view; one that fails or is slow is told in a\n"
       "line and costs less than 1 % of the time [port 14158]"},
      {"--spp", "N",
       Taker{[](R& request, Text t) { set(request.scene.render, &RenderSettings::spp, whole(1, max_samples)(t)); }},
       "samples per pixel [from the scene, else none]", "view"},
      {"--spp", "N", to(&R::spp, whole(1, max_samples)),
       "samples per pixel [without another limit: from the scene, else 64]"},
      {"--time", "SECONDS", to(&R::seconds, seconds),
       "wall time, once the scene is loaded; what any answer needs is done in\nany case [20]", "compare"},
      {"--time", "SECONDS", to(&R::time_limit, seconds),
       "wall time of rendering; looked at between passes, after the first"},
      {"--target-error", "E", target_error, "estimated relative error; its square estimates relMSE", "view"},
      {"--target-error", "E", target_error,
       "estimated relative error, with --denoise that of the filtered picture; its square estimates relMSE"},
      {"--samples", "A:B", to(&R::sample_range, read_samples),
       "exactly the samples A <= i < B of each pixel, for shards that 'tyndall merge' adds; not with --spp, --time or "
       "--target-error"},
      {"--total-time", "SECONDS", to(&R::total_time, seconds), "wall time of rendering all pictures"},
      {"--vary", "POINTER=VALUES", add_to(&R::axes, read_axis),
       "the value to vary, as --set names it, and in what steps:\n"
       "FROM:TO:STEPS, both ends included; a list such as [0,0.1,0.5];\n"
       "or names such as gold,glass; required, at most twice"},
      {"--frames", "N", to(in(&R::film, &FramePlan::frames), whole(1, max_frames)),
       "how many [from the scene's animation]"},
      {"--frame-range", "A:B", to(&R::range, read_frames),
       "the frames A <= n < B alone, for parts of a film on many machines"},
      {"--turntable", "", on(in(&R::film, &FramePlan::turntable)),
       "the camera goes once around look_at, about vup; needs no keys"},
      {"--seed-per-frame", "on|off", to(in(&R::film, &FramePlan::seed_per_frame), one_of("off", "on"), {"on", "off"}),
       "on: the seed of frame n is the scene's and n, so that noise does not\n"
       "stand still on the screen; off: all frames have the scene's seed [on]"},
      {"--fps", "N", Taker{read_rate}, "frames a second of a .y4m, such as 24 or 30000/1001 [24]"},
      {"--reference", "FILE", to(&R::reference),
       "image to measure errors against, of the same size; FILE.exr:LAYER takes a layer of an EXR [rendered]", "chart"},
      {"--reference", "FILE", to(&R::reference),
       "an image of the same scene and size, to show the true error against;\nFILE.exr:LAYER takes a layer of an EXR"},
      {"--ui-log", "FILE", to(&R::ui_log),
       "for tests: write what is on the screen and how long things took;\n- for standard output"},
      {"--method", "NAME=FLAGS", add_to(&R::methods, read_method),
       "a curve: the scene's settings, and what its flags change\n"
       "(those of Method in 'tyndall render', and --isa); repeatable"},
      {"--budget", "SECONDS", to(&R::budget, seconds), "time for all, the reference included [50]"},
      {"NAME", " ", operands, "beginnings of the names of cases, e.g. plate [all]"},
      {"--thorough", "", on(&R::thorough), "standard errors of at most 1e-4 of the value instead of 1e-3"},
      {"PART", " ", operands, "EXR files that hold films of the same scene, in any order"},
      {"FILM.exr", " ", to(&R::image), "an EXR that 'tyndall render' or 'tyndall merge' wrote"},
      {"--measure", "", on(&R::measure),
       "measure how much faster the kernel is than the full one,\nand what chains gain over chance (4 s)"},
      {"--accuracy", "", Taker{refuse_accuracy}, ""},
      {"IMAGE REFERENCE", " ", operands,
       "PNG, PPM, JPEG, BMP, TGA, PFM, HDR or EXR, or FILE.exr:LAYER for a\n"
       "layer, a part, a view or a channel of an EXR; the second one is what\n"
       "the first should look like, of the same size, or a scene; the first\n"
       "one may be - for standard input. With --baseline: any number of\n"
       "images, and folders of them, with all folders in them"},
      {"--heatmap", "FILE.png", to(&R::heatmap, file({".png"})),
       "write FLIP of each pixel, in colours, with their scale beneath"},
      {"--max-rmse", "X", to(in(&R::baseline, &BaselineRequest::limits, &Tolerance::rmse), positive),
       "fail if RMSE is above X"},
      {"--max-relmse", "X", to(in(&R::baseline, &BaselineRequest::limits, &Tolerance::rel_mse), positive),
       "fail if relMSE is above X"},
      {"--max-flip", "X", to(in(&R::baseline, &BaselineRequest::limits, &Tolerance::flip), positive),
       "fail if FLIP is above X"},
      {"--max-z", "Z", to(in(&R::baseline, &BaselineRequest::limits, &Tolerance::z), above_zero),
       "fail if the mean of a channel, a block of 16x16 pixels, or the number of outliers differs by more than Z "
       "standard errors of the noise that both pictures carry, corrected for the number of tests; EXR as render writes "
       "them, or a.pfm with a.error.pfm"},
      {"--baseline", "DIR", to(in(&R::baseline, &BaselineRequest::folder)),
       "compare each image with the one of its name in this folder, by the\n"
       "tolerances that are kept there, else --max-flip 0.02; that one also\n"
       "fails where relMSE among values outside [0, 1], which FLIP clips, is\n"
       "above 0.01"},
      {"--update", "", on(&R::update),
       "put the images into the folder, and the limits of --max-... as their\n"
       "tolerances; without limits these stay. Nothing is changed where an\n"
       "image cannot be read or has values that are not finite"},
      {"--report", "FILE.html", to(&R::report, file({".html"})),
       "write one page with numbers, both pictures behind a slider, and FLIP"},
      {"--junit", "FILE.xml", to(&R::junit, file({".xml"})), "write the results as JUnit does"},
  };
}

}  // namespace

const OptionRow& option_row(std::string_view name, std::string_view command) {
  static const std::vector<OptionRow> rows = make_rows();
  for (const OptionRow& row : rows)
    if ((row.commands.empty() || row.commands == command) &&
        (row.names == name || row.names.ends_with("," + std::string(name))))
      return row;
  throw std::logic_error("no option " + std::string(name));
}

}  // namespace tyndall
