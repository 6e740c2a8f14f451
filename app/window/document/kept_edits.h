#pragma once
#include "app/window/document/document.h"
#include "core/scene/load.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Edits that were not saved, kept in a file until they are: neither a crash nor a lost display takes them away.
namespace tyndall {

/// $XDG_STATE_HOME/tyndall, else ~/.local/state/tyndall; empty where neither variable is set.
std::filesystem::path state_folder();

/// A scene file with an edited scene. Its first lines, comments, say what it is an edit of, and of which text. folder:
/// where the file will be; the paths of textures are spelt for it.
std::string kept_text(const Scene& scene, const Origin& origin, const std::filesystem::path& folder);
struct Kept {
  Document document;
  bool file_changed = false;  ///< the file of the scene has been given another text since the edits were made
};
/// What is in such a file, which read() reads as load_scene() does. Where the scene that was edited cannot be read any
/// more, all of it counts as edited. Throws SceneError if the file is broken, IoError if it cannot be read.
Kept read_kept(const std::filesystem::path& file, const std::function<LoadedScene(const std::string& what)>& read);
/// What the file says it is an edit of: Origin::what. Empty if it says nothing.
std::string kept_what(const std::filesystem::path& file);

/// The file of one window. Each window that is open has its own, by a lock that ends with the program, however that
/// ends; so a file whose lock is free belongs to nobody and holds edits that were not saved. For the main thread; the
/// file is written on a thread of its own.
class KeptEdits {
 public:
  /// folder: see state_folder(); empty: nothing is kept.
  explicit KeptEdits(std::filesystem::path folder);
  /// Writes what is still to be written.
  ~KeptEdits();
  KeptEdits(const KeptEdits&) = delete;
  KeptEdits& operator=(const KeptEdits&) = delete;

  /// Takes over the newest file that nobody has: of the scene `what`, or, if that is empty, of any. From then on the
  /// file is this window's. Returns its path; empty: there is none. Without this, or if there is none, the window takes
  /// a new file when there is something to keep.
  std::filesystem::path take_over(const std::string& what);
  /// Gives the file that was taken over back as it is.
  void leave();
  /// What the other files that nobody has are edits of (Origin::what), each once.
  std::vector<std::string> others() const;

  /// The edits that are to be kept from now on: the scene, and where it came from; null: none, the file is removed.
  /// Written at once, or a quarter of a second after the last time.
  void keep(std::shared_ptr<const Scene> scene, std::shared_ptr<const Origin> origin);
  /// Waits until what was handed to keep() is in the file. From any thread but the one that writes.
  void flush();
  /// What went wrong when the file was written last; empty: nothing. From any thread.
  std::string problem() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall
