#include "app/cli/commands.h"
#include "app/cli/render_setup.h"
#include "app/files/memory.h"
#include "app/files/open_scene.h"
#include "app/files/outputs.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#ifdef TYNDALL_WINDOW
#include "app/window/system/preferences.h"
#include "app/window/window.h"
#endif

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace tyndall {
namespace {

/// The word as a shell needs it.
std::string shell_argument(const std::string& argument) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos) return argument;
  std::string quoted = "'";
  if (all_printable(argument) == argument) {
    for (const char c : argument) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
  }
  for (const char c : argument) {  // what a line cannot show, bash reads from numbers: $'two\x0alines'
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f || c == '\'' || c == '\\')
      quoted += fmt::format("\\x{:02x}", byte);
    else
      quoted += c;
  }
  return "$" + quoted + "'";
}

/// The render command that makes the picture which the window would show.
std::string headless_command(const ViewCommand& command) {
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

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

void check_memory(const Scene& scene) {
#ifdef TYNDALL_WINDOW
  const std::filesystem::path file = preferences_file();
  check_memory({scene.width, scene.height, has_lights(scene), read_preferences(file).value_or(Preferences{}).clean},
               free_memory(), "write \"clean off\" into " + file.string());
#else
  check_memory(WindowPlan{scene.width, scene.height, has_lights(scene)}, free_memory(), "");
#endif
}

}  // namespace

int run(const ViewCommand& command) {
  const auto open = [request = command.scene] { return open_scene(request); };
  // Without the values of --set: edits begin with these, and may have changed them since.
  const auto read_edits = [request = command.scene](const std::string& what) mutable {
    request.what = what;
    request.overrides.clear();
    request.program.allowed = false;
    return open_scene(request);
  };
  const LoadedScene loaded = open();
  find_kernels(command.isa);
  check_memory(loaded.scene);
  std::vector<std::filesystem::path> inputs = loaded.files;
  if (!command.reference.empty()) inputs.push_back(picture_name(command.reference).file);
  check_outputs({{"--ui-log", command.ui_log}}, inputs);
  const std::string instead = "; the same picture without a window: " + headless_command(command);
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) throw IoError("no display for a window" + instead);
#ifdef TYNDALL_WINDOW
  tell_alpha(loaded);
  try {
    const auto& arguments = command.arguments;
    const bool named = std::find(arguments.begin(), arguments.end(), command.scene.what) != arguments.end();
    return run_window({loaded,
                       open,
                       read_edits,
                       command.threads,
                       command.isa,
                       command.reference,
                       command.ui_log,
                       named,
                       {command.time_limit, command.target_error}});
  } catch (const IoError& error) {
    throw IoError(error.what() + instead);
  }
#else
  throw IoError("this build has no window" + instead);
#endif
}

}  // namespace tyndall
