#pragma once
#include "app/window/document/document.h"
#include "core/scene/load.h"
#include "core/system/open_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Edits that were not saved, as the text of a file, and the files in which windows keep them: each window has one of
/// its own, by a lock.
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
  KeptSlot(KeptSlot&& other) noexcept = default;
  KeptSlot& operator=(KeptSlot&& other) noexcept;
  ~KeptSlot() { release(); }

  bool held() const { return static_cast<bool>(lock_); }
  /// Why it is not held: an error number; 0: another window has it.
  int error() const { return error_; }
  /// Whether its file is there.
  bool used() const;
  const KeepingPlace& place() const { return place_; }
  std::filesystem::path file() const { return place_.file(number_); }

 private:
  void take();
  void release();

  KeepingPlace place_;
  int number_ = 0;
  OpenFile lock_;
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

}  // namespace tyndall
