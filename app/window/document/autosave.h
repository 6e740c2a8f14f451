#pragma once
#include "app/window/document/document.h"
#include "app/window/document/job_queue.h"
#include "core/scene/load.h"
#include "core/system/locks.h"
#include "core/system/open_file.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Edits that were not saved, kept in a file until they are, so that neither a crash nor a lost display takes them
/// away. Where that cannot be done, it is known at once, and why. And the files themselves: each window has one of its
/// own, by a lock.
namespace tyndall {

/// A folder in which windows keep edits, and how their files are called there.
struct KeepingPlace {
  std::filesystem::path folder;
  std::string before, after;      ///< of the number in a name: "unsaved-" and ".json"
  bool beside_the_scene = false;  ///< in a folder of the user's, where no lock is to stay behind

  std::filesystem::path file(int number) const { return folder / (before + std::to_string(number) + after); }
  std::filesystem::path lock(int number) const { return folder / (before + std::to_string(number) + ".lock"); }
  bool operator==(const KeepingPlace&) const = default;
};

/// Where edits of a scene are kept, best first: in the state folder, unless its name is empty; then beside the scene's
/// file or image, in .NAME.unsaved-1. what: Origin::what; scenes that are built in or came by standard input have no
/// place of their own.
std::vector<KeepingPlace> keeping_places(const std::filesystem::path& state, const std::string& what);

/// A file of a place, and its lock while this lives. The lock ends with the program, however that ends.
class KeptSlot {
 public:
  KeptSlot() = default;
  /// Takes the lock if nobody has it.
  KeptSlot(KeepingPlace place, int number);

  bool held() const { return static_cast<bool>(lock_); }
  /// Why it is not held: an error number; 0: another window has it.
  int error() const { return error_; }
  /// Whether its file is there.
  bool used() const;
  const KeepingPlace& place() const { return place_; }
  std::filesystem::path file() const { return place_.file(number_); }

 private:
  KeepingPlace place_;
  int number_ = 0;
  std::unique_ptr<OpenFile, std::function<void(OpenFile*)>> lock_;  ///< null: none
  int error_ = 0;
};

/// A slot of that place that nobody has and that holds nothing. Throws IoError, which says why there is none.
KeptSlot free_slot(const KeepingPlace& place);

/// Calls see(slot) for each file of the place that nobody has; its lock is free again when the slot goes.
void for_free_files(const KeepingPlace& place, const std::function<void(KeptSlot&&)>& see);

/// All files of the place, those of open windows, too.
std::vector<std::filesystem::path> kept_files(const KeepingPlace& place);

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
/// a thread of its own, which tries again every few seconds while it cannot, and which the destructor waits for.
class Autosave {
 public:
  /// folder: see state_folder(); empty: there is none. on_change: called from the thread that writes when keeping() has
  /// changed; may be empty.
  explicit Autosave(std::filesystem::path folder, std::function<void()> on_change = {});

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
  /// Waits until what was handed to keep() is in the file, or was tried to be written once more. From any thread.
  void flush();
  /// What has become of what was handed to keep(). From any thread.
  Keeping keeping() const;
  /// What becomes of the edits when the program ends now, a sentence; "": there are none. After flush(). From any
  /// thread.
  std::string last_words() const;

 private:
  Keeping write(const Scene* edits, const Origin* of);
  Keeping remove();
  void write_at(const KeepingPlace& place, const Scene& edits, const Origin& of);

  std::filesystem::path folder_;
  mutable Mutex file_mutex_;  ///< guards the file and its slot; taken before the other one
  KeptSlot slot_;

  mutable Mutex mutex_;  ///< guards what follows
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const Origin> origin_;
  bool used_ = false;   ///< something was kept, or taken over
  bool waits_ = false;  ///< the file does not hold the scene yet
  Keeping keeping_;
  bool holds_older_ = false;  ///< where edits are lost: the file holds some that were made before
  BackgroundThread writing_;  // declared last, because it uses the others
};

}  // namespace tyndall
