#pragma once
#include "app/window/document/document.h"
#include "app/window/document/kept_edits.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Edits that were not saved, kept in a file until they are, so that neither a crash nor a lost display takes them
/// away. Where that cannot be done, it is known at once, and why.
namespace tyndall {

/// $XDG_STATE_HOME/tyndall, else ~/.local/state/tyndall; empty where neither variable is an absolute path.
std::filesystem::path state_folder();

/// What has become of the edits that were to be kept.
struct Keeping {
  enum class Kind {
    nothing,  ///< there are none to keep
    kept,     ///< in the state folder
    beside,   ///< beside the scene, because the state folder cannot be written
    lost      ///< nowhere
  };
  Kind kind = Kind::nothing;
  std::filesystem::path file;  ///< that holds them
  std::string why;             ///< why they are not in the state folder, or nowhere; or why none could be removed
  /// Whether the file does not hold what it should, so that it is worth trying again.
  bool failed() const { return kind == Kind::lost || (kind == Kind::nothing && !why.empty()); }
};

/// The file of one window. Each window that is open has its own, by a lock that ends with the program, however that
/// ends; so a file whose lock is free belongs to nobody and holds edits that were not saved. It is in the state folder,
/// or, where that cannot be written, beside the scene (see keeping_places). For the main thread; the file is written on
/// a thread of its own, which tries again every few seconds while it cannot.
class Autosave {
 public:
  /// folder: see state_folder(); empty: there is none. on_change: called from the thread that writes when keeping() has
  /// changed; may be empty.
  explicit Autosave(std::filesystem::path folder, std::function<void()> on_change = {});
  /// Writes what is still to be written.
  ~Autosave();

  /// Takes over the newest file that nobody has: of the scene `what`, in the state folder or beside the scene; or, if
  /// `what` is empty, of any in the state folder. From then on the file is this window's. Returns its path; empty:
  /// there is none. Without this, or if there is none, the window takes a new file when there is something to keep.
  std::filesystem::path take_over(const std::string& what);
  /// Gives the file that was taken over back as it is.
  void leave();
  /// What the other files of the state folder that nobody has are edits of (Origin::what), each once.
  std::vector<std::string> others() const;

  /// The edits that are to be kept from now on: the scene, and where it came from; null: none, the file is removed.
  /// Written at once, or a quarter of a second after the last time.
  void keep(std::shared_ptr<const Scene> scene, std::shared_ptr<const Origin> origin);
  /// Waits until what was handed to keep() is in the file, or was tried to be written once more. From any thread but
  /// the one that writes.
  void flush();
  /// What has become of what was handed to keep(). From any thread.
  Keeping keeping() const;
  /// What becomes of the edits when the program ends now, a sentence; "": there are none. After flush(). From any
  /// thread.
  std::string last_words() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tyndall
