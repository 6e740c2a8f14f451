#pragma once
#include "app/book/load_program.h"
#include "app/files/watched_function.h"
#include "app/text/values.h"
#include "core/scene/frames.h"
#include "core/scene/load.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"
#include "core/system/locks.h"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// This room reads and writes files: scenes as the user asks for them, pictures, films and figures.
namespace tyndall {

/// Settings that options change: their values, and which of them were given. The others stay as the scene has them.
template <class Settings>
struct Changes {
  Settings values;
  std::set<std::string_view> given;  ///< names of fields
};

/// Gives one setting, as an option does.
template <class Settings, class T>
void set(Changes<Settings>& changes, T Settings::*member, std::type_identity_t<T> value) {
  changes.values.*member = std::move(value);
  for_each_field(fields_of<Settings>(), [&]<class U>(const Field<Settings, U>& field) {
    if constexpr (std::is_same_v<T, U>)
      if (field.value == member) changes.given.insert(field.name);
  });
}

template <class Settings>
void apply(const Changes<Settings>& changes, Settings& settings) {
  for_each_field(fields_of<Settings>(), [&](const auto& field) {
    if (changes.given.contains(field.name)) settings.*field.value = changes.values.*field.value;
  });
}

/// What belongs to a program whose scene is wanted, see app/book.
/// Its sources are those beside the file with main(); without go_on, which a window has, it watches signals.
struct ProgramParts : ProgramTask {
  /// Whether a C++ source file may be compiled and run at all: only one that the user has named for that.
  bool allowed = false;
  bool told = false;  ///< what is to be told of it was told before
  /// Says why a scene is not what its program computes; "": it is. May be empty.
  std::function<std::string(const Scene&, const ProgramScene&)> differs;
};

/// A scene, and what options change in it.
struct SceneRequest {
  std::string what = "showroom";  ///< file, built-in name, image, C++ source file, or "-": standard input
  ProgramParts program;
  std::vector<Override> overrides;
  std::optional<Size> size;
  Changes<RenderSettings> render;
  Changes<Display> display;
};

/// The samples that a reader's program computes itself, where its world is no scene. In a window the program changes
/// when it is saved; the function stays. For any number of threads.
class OwnSamples {
 public:
  OwnSamples();
  /// program: null where there is a scene; reason: why there is none, a sentence with the program's name. Returns how
  /// many programs were taken.
  std::uint32_t take(std::shared_ptr<OwnProgram> program, const std::string& reason);
  std::string reason() const;
  /// What asks the program that was taken last.
  const std::shared_ptr<WatchedFunction>& function() const { return function_; }

 private:
  struct Held {
    Mutex mutex;
    std::shared_ptr<OwnProgram> program;
    std::string reason;
    std::uint32_t taken = 0;
    std::shared_ptr<OwnProgram> current() {
      const std::lock_guard lock(mutex);
      return program;
    }
  };
  std::shared_ptr<Held> held_ = std::make_shared<Held>();
  std::shared_ptr<WatchedFunction> function_;  ///< keeps what is held
};

/// Loads a scene, or what is shown in its place: a program whose world cannot be taken over. Then `own` says why, and
/// the scene has its picture's size and settings and nothing else; else `own` is emptied. See open_scene().
LoadedScene open_scene_or_samples(const SceneRequest& request, OwnSamples& own);

/// Loads a scene and applies the options to it: overrides before it is checked, the others after that, and checks
/// again. Tells on standard error how pictures of textures were read, where that should be known. Throws SceneError,
/// and UsageError for a program that has only samples of its own.
LoadedScene open_scene(const SceneRequest& request);

/// The scene that a request has opened, with further overrides after the request's own. name: what messages call it.
LoadedScene open_variant(const LoadedScene& opened, const SceneRequest& request, const std::vector<Override>& more,
                         const std::string& name);

/// The scene of a frame. Throws SceneError, which names the frame.
LoadedScene at_frame(LoadedScene loaded, const FramePlan& plan, int frame);

}  // namespace tyndall
