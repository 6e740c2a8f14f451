#pragma once
#include "app/files/arriving_picture.h"
#include "app/files/watched_function.h"
#include "core/scene/load.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

/// The window as the command line sees it: what it can be told, and the call that runs it.
namespace tyndall {

/// Where a picture pauses by itself. Space goes on.
struct PauseLimits {
  double seconds = std::numeric_limits<double>::infinity();  ///< of rendering
  double error = 0;                                          ///< estimated, relative; 0: none
};

struct WindowOptions {
  LoadedScene scene;
  /// Reads the scene again, as the command line asked for it, unless go_on says meanwhile that nobody waits for it any
  /// more; may be empty.
  std::function<LoadedScene(const std::function<bool()>& go_on)> reload;
  /// Reads kept edits: a scene file, with the settings that the command line gives.
  std::function<LoadedScene(const std::string&)> read_edits = [](const std::string& what) { return load_scene(what); };
  int threads = 0;                  ///< 0: see thread_count()
  std::string isa;                  ///< "": the best
  std::filesystem::path reference;  ///< image that errors are measured against; empty: none
  std::filesystem::path ui_log;     ///< diagnostic, see ui_log.h; empty: none, "-": standard output
  bool scene_named = true;  ///< the user named the scene; else edits of any scene that were not saved are restored
  PauseLimits limits{};
  /// A picture that is shown in the scene's place while it comes; `scene` then has its size and nothing else, and one
  /// sample a pixel. Null: the scene is rendered.
  std::shared_ptr<ArrivingPicture> picture{};
  /// A function whose samples are shown in the scene's place; `scene` then has the picture's size, and the settings
  /// that choose its samples. Null: none.
  std::shared_ptr<WatchedFunction> function{};
  std::optional<LoadedScene> reference_scene{};  ///< is rendered to be the reference; of the size of the picture
  /// The window belongs to a program of somebody else: it leaves alone what is of the whole process, such as signals
  /// and how memory is given back.
  bool hosted = false;
};

/// Opens the window and returns the exit code when it is closed. Throws IoError where there is no display (neither
/// DISPLAY nor WAYLAND_DISPLAY is set) or it cannot be used.
int run_window(const WindowOptions& options);

}  // namespace tyndall
