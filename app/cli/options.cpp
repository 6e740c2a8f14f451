#include "app/cli/options_render.h"
#include "core/base/text.h"

#include <filesystem>

namespace tyndall {
namespace {

using Text = const std::string&;
using Arguments = const std::vector<std::string>&;

Command read_merge(Arguments arguments) {
  MergeCommand command;
  const auto app =
      new_command("merge PART... -o FILE [options]",
                  "Adds films whose sample ranges follow each other (see 'tyndall render --samples'). The result is,\n"
                  "bit for bit, the film of one render of all the samples.",
                  "Example:\n"
                  "  tyndall render fog.json --samples 0:64 -o a.exr\n"
                  "  tyndall render fog.json --samples 64:128 -o b.exr\n"
                  "  tyndall merge a.exr b.exr -o fog.exr -o fog.png");
  std::vector<std::string> parts;
  add_arguments(*app, "PART", "EXR files that hold films of the same scene, in any order", parts);
  add_outputs(*app, ".png .exr .pfm .hdr .ppm or -, as for render; repeatable; required", command.outputs,
              command.form);
  app->add_flag("--denoise", command.denoise, "files hold the filtered picture, as with 'tyndall render --denoise'");
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !parts.empty(), "PART");
  require(*app, !command.outputs.empty(), "an output (-o FILE)");
  command.parts.assign(parts.begin(), parts.end());
  return command;
}

Command read_denoise(Arguments arguments) {
  DenoiseCommand command;
  const auto app = new_command(
      "denoise FILM.exr -o FILE [options]",
      "Filters the picture of a finished film, and says how wrong the result still is. The film itself\n"
      "stays as it is.\n\n"
      "The samples are two independent halves, and each is filtered by itself. By comparing the halves the\n"
      "filter decides where to show the filtered and where the raw picture, and estimates the error.",
      "Example:\n  tyndall denoise fog.exr -o fog-clean.png");
  std::string film;
  add_argument(*app, "FILM.exr", "an EXR that 'tyndall render' or 'tyndall merge' wrote", film);
  add_outputs(*app,
              ".png .pfm .hdr .ppm: the filtered picture; .exr: the film, beside\n"
              "it denoised.R/G/B and denoised.error; - for standard output;\n"
              "repeatable; required",
              command.outputs, command.form);
  add_value(*app, "--stats", "FILE.json", "write the filtered picture's estimated error, its hash and the time",
            [&](Text t) { command.stats = t; });
  add_machine_options(*app, command.threads, command.isa);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !film.empty(), "FILM.exr");
  require(*app, !command.outputs.empty(), "an output (-o FILE)");
  command.film = film;
  return command;
}

Command read_inspect(Arguments arguments) {
  InspectCommand command;
  command.scene.what.clear();
  const auto app =
      new_command("inspect SCENE [options]", "Says what a scene contains and which models its kernel needs.",
                  "Examples:\n"
                  "  tyndall inspect showroom\n"
                  "  tyndall inspect fog.json --measure\n"
                  "  tyndall inspect snapshot.png --json");
  add_scene(*app, command.scene);
  app->add_flag("--json", command.json, "print JSON");
  app->add_flag("--measure", command.measure,
                "measure how much faster the kernel is than the full one,\nand what chains gain over chance (4 s)");
  add_isa(*app, command.isa);
  bool accuracy = false;
  app->add_flag("--accuracy", accuracy)->group("");  // an option of 0.2.0, which no help lists
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  if (accuracy)
    throw UsageError(
        "--accuracy is no option any more: its table stands in tests/README.md, \"What approximations "
        "cost\", and \"tyndall_bench approximations\" makes it anew");
  require(*app, !command.scene.what.empty(), "SCENE");
  if (!command.isa.empty() && !command.measure) throw UsageError("--isa can only be given with --measure");
  return command;
}

Command read_scenes(Arguments arguments) {
  const auto app =
      new_command("scenes", "Lists the built-in scenes. Every command takes their names in place of a file.");
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  return ScenesCommand{};
}

Command read_convert(Arguments arguments) {
  ConvertCommand command;
  command.scene.what.clear();
  const auto app =
      new_command("convert SCENE -o FILE [options]",
                  "Writes a scene in normal form (.json): every value that is not its default, keys in the format's\n"
                  "order, without comments. Also gets the scene out of an image that Tyndall made.\n\n"
                  "For checking elsewhere it writes the scene for pbrt-v4 (.pbrt), Mitsuba 3 (.xml) and Blender's\n"
                  "Cycles (.py, a script that builds it). What such a renderer has no equal of (fuzz, noise) is named\n"
                  "and ends the command; nothing is approximated.",
                  "Examples:\n"
                  "  tyndall convert snapshot.png -o snapshot.json\n"
                  "  tyndall convert cornell-box -o box.xml\n"
                  "  tyndall convert cornell-smoke -o smoke.py    # blender -b -P smoke.py -- smoke.exr");
  add_scene(*app, command.scene);
  add_value(*app, "-o,--output", "FILE", ".json, .pbrt, .xml or .py, or - for JSON on standard output; required",
            [&](Text t) {
              const std::string ending = lower_case(std::filesystem::path(t).extension().string());
              const bool foreign = ending == ".pbrt" || ending == ".xml" || ending == ".py";
              command.output = t == "-" || foreign ? std::filesystem::path(t) : read_file_name(t, ".json");
            });
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !command.scene.what.empty(), "SCENE");
  require(*app, !command.output.empty(), "an output (-o FILE)");
  return command;
}

struct Entry {
  const char* name;
  const char* about;
  Command (*read)(Arguments arguments);
};

constexpr Entry entries[] = {
    {"view", "open a scene in the window (also without this word; default: the showroom)", read_view},
    {"render", "render without a window and write images", read_render},
    {"sweep", "render one or two values of a scene in steps, and say which differences are real", read_sweep},
    {"animate", "render the frames of a film, from keys or on a turntable", read_animate},
    {"compare", "measure how far an image is from a reference", read_compare},
    {"chart", "chart speed against accuracy: error over time of several methods", read_chart},
    {"verify", "check the renderer against known answers", read_verify},
    {"merge", "add films whose sample ranges follow each other", read_merge},
    {"denoise", "filter the picture of a finished film", read_denoise},
    {"inspect", "say what a scene contains and which models it needs", read_inspect},
    {"scenes", "list the built-in scenes", read_scenes},
    {"convert", "write a scene in normal form, also from an image", read_convert},
};

std::string overview() {
  std::string text =
      "Tyndall: an interactive, progressive path tracer for glass, brushed metal and fog.\n"
      "Usage: tyndall [SCENE] | tyndall COMMAND [options]\n\nCommands:\n";
  for (const Entry& entry : entries)
    text += "  " + std::string(entry.name) + std::string(10 - std::string(entry.name).size(), ' ') + entry.about + "\n";
  return text +
         "\nOptions:\n"
         "  -h, --help    show this text; 'tyndall COMMAND --help' shows that of a command\n"
         "  -V, --version show the version, the compiler, instruction sets and libraries\n"
         "  help man, help bash, help zsh, help fish: the manual's page; completion for a shell\n\n"
         "Exit codes: 0 done; 1 a check failed; 2 wrong usage or a scene that cannot be read;\n"
         "3 input, output or display error; 130 Ctrl-C; 128 and its number: another signal.\n";
}

/// Throws if a word that was not taken for a command must have been meant as one.
void refuse_misspelt_command(Text argument, bool alone) {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.emplace_back(entry.name);
  const std::string hint = suggestion(argument, names);
  if ((hint.empty() && alone) || argument[0] == '-' || argument.find_first_of("./") != std::string::npos) return;
  std::error_code error;
  if (hint.empty() || std::filesystem::exists(argument, error)) return;
  throw UsageError("unknown command " + in_quotes(argument) + hint);
}

/// Throws if the first word must have been meant as an option of the program itself.
void refuse_misspelt_option(Text argument) {
  if (argument.size() < 3 || argument[0] != '-') return;
  const std::string hint = suggestion(argument, {"--version", "--help"});
  if (!hint.empty()) throw UsageError("unknown option " + in_quotes(argument) + hint + " (see tyndall --help)");
}

Command read_help(Arguments arguments) {
  if (arguments.empty()) return PrintCommand{overview(), {}};
  std::string (*const writers[])(const std::vector<CommandPage>&) = {man_page, bash_completion, zsh_completion,
                                                                     fish_completion};
  const std::size_t form = read_name(arguments[0], {"man", "bash", "zsh", "fish"});
  std::vector<CommandPage> pages;
  for (const Entry& entry : entries) {
    pages.push_back(std::get<PrintCommand>(entry.read({"--help"})).page);
    pages.back().summary = entry.about;
  }
  return PrintCommand{writers[form](pages), {}};
}

}  // namespace

Command read_command(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return ViewCommand{};
  const std::string& first = arguments.front();
  if (first == "-h" || first == "--help") return PrintCommand{overview(), {}};
  if (first == "help") return read_help({arguments.begin() + 1, arguments.end()});
  if (first == "-V" || first == "--version" || first == "version") return PrintCommand{version_text(), {}};
  for (const Entry& entry : entries)
    if (first == entry.name) return entry.read({arguments.begin() + 1, arguments.end()});
  if (first == "book" && !std::filesystem::exists(first))
    throw UsageError(
        "book: the folder of headers is gone: programs are read with their own; in place of a build by hand: tyndall "
        "main.cc, tyndall render main.cc -o picture.exr, or ./mine | tyndall view -");
  refuse_misspelt_command(first, arguments.size() == 1);
  if (arguments.size() == 1) refuse_misspelt_option(first);
  return read_view(arguments);
}

}  // namespace tyndall
