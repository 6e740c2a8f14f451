#pragma once
#include "app/report/contents.h"
#include "core/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

/// A scene under edit, the file that it came from, and how the window names an object of it.
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

}  // namespace tyndall
