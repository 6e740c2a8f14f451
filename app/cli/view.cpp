#include "app/cli/pictures.h"
#include "app/files/arriving_picture.h"
#include "app/files/memory.h"
#include "app/text/markup.h"
#include "app/window/window.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/system/open_file.h"
#include "core/system/process.h"

#ifdef TYNDALL_WINDOW
#include "app/window/system/preferences.h"
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace tyndall {
namespace {

constexpr const char* input_name = "standard input";

/// The word as a shell needs it.
std::string shell_argument(const std::string& argument) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  if (all_printable(argument) == argument) return in_shell(argument);
  std::string quoted;
  for (const char c : argument) {  // what a line cannot show, bash reads from numbers: $'two\x0alines'
    const bool is_plain = c >= 0x20 && c < 0x7f && c != '\'' && c != '\\';
    quoted += is_plain ? std::string(1, c) : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
  return "$'" + quoted + "'";
}

/// The render command that makes the picture which the window would show.
std::string headless_command(const CommandRequest& command) {
  std::string text = "tyndall render";
  if (std::find(command.arguments.begin(), command.arguments.end(), command.scene.what) == command.arguments.end())
    text += " " + shell_argument(command.scene.what);
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const std::string& argument = command.arguments[i];
    const bool of_window = argument.starts_with("--reference") || argument.starts_with("--ui-log");
    if (!of_window) text += " " + shell_argument(argument);
    if (of_window && argument.find('=') == std::string::npos)
      ++i;  // the next word is the option's value: leave it out, too
  }
  const std::filesystem::path scene(command.scene.what);
  const std::string name = scene.extension() == ".png" ? scene.stem().string() + "-again" : scene.stem().string();
  const std::string file = (name == "-" ? "image" : name) + ".png";
  return text + " -o " + shell_argument(file.starts_with('-') ? "./" + file : file);  // a dash would begin an option
}

void check_memory(const Scene& scene) {
  MemoryPlan plan{.width = scene.width, .height = scene.height, .emission = has_lights(scene), .window = true};
  std::string file;
#ifdef TYNDALL_WINDOW
  file = preferences_file().string();
  plan.clean = read_preferences(file).value_or(Preferences{}).clean;
#endif
  check_memory(plan, free_memory(), "write \"clean off\" into " + file);
}

/// Opens the window with the options, and those of the command; where there is none, says what to do instead.
int open_window(const CommandRequest& command, WindowOptions options, const std::string& instead) {
  check_memory(options.scene.scene);
  std::vector<std::filesystem::path> inputs = options.scene.files;
  if (!command.reference.empty()) inputs.push_back(picture_name(command.reference).file);
  check_outputs({{"--ui-log", command.ui_log}}, inputs);
  if (!has_display()) throw IoError("no display for a window; " + instead);
#ifdef TYNDALL_WINDOW
  options.threads = command.threads, options.isa = command.isa;
  options.reference = command.reference, options.ui_log = command.ui_log;
  tell_alpha(options.scene);
  try {
    return run_window(options);
  } catch (const IoError& error) {
    throw IoError(error.what() + ("; " + instead));
  }
#else
  throw IoError("this build has no window; " + instead);
#endif
}

/// Shows what a program writes to standard input, as it comes. begin: the bytes with which it begins.
int view_picture(const CommandRequest& command, const std::string& begin) {
  const SceneRequest& request = command.scene;
  const bool limited = std::isfinite(command.time_limit) || command.target_error > 0;
  if (limited || !request.overrides.empty() || request.size || !request.render.given.empty())
    refuse(
        "standard input: found a picture, expected a scene: --set, --size, limits and the options of rendering change "
        "nothing in a picture");
  const auto picture = std::make_shared<ArrivingPicture>(standard_input, begin, input_name, command.form.ppm);
  WindowOptions options;
  options.picture = picture;
  LoadedScene& loaded = options.scene;  // of the picture's size, to be shown in its place
  loaded.name = input_name;
  loaded.folder = ".";
  loaded.is_picture = true;
  loaded.scene.width = picture->width(), loaded.scene.height = picture->height();
  loaded.scene.render.spp = 1;
  apply(request.display, loaded.scene.display);
  return open_window(command, options,
                     "the program's picture can be kept in a file: > image.ppm in place of | tyndall view -");
}

int view_scene(const CommandRequest& command) {
  if (command.form.ppm == PpmCurve::gamma2)
    refuse("--gamma2: found a scene, expected a picture (P3 or P6) on standard input: only these are read so");
  const auto own = std::make_shared<OwnSamples>();
  const auto open = [request = command.scene, own](const std::function<bool()>& go_on) mutable {
    request.program.go_on = go_on;
    return open_scene_or_samples(request, *own);
  };
  // Without the values of --set: edits begin with these, and may have changed them since.
  const auto read_edits = [request = command.scene](const std::string& what) mutable {
    request.what = what;
    request.overrides.clear();
    request.program.allowed = false;
    return open_scene(request);
  };
  WindowOptions options;
  options.scene = open_scene_or_samples(command.scene, *own);
  find_kernels(command.isa);
  const auto& arguments = command.arguments;
  options.reload = open, options.read_edits = read_edits;
  options.scene_named = std::find(arguments.begin(), arguments.end(), command.scene.what) != arguments.end();
  options.limits = {command.time_limit, command.target_error};
  if (is_program(command.scene.what)) options.function = own->function();
  return open_window(command, options, "the same picture without a window: " + headless_command(command));
}

}  // namespace

int run_view(const CommandRequest& command) {
  if (command.scene.what != "-") return view_scene(command);
  const Beginning begin = beginning_of(standard_input);
  if (begin.bytes.empty()) refuse("{}: found nothing, expected a scene, or a picture (P3 or P6)", input_name);
  if (begin.is_picture) return view_picture(command, begin.bytes);
  if (!begin.is_scene)
    refuse(
        "{}: found {}, expected P3 or P6 as the first bytes, or a scene's {{; what a program says besides its picture "
        "belongs on standard error (std::cerr)",
        input_name, first_line_of(standard_input, begin.bytes));
  // The C library takes back as many bytes as it is given.
  std::for_each(begin.bytes.rbegin(), begin.bytes.rend(), [](char byte) { std::ungetc(byte, stdin); });
  return view_scene(command);
}

}  // namespace tyndall
