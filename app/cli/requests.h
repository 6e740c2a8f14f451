#pragma once
#include "app/comparison/baseline.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/files/viewer_stream.h"
#include "app/text/progress.h"
#include "app/text/values.h"
#include "core/render/render.h"

#include <fmt/core.h>

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the user asked for, which only read_command() makes, by the rows of options and commands; and the commands that
/// do it.
namespace tyndall {

/// All that options and arguments can say. Each command reads the part that its options fill. What the options of a
/// render say beside that, such as its first sample, follows from the scene: see set_up().
struct CommandRequest : RenderOptions {
  std::string command;                          ///< "render"
  int (*run)(const CommandRequest&) = nullptr;  ///< what does it
  std::vector<std::string> arguments;           ///< as the user typed them
  std::vector<std::string> operands;            ///< those of them that are neither options nor a scene
  std::string text;                             ///< to be printed and nothing else: help or the version
  SceneRequest scene;

  // Pictures and how they are rendered.
  std::vector<std::filesystem::path> outputs;  ///< of sweep and animate: names with %v or %d in them
  ImageForm form;
  std::optional<SampleRange> sample_range;
  std::optional<int> frame;          ///< of the scene's animation; absent: the scene without keys
  std::optional<SampleKey> replay;   ///< print this sample's path instead of rendering
  std::filesystem::path stats;       ///< empty: none
  std::optional<double> checkpoint;  ///< seconds, 0: never; absent: see checkpoint.h
  bool fresh = false, resume = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<ViewerAddress> viewer;  ///< that is shown the picture

  // Of view.
  std::filesystem::path reference;  ///< image that errors are measured against, also of chart; empty: none
  std::filesystem::path ui_log;     ///< diagnostic of the window, for tests; empty: none

  // Of sweep.
  std::vector<SweepAxis> axes;                                  ///< one or two
  std::filesystem::path sheet, csv;                             ///< empty: none
  double total_time = std::numeric_limits<double>::infinity();  ///< seconds for all pictures

  // Of animate.
  std::filesystem::path video;      ///< .y4m, "-": standard output; empty: none
  FramePlan film{.frames = 0};      ///< 0: as many as the scene says
  std::optional<FrameRange> range;  ///< absent: all
  int rate = 24, rate_divisor = 1;  ///< frames of the video per rate_divisor seconds

  // Of compare.
  std::filesystem::path image;          ///< without a baseline; likewise reference, also a scene
  std::optional<double> seconds;        ///< for a scene, all of it; absent: 20
  std::filesystem::path heatmap;        ///< empty: none
  BaselineRequest baseline;             ///< without a folder: none
  bool update = false;                  ///< the baseline becomes like the images
  std::filesystem::path report, junit;  ///< of the baseline; empty: none

  // Of chart, verify, inspect and convert.
  std::filesystem::path output;  ///< chart: the SVG, for "all" a folder; convert: the scene, "-": standard output
  std::vector<CommandRequest> methods;  ///< curves of a chart: what their flags change
  std::string curve;                    ///< of a method: its name
  double budget = 50;                   ///< seconds, the reference included; for "all" of each chart
  bool json = false;
  bool thorough = false;  ///< standard errors of 1e-4 instead of 1e-3
  bool measure = false;   ///< measure how much faster the chosen kernel and chains are
};

struct OptionRow;   // see app/manual/page.h
struct CommandRow;  // likewise
/// The row of an option, or of an argument such as "SCENE", of that command. There is one.
const OptionRow& option_row(std::string_view name, std::string_view command);
const std::vector<CommandRow>& command_rows();
/// The commands with the options that their groups name.
std::vector<CommandRow> with_options(std::vector<CommandRow> commands);

/// The curve of a chart that --method describes, NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
CommandRequest read_method(const std::string& text);
/// The command line as a whole. arguments[0] is what follows the program's name. Throws UsageError. Of files only the
/// existence is looked at, to tell a misspelt command from a scene's file.
CommandRequest read_command(const std::vector<std::string>& arguments);

/// The exit code of a command that computed a picture and could not write all of it.
inline constexpr int output_failed = 3;

/// Throws a UsageError of that text.
template <class... Part>
[[noreturn]] void refuse(fmt::format_string<Part...> text, Part&&... parts) {
  throw UsageError(fmt::format(text, std::forward<Part>(parts)...));
}

/// The commands. Each returns the program's exit code: 0 when done, 1 if a check failed, output_failed, or 130 and 143
/// if interrupted. For everything else they throw: UsageError, SceneError and MergeError where the user is at fault,
/// IoError and ImageFileError where input or output fails.
int run_view(const CommandRequest& request);
int run_render(const CommandRequest& request);
int run_sweep(const CommandRequest& request);
int run_animate(const CommandRequest& request);
int run_compare(const CommandRequest& request);
int run_chart(const CommandRequest& request);
int run_verify(const CommandRequest& request);
int run_merge(const CommandRequest& request);
int run_denoise(const CommandRequest& request);
int run_inspect(const CommandRequest& request);
int run_scenes(const CommandRequest& request);
int run_convert(const CommandRequest& request);

}  // namespace tyndall
