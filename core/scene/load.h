#pragma once
#include "core/base/error.h"
#include "core/scene/place.h"
#include "core/scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The scene file: JSON with comments. app/cli/README.md shows the format, assets/scene.schema.json describes it. And
/// the scene that a user names: a built-in one, a file, or an image with a scene in it.
namespace tyndall {

/// Reads and checks a scene. name: what errors call it (usually the file's name). folder: where relative texture files
/// are. Throws SceneError for everything that is wrong with it, also for textures that cannot be read, and for keys
/// that have no place in it.
Scene read_scene(std::string_view text, const std::string& name, const std::filesystem::path& folder,
                 const std::vector<Override>& overrides = {});

/// The sky of a picture file. folder: that of the scene, from which the file is named if it lies in it. Throws
/// SceneError.
SkyPicture sky_of_file(const std::filesystem::path& file, const std::filesystem::path& folder);

/// A valid scene in normal form: every value that is required or not its default, keys in the format's order. Reading
/// it gives an equal scene. Image files are written as they stand in the scene: see move_textures().
std::string write_scene(const Scene& scene);

/// Comment lines at the top of a scene file (without "//"), for `inspect`.
std::vector<std::string> leading_comments(std::string_view text);

struct LoadedScene {
  Scene scene;
  std::string name;              ///< what messages call it: the file as given, a built-in scene's name
  std::filesystem::path source;  ///< the scene file, to watch and to save to; empty for built-in scenes, images and
                                 ///< standard input
  std::filesystem::path folder;  ///< where the scene's relative texture files are
  std::string text;              ///< the scene file's text, before overrides
  std::vector<std::filesystem::path> files;    ///< all that was read: the scene's file or image, and its textures
  std::vector<std::filesystem::path> sources;  ///< of the program that wrote the scene; empty: none did
  /// Of a scene in an image: what contents_hash() was when the picture was made; "": the image does not say. Nothing
  /// for all other scenes.
  std::optional<std::string> contents{};
  bool is_picture = false;  ///< there is none, but a picture that is shown in its place; `scene` has its size alone
};

/// Loads a scene. what: the name of a built-in scene, a scene file, an image that Tyndall wrote (PNG or EXR), or "-"
/// for standard input. A name goes before a file of the same name: "./cover" is the file. Throws SceneError.
LoadedScene load_scene(const std::string& what, const std::vector<Override>& overrides = {});

/// Loads a scene from its text. name: what messages call it; folder: where its relative texture files are.
LoadedScene load_scene_text(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                            const std::vector<Override>& overrides = {});

/// What reading a scene file depends on: the file itself and the pictures that it names for textures and sky, whether
/// or not they are there and can be read. For those who wait until a broken one is mended.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& file);

/// What a user should know of how the pictures of the scene's textures and sky were read: a line each, each once.
std::vector<std::string> texture_remarks(const Scene& scene);

/// 16 hexadecimal digits that differ with the pixels of the scene's textures and sky, whatever their files are called
/// and however they are stored; "": it has none. Pictures and films carry it, as part of what they are made of.
std::string contents_hash(const Scene& scene);

/// One line if the textures or the sky of a scene in an image are not those that its picture was made with, or if that
/// is not known; "": they are.
std::string contents_remark(const LoadedScene& loaded);

struct BuiltIn {
  std::string name;   ///< what load_scene takes
  std::string title;  ///< the scene's own name, else its first comment
  std::string about;  ///< the comments at the top of its file, as one line of sentences; "": there are none
  std::filesystem::path path;
};

/// The scenes in the assets folder, by name. Empty if there is no such folder.
std::vector<BuiltIn> built_in_scenes();

/// The folder with scenes/ and textures/: $TYNDALL_ASSETS, else share/tyndall of the installation, else assets beside
/// the program, or beside the library that holds this code; empty if there is none.
std::filesystem::path assets_folder();

/// The scene with the relative files of its textures and sky respelt so that a scene file in folder `to` finds what one
/// in folder `from` found. Names of folders between the two that are not UTF-8, which JSON cannot hold, are written
/// printably: there it will be told that the texture is missing.
Scene move_textures(Scene scene, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tyndall
