#pragma once
#include "app/comparison/baseline.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "app/files/sweep_values.h"
#include "app/files/viewer_stream.h"
#include "app/manual/page.h"
#include "app/text/progress.h"
#include "app/text/values.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What the user asked for: one struct for each command. Only read_command() makes them.
namespace tyndall {

struct ViewCommand {
  SceneRequest scene;
  std::vector<std::string> arguments;  ///< as the user typed them; repeated in the message that there is no display
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds after which the picture pauses
  double target_error = 0;                                      ///< the same for its estimated error; 0: none
  int threads = 0;                                              ///< 0: see thread_count()
  std::string isa;                                              ///< "": the best
  PpmCurve ppm = PpmCurve::srgb;                                ///< of a picture from standard input
  std::filesystem::path reference;                              ///< image that errors are measured against; empty: none
  std::filesystem::path ui_log;                                 ///< diagnostic of the window, for tests; empty: none
};

struct RenderCommand {
  SceneRequest scene;
  std::vector<std::filesystem::path> outputs;
  ImageForm form;
  std::optional<std::uint32_t> spp;
  std::optional<SampleRange> samples;
  double time_limit = std::numeric_limits<double>::infinity();  ///< seconds
  double target_error = 0;                                      ///< 0: none
  std::optional<Region> region;
  std::optional<int> frame;          ///< of the scene's animation; absent: the scene without keys
  bool seed_per_frame = true;        ///< with a frame: see FramePlan
  std::optional<SampleKey> replay;   ///< print this sample's path instead of rendering
  int threads = 0;                   ///< 0: see thread_count()
  std::string isa;                   ///< "": the best
  std::filesystem::path stats;       ///< empty: none
  std::optional<double> checkpoint;  ///< seconds, 0: never; absent: see checkpoint.h
  bool fresh = false, resume = false;
  bool denoise = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::optional<ViewerAddress> viewer;  ///< that is shown the picture
};

struct SweepCommand {
  RenderCommand render;                                         ///< of each picture; outputs: names with %v in them
  std::vector<SweepAxis> axes;                                  ///< one or two
  std::filesystem::path sheet, csv;                             ///< empty: none
  double total_time = std::numeric_limits<double>::infinity();  ///< seconds for all pictures
};

struct AnimateCommand {
  RenderCommand render;                           ///< of each frame; outputs: names with %d in them
  std::filesystem::path video;                    ///< .y4m, "-": standard output; empty: none
  std::optional<int> frames;                      ///< absent: as many as the scene says
  std::optional<FrameRange> range;                ///< absent: all
  bool turntable = false, seed_per_frame = true;  ///< see FramePlan
  int rate = 24, rate_divisor = 1;                ///< frames of the video per rate_divisor seconds
};

struct CompareCommand {
  std::filesystem::path image, reference;  ///< without a baseline
  SceneRequest scene;                      ///< what the reference is if its name is a scene's
  std::optional<double> seconds;           ///< for a scene, all of it; absent: 20
  std::filesystem::path heatmap;           ///< empty: none
  BaselineRequest baseline;                ///< without a folder: none
  bool update = false;                     ///< the baseline becomes like the images
  std::filesystem::path report, junit;     ///< of the baseline; empty: none
  Tolerance limits;
  bool json = false;
};

struct VerifyCommand {
  std::vector<std::string> names;  ///< beginnings of the cases' names; none: all cases
  SceneRequest method;             ///< settings for all cases; each case adds its own scene and overrides
  bool thorough = false;           ///< standard errors of 1e-4 instead of 1e-3
  bool json = false;
  int threads = 0;  ///< 0: see thread_count()
  std::string isa;  ///< "": the best
  ProgressStyle progress = ProgressStyle::automatic;
};

/// One curve of a chart: the scene's own settings and what its flags change.
struct MethodRequest {
  std::string name;
  SceneRequest scene;  ///< only its render settings
  std::string isa;     ///< "": the best
};

struct ChartCommand {
  SceneRequest scene;                  ///< "all": a gallery
  std::filesystem::path output;        ///< the SVG; for "all" a folder
  std::filesystem::path reference;     ///< empty: rendered
  std::vector<MethodRequest> methods;  ///< none: the default ones
  double budget = 50;                  ///< seconds, the reference included; for "all" of each chart
  int threads = 0;                     ///< 0: see thread_count()
  ProgressStyle progress = ProgressStyle::automatic;
};

struct MergeCommand {
  std::vector<std::filesystem::path> parts, outputs;
  ImageForm form;
  bool denoise = false;
};

struct DenoiseCommand {
  std::filesystem::path film;
  std::vector<std::filesystem::path> outputs;
  ImageForm form;
  std::filesystem::path stats;  ///< empty: none
  int threads = 0;              ///< 0: see thread_count()
  std::string isa;              ///< "": the best
};

struct InspectCommand {
  SceneRequest scene;
  bool json = false;
  bool measure = false;  ///< measure how much faster the chosen kernel and chains are
  std::string isa;       ///< "": the best; with measure
};

struct ScenesCommand {};

struct ConvertCommand {
  SceneRequest scene;
  std::filesystem::path output;  ///< "-": standard output
};

/// A text to be printed and nothing else: help or the version.
struct PrintCommand {
  std::string text;
  CommandPage page;  ///< of the help of a command: what it says
};

using Command = std::variant<ViewCommand, RenderCommand, SweepCommand, AnimateCommand, CompareCommand, ChartCommand,
                             VerifyCommand, MergeCommand, DenoiseCommand, InspectCommand, ScenesCommand,
                             ConvertCommand, PrintCommand>;

/// The command line as a whole: which command, and its request. arguments[0] is what follows the program's name. Throws
/// UsageError. Of files only the existence is looked at, to tell a misspelt command from a scene's file.
Command read_command(const std::vector<std::string>& arguments);

}  // namespace tyndall
