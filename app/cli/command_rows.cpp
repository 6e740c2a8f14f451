#include "app/cli/requests.h"
#include "app/manual/page.h"
#include "core/scene/place.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <type_traits>

namespace tyndall {
namespace {

constexpr const char* usual_heading = "Options";

/// The groups of a command that renders a scene: its own ones stand between those of the scene and of the method.
std::vector<OptionGroup> rendering(std::vector<OptionGroup> own, const char* machine = "--threads --isa") {
  own.insert(own.begin(), {usual_heading, "SCENE --set --include --trust"});
  own.insert(own.end(), {{"Image", "--size {display}"}, {"Method", "{render}"}, {"Machine", machine}});
  return own;
}

/// A value from the text of an option. Throws UsageError.
template <class T>
T read_option(const std::string& text, Meaning meaning) {
  if constexpr (NamedEnum<T>) {
    const std::vector<std::string_view> names = names_of<T>();
    return static_cast<T>(read_name(text, {names.begin(), names.end()}));
  } else if constexpr (std::is_same_v<T, bool>) {
    return read_name(text, {"off", "on"}) == 1;
  } else if constexpr (std::is_same_v<T, double>) {
    return read_number(text, meaning.valid, expected_text(meaning, Form::number));
  } else {
    Valid& valid = meaning.valid;
    valid.low = std::max(valid.low, static_cast<double>(std::numeric_limits<T>::min()));
    valid.high = std::min(valid.high, static_cast<double>(std::numeric_limits<T>::max()));
    return static_cast<T>(read_whole(text, valid, expected_text(meaning, Form::whole)));
  }
}

/// Rows for all fields of a part of SceneRequest but those that may be absent. A switch that is off by default needs no
/// value.
template <class Settings>
std::vector<OptionRow> setting_rows(Changes<Settings> SceneRequest::*changes) {
  std::vector<OptionRow> rows;
  for_each_field(fields_of<Settings>(), [&]<class T>(const Field<Settings, T>& field) {
    if constexpr (std::is_arithmetic_v<T> || NamedEnum<T>) {
      const T usual = Settings().*field.value;
      const auto take = [=](CommandRequest& request, const std::string& text) {
        set(request.scene.*changes, field.value, read_option<T>(text, meaning_of(field)));
      };
      std::string name = std::string("--") + field.name;
      std::replace(name.begin(), name.end(), '_', '-');
      OptionRow& row = rows.emplace_back(name, "N", Taker{take}, field.help);
      if constexpr (std::is_same_v<T, bool>) {
        row.unit = usual ? "on|off" : "";
        if (usual) row.taker.choices = {"on", "off"};
      } else if constexpr (std::is_same_v<T, double>) {
        row.unit = *field.unit ? field.unit : "X";
      } else if constexpr (NamedEnum<T>) {
        row.unit = "NAME";
        for (int i = 0; i < count_of<T>(); ++i) {
          const Label choice = label(static_cast<T>(i));
          row.taker.choices.emplace_back(choice.name);
          row.help += std::string(i == 0 ? ": " : "; ") + choice.name;
          if (*choice.help) row.help += std::string(" (") + choice.help + ")";
        }
      }
      row.help += " [from the scene, else " + setting_text(usual) + "]";
    }
  });
  return rows;
}

/// The rows that a word of a group stands for.
std::vector<OptionRow> rows_of(std::string name, const std::string& command) {
  if (name == "{display}") return setting_rows(&SceneRequest::display);
  if (name == "{render}") {
    std::vector<OptionRow> rows = setting_rows(&SceneRequest::render);
    if (command == "verify") std::erase_if(rows, [](const OptionRow& row) { return row.names == "--adaptive"; });
    return rows;
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return {option_row(name, command)};
}

/// The text in lines of at most that many bytes, broken at spaces. Longer words, and what stands in [brackets], are not
/// broken.
std::string wrapped(const std::string& text, std::size_t columns) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t inside = text[at] == '[' ? text.find(']', at) : at;
    const std::size_t end = std::min(text.find(' ', std::min(inside, text.size())), text.size());
    const std::size_t used = out.size() - (out.rfind('\n') + 1);  // of the last line; npos + 1 is 0
    if (!out.empty()) out += used + 1 + (end - at) <= columns ? ' ' : '\n';
    out += text.substr(at, end - at);
    at = end + 1;
  }
  return out;
}

/// A line of a help that is longer is broken, at spaces, into lines of that many columns beside the option's name.
constexpr std::size_t longest_line = 70, help_width = 66;

void add_options(CommandRow& command) {
  command.options.emplace_back("-h,--help", "", Taker{}, "show this text", "", usual_heading);
  for (const OptionGroup& group : command.groups) {
    std::istringstream names(group.options);
    for (std::string name; names >> name;)
      for (OptionRow& option : rows_of(name, command.name())) {
        const bool has_lines = option.help.find('\n') != option.help.npos;
        if (option.help.size() > longest_line && !has_lines) option.help = wrapped(option.help, help_width);
        option.heading = group.heading;
        (option.names[0] == '-' ? command.options : command.arguments).push_back(option);
      }
  }
}

}  // namespace

std::vector<CommandRow> with_options(std::vector<CommandRow> commands) {
  std::for_each(commands.begin(), commands.end(), add_options);
  return commands;
}

// A table, which may be as long as it has rows.
const std::vector<CommandRow>& command_rows() {  // NOLINT(readability-function-size)
  static const std::vector<CommandRow> rows = with_options({
      {"view [SCENE] [options]", "open a scene in the window (also without this word; default: the showroom)",
       "Opens a scene in the window. 'tyndall' alone opens the showroom, 'tyndall SCENE' a scene.\n\n"
       "Where standard input (-) begins with P3 or P6, it is a picture: its rows are shown as a program\n"
       "writes them, to be enlarged, exposed, compared with --reference and saved.",
       "Examples:\n"
       "  tyndall view cornell-box\n"
       "  tyndall view fog.json --set /camera/vfov=30 --spp 256\n"
       "  tyndall view snapshot.png --reference reference.exr\n"
       "  ./mine | tyndall view - --reference cover.exr",
       rendering({{"Limits (the first one reached pauses the picture; Space goes on)", "--spp --time --target-error"}},
                 "--threads --isa --reference --gamma2 --ui-log"),
       run_view},
      {"render SCENE -o FILE [options]", "render without a window and write images",
       "Renders a scene without a window and writes the image.",
       "Examples:\n"
       "  tyndall render cornell-box -o box.png\n"
       "  tyndall render fog.json --spp 1000 -o fog.exr -o fog.png --stats fog-stats.json\n"
       "  tyndall render box.png --set /camera/vfov=30 -o closer.png\n"
       "  tyndall render next-week -o week.exr --watch-at localhost    # seen in tev meanwhile",
       rendering(
           {{"Output",
             "--output --format --gamma2 --exr-film --region --denoise --stats --frame --replay --checkpoint --fresh "
             "--resume --watch-at --progress --quiet"},
            {"Limits (the first one reached ends the render)", "--spp --time --target-error --samples"}}),
       run_render},
      {"sweep SCENE --vary POINTER=FROM:TO:STEPS -o SHEET.png [options]",
       "render one or two values of a scene in steps, and say which differences are real",
       "Renders a scene with one or two of its values in steps: a sheet of all pictures with the values\n"
       "beneath them, and a table of how far each differs from the one in the middle.\n\n"
       "All pictures have one seed, so that most of their noise is the same, and differences are several times\n"
       "cleaner than between pictures of different seeds. Their error is estimated from the two halves of the\n"
       "difference itself.",
       "Examples:\n"
       "  tyndall sweep showroom --vary /materials/gold/fuzz=0:0.4:9 -o fuzz.png --csv fuzz.csv\n"
       "  tyndall sweep glass-spheres --vary /materials/glass/refractive_index=[1.3,1.5,1.8] -o glass.png\n"
       "  tyndall sweep showroom --vary /objects/0/material=gold,glass --vary /camera/vfov=20:40:3 -o two.png",
       rendering(
           {{"Values", "--vary"},
            {"Output",
             "--output --csv --each --gamma2 --exr-film --region --denoise --checkpoint --fresh --progress --quiet"},
            {"Limits (the first one reached ends the picture)", "--spp --time --target-error --total-time"}}),
       run_sweep},
      {"animate SCENE --frames N -o 'f/%04d.png' [options]", "render the frames of a film, from keys or on a turntable",
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
       "      -color_primaries bt709 -color_trc iec61966-2-1 -color_range tv film.mp4",
       rendering({{"Film", "--frames --frame-range --turntable --seed-per-frame --fps"},
                  {"Output",
                   "--output --gamma2 --exr-film --region --denoise --stats --checkpoint --fresh --progress --quiet"},
                  {"Limits (the first one reached ends the frame)", "--spp --time --target-error"}}),
       run_animate},
      {"compare IMAGE REFERENCE | IMAGE SCENE | IMAGE... --baseline DIR [options]",
       "measure how far an image is from a reference",
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
       "  tyndall compare a.exr --baseline kept --report report.html",
       {{usual_heading, "IMAGE_REFERENCE --gamma2 --heatmap --json"},
        {"With a scene", "--time --set --include --trust"},
        {"Checks", "--max-rmse --max-relmse --max-flip --max-z"},
        {"Baseline (a folder of pictures that renders should go on looking like)",
         "--baseline --update --report --junit"}},
       run_compare},
      {"chart SCENE -o FILE.svg [options]",
       "chart speed against accuracy: error over time of several methods",
       "Charts speed against accuracy: relMSE over seconds of rendering, a curve for each method, against\n"
       "a reference. Without --method: the books' method and each improvement switched on in turn. Writes\n"
       "the chart, a CSV file beside it (method,spp,seconds,relmse), and prints a table. SCENE 'all' makes\n"
       "a gallery of charts in the folder -o.",
       "Examples:\n"
       "  tyndall chart cornell-smoke -o smoke.svg\n"
       "  tyndall chart fog.json --method 'mis=' --method 'no MIS=--integrator nee' -o fog.svg",
       {{usual_heading,
         "SCENE --set --include --trust --output --method --reference --budget --size --threads --progress --quiet"}},
       run_chart},
      {"verify [NAME...] [options]",
       "check the renderer against known answers",
       "Renders pictures whose mean radiance is known, and prints a table: the expected mean, where it is\n"
       "from, the measured one, its standard error, the deviation in standard errors (z), the verdict.\n\n"
       "A case fails above |z| = 4 or if samples were rejected. The mean square of all z must be near 1:\n"
       "otherwise the standard errors are wrong. Exit code 1 if anything fails.",
       "Examples:\n"
       "  tyndall verify\n"
       "  tyndall verify plate fog-ball/ --isa scalar\n"
       "  tyndall verify plate --fresnel schlick      # the books' rule fails",
       {{usual_heading, "NAME --thorough --json --progress --quiet"},
        {"Method", "{render}"},
        {"Machine", "--threads --isa"}},
       run_verify},
      {"merge PART... -o FILE [options]",
       "add films whose sample ranges follow each other",
       "Adds films whose sample ranges follow each other (see 'tyndall render --samples'). The result is,\n"
       "bit for bit, the film of one render of all the samples.",
       "Example:\n"
       "  tyndall render fog.json --samples 0:64 -o a.exr\n"
       "  tyndall render fog.json --samples 64:128 -o b.exr\n"
       "  tyndall merge a.exr b.exr -o fog.exr -o fog.png",
       {{usual_heading, "PART --output --format --gamma2 --exr-film --denoise"}},
       run_merge},
      {"denoise FILM.exr -o FILE [options]",
       "filter the picture of a finished film",
       "Filters the picture of a finished film, and says how wrong the result still is. The film itself\n"
       "stays as it is.\n\n"
       "The samples are two independent halves, and each is filtered by itself. By comparing the halves the\n"
       "filter decides where to show the filtered and where the raw picture, and estimates the error.",
       "Example:\n  tyndall denoise fog.exr -o fog-clean.png",
       {{usual_heading, "FILM.exr --output --format --gamma2 --exr-film --stats"}, {"Machine", "--threads --isa"}},
       run_denoise},
      {"inspect SCENE [options]",
       "say what a scene contains and which models it needs",
       "Says what a scene contains and which models its kernel needs.",
       "Examples:\n"
       "  tyndall inspect showroom\n"
       "  tyndall inspect fog.json --measure\n"
       "  tyndall inspect snapshot.png --json",
       {{usual_heading, "SCENE --set --include --trust --json --measure --isa"}, {"", "--accuracy"}},
       run_inspect},
      {"scenes",
       "list the built-in scenes",
       "Lists the built-in scenes. Every command takes their names in place of a file.",
       "",
       {},
       run_scenes},
      {"convert SCENE -o FILE [options]",
       "write a scene in normal form, also from an image",
       "Writes a scene in normal form (.json): every value that is not its default, keys in the format's\n"
       "order, without comments. Also gets the scene out of an image that Tyndall made.\n\n"
       "For checking elsewhere it writes the scene for pbrt-v4 (.pbrt), Mitsuba 3 (.xml) and Blender's\n"
       "Cycles (.py, a script that builds it). What such a renderer has no equal of (fuzz, noise) is named\n"
       "and ends the command; nothing is approximated.",
       "Examples:\n"
       "  tyndall convert snapshot.png -o snapshot.json\n"
       "  tyndall convert cornell-box -o box.xml\n"
       "  tyndall convert cornell-smoke -o smoke.py    # blender -b -P smoke.py -- smoke.exr",
       {{usual_heading, "SCENE --set --include --trust --output"}},
       run_convert},
  });
  return rows;
}

}  // namespace tyndall
