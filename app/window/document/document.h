#pragma once
#include "app/report/contents.h"
#include "core/film/film.h"
#include "core/scene/load.h"
#include "core/scene/scene.h"
#include "core/scene/slots.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A scene under edit, the file that it came from, and how the window names an object of it; from scene files to
/// documents, and back; and the film of a snapshot that is opened again: its picture goes on from where it was.
namespace tyndall {

/// Where a scene came from. Never changes once it is shared by documents.
struct Origin {
  std::string title;             ///< shown: "cornell.json", "showroom"
  std::string what;              ///< what load_scene takes to open it again; "": standard input, which is gone
  std::filesystem::path file;    ///< what Ctrl+S writes; empty: Ctrl+S asks for a name
  std::filesystem::path folder;  ///< relative texture files are relative to it
  std::uint64_t text_hash = 0;   ///< fnv1a() of what the file held when it was read or written last; 0: not known
  bool comments = false;         ///< the file has comments, which saving would lose
  bool is_picture = false;       ///< there is no scene, but a picture that is shown in its place
  Scene saved;                   ///< what the file holds
  std::vector<std::filesystem::path> sources;  ///< of the program that wrote the scene, which saving never replaces
};

/// A scene that is being edited. What undo goes back to includes where it came from: opening a scene is an edit too.
struct Document {
  Scene scene;
  std::shared_ptr<const Origin> origin;
  bool operator==(const Document&) const = default;
};

/// Whether the scene differs from what its file holds.
inline bool edited(const Document& document) { return !(document.scene == document.origin->saved); }

using ObjectPaths = std::vector<ObjectPath>;

Object* find_object(Scene& scene, const ObjectPath& path);

/// Where objects of a scene are in another state of it: those that are equal, else those of the same name, else those
/// that stand at the same place. Objects that are gone are left out.
ObjectPaths paths_after(const Scene& before, const Scene& after, const ObjectPaths& paths);

/// Lets the keys of objects follow them where an edit has moved them in their lists; what has no place any more loses
/// its keys.
void move_keys(const Scene& before, Scene& after);

/// The scene within one drawing of the window: the document's own until something of it is changed, then a copy, which
/// becomes the document's and is the only one that the edit takes.
class EditedScene {
 public:
  explicit EditedScene(std::shared_ptr<const Scene> scene = std::make_shared<const Scene>())
      : shown_(std::move(scene)) {}

  const Scene& operator*() const { return changed_ ? *changed_ : *shown_; }
  const Scene* operator->() const { return &**this; }
  bool is_changed() const { return changed_.has_value(); }

  /// For any change. What was read before, by the operators above, stays as it was.
  Scene& change() { return changed_ ? *changed_ : changed_.emplace(*shown_); }
  /// The changed scene, if it was changed. Here it is as it was shown, then.
  std::optional<Scene> take() { return std::exchange(changed_, std::nullopt); }
  /// Shows the document's scene of now. The ones before stay in memory, as parts of them may be in use.
  void show(std::shared_ptr<const Scene> now) {
    before_.push_back(std::exchange(shown_, std::move(now)));
    changed_.reset();
  }

 private:
  std::shared_ptr<const Scene> shown_;
  std::vector<std::shared_ptr<const Scene>> before_;
  std::optional<Scene> changed_;
};

/// A loaded scene as a document without edits.
Document document_of(const LoadedScene& loaded);

/// Whether a scene file's text has comments, // or /* */.
bool has_comments(std::string_view text);

/// Writes the document's scene to a file and returns where it comes from now. Image textures are respelt for the new
/// place. Throws ImageFileError or IoError: one line.
std::shared_ptr<const Origin> save_document(const Document& document, const std::filesystem::path& file);

/// Whether the file holds something else than when it was read or written last, readable or not. Reads it.
bool file_differs(const Origin& origin);

/// The files that the document shows, to be watched: its scene file or the program's source files, if that is where it
/// came from, and its textures.
/// None of standard input, which cannot be read again.
std::vector<std::filesystem::path> watched_files(const Document& document);

/// "showroom" of "showroom.json" or "showroom-003.png": what snapshots and copies are named after.
std::string stem_of(const std::string& title);

/// What the window calls a file: its name, as one line.
std::string title_of(const std::filesystem::path& file);

struct OpenedFilm {
  std::shared_ptr<Film> film;  ///< null: the picture starts over, or it is no snapshot
  std::string remark;          ///< what the user is told of it; "": nothing
};

/// Reads the film of a scene that was loaded from an image. It is only of use if it is whole and its samples are those
/// that this program would take with these kernels, so that nobody can tell that the picture was ever closed; else the
/// word says what it lacks. isa: of the kernels; "": the best. Never throws.
OpenedFilm read_opened_film(const LoadedScene& loaded, const std::string& isa);

}  // namespace tyndall
