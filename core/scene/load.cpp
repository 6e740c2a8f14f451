#include "core/scene/load.h"

#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/scene/frames.h"
#include "core/scene/json_read.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/system/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <system_error>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr const char* expected_scene =
    "a scene file, an image that Tyndall wrote, or the name of a built-in scene (\"tyndall scenes\" lists them)";

constexpr std::size_t block = std::size_t(1) << 16;

/// All bytes of a file or pipe, but not much more than `maximum`: then it is refused anyway.
std::string read_all(std::FILE* file, const std::string& name, std::size_t maximum = max_scene_bytes) {
  std::string text;
  std::error_code ignored;  // what has no size, such as a pipe, is read all the same
  const std::uintmax_t size = fs::file_size(name, ignored);
  if (!ignored && size <= maximum) text.reserve(static_cast<std::size_t>(size) + block);
  std::size_t got = 1;
  while (got > 0 && text.size() <= maximum) {
    const std::size_t old = text.size();
    text.resize(old + block);
    got = std::fread(text.data() + old, 1, text.size() - old, file);
    text.resize(old + got);
  }
  if (std::ferror(file)) throw SceneError(name, "something that cannot be read", expected_scene);
  return text;
}

std::string read_file(const std::string& name, std::size_t maximum = max_scene_bytes) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_stream(name, "rb"), &std::fclose);
  if (!file)
    throw SceneError(name, std::string("a file that cannot be read (") + std::strerror(errno) + ")", expected_scene);
  return read_all(file.get(), name, maximum);
}

bool is_image(std::string_view bytes) {
  return image_kind(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())) != ImageKind::unknown;
}

std::string scene_in_image(const std::string& name) {
  std::optional<std::string> scene;
  try {
    scene = read_embedded_scene(name);
  } catch (const ImageFileError& why) {
    throw SceneError(name, std::string("an image that cannot be read (") + why.what() + ")", expected_scene);
  }
  if (!scene) throw SceneError(name, "an image without a scene in it", "a PNG or EXR that Tyndall wrote");
  return *scene;
}

std::map<std::string, fs::path> built_in_files() {
  std::map<std::string, fs::path> files;
  const fs::path assets = assets_folder();
  if (assets.empty()) return files;
  for (const std::string& name : names_in_folder(assets / "scenes"))
    if (const fs::path file = assets / "scenes" / name; file.extension() == ".json") files[file.stem().string()] = file;
  return files;
}

[[noreturn]] void fail_missing(const std::string& what) {
  std::vector<std::string_view> names;
  const auto files = built_in_files();
  for (const auto& built_in : files) names.push_back(built_in.first);
  std::string hint = did_you_mean(what, names);
  if (names.empty()) hint = "; no built-in scenes were found (TYNDALL_ASSETS names their folder)";
  throw SceneError(what, "no such file", expected_scene + hint);
}

/// The scene's name; "" if it has none. A broken file is reported when it is opened, not here.
std::string name_of(const std::string& text) {
  try {
    const JsonDocument json = parse_json(text);
    return printable(text_of(find(&json.root, "name")));
  } catch (const ParseError&) {
    return "";
  }
}

/// Absolute, and without symbolic links as far as the file is there.
fs::path whole_path(const fs::path& path) {
  std::error_code error;
  return fs::weakly_canonical(fs::absolute(path, error), error);
}

/// Reads the scene from the text, which is there.
void read_text_of(LoadedScene& loaded, const std::vector<Override>& overrides) {
  loaded.scene = read_scene(loaded.text, loaded.name, loaded.folder, overrides);
  each_picture(loaded.scene,
               [&](const auto& picture) { loaded.files.push_back(picture_name(loaded.folder / picture.file).file); });
}

}  // namespace

fs::path assets_folder() {
  if (const char* chosen = std::getenv("TYNDALL_ASSETS"); chosen && *chosen) return chosen;
  std::error_code error;
  const fs::path folder = own_file().parent_path(), above = folder.parent_path();
  const fs::path shared = fs::path("share") / "tyndall";
  // A library may lie in lib/x86_64-linux-gnu.
  for (const fs::path& assets : {above / shared, above.parent_path() / shared, folder / "assets"})
    if (fs::is_directory(assets / "scenes", error)) return assets;
  return {};
}

std::vector<BuiltIn> built_in_scenes() {
  std::vector<BuiltIn> scenes;
  for (const auto& [name, path] : built_in_files()) {
    const std::string text = read_file(path.string());
    const std::vector<std::string> comments = leading_comments(text);
    BuiltIn& scene = scenes.emplace_back(BuiltIn{name, name_of(text), "", path});
    for (const std::string& line : comments) scene.about += (scene.about.empty() ? "" : " ") + line;
    if (scene.title.empty() && !comments.empty()) scene.title = comments[0];
  }
  return scenes;
}

Scene read_scene(std::string_view text, const std::string& name, const fs::path& folder,
                 const std::vector<Override>& overrides) {
  try {
    JsonDocument document = parse_json(text);
    for (const Override& one : overrides) apply_override(document.root, one), fit_to_type(document.root, one);
    Scene scene = scene_with_files(document.root, folder);
    check_keys(scene);
    return scene;
  } catch (const ParseError& error) {
    throw SceneError(name, error.where, error.found, error.expected);
  }
}

SkyPicture sky_of_file(const fs::path& file, const fs::path& folder) {
  const fs::path whole = whole_path(file), below = whole.lexically_relative(whole_path(folder));
  const bool inside = !below.empty() && *below.begin() != "..";
  const Place top, background{top, "background"};
  SkyPicture sky;
  sky.file = (inside ? below : whole).generic_string();
  try {
    sky.pixels = read_sky_pixels(sky.file, folder, {background, "file"});
  } catch (const ParseError& wrong) {
    throw SceneError(file.string(), wrong.where, wrong.found, wrong.expected);
  }
  return sky;
}

LoadedScene load_scene(const std::string& what, const std::vector<Override>& overrides) {
  LoadedScene loaded;
  loaded.name = what;
  if (what == "-") {
    loaded.name = "standard input";
    loaded.folder = ".";
    loaded.text = read_all(stdin, loaded.name);
    if (is_image(loaded.text)) throw SceneError(loaded.name, "a picture", "a scene; 'tyndall view -' shows a P3 or P6");
  } else if (const auto files = built_in_files(); files.contains(what)) {
    loaded.files = {files.at(what)};
    loaded.folder = files.at(what).parent_path();
    loaded.text = read_file(files.at(what).string());
  } else {
    std::error_code error;
    const fs::file_status status = fs::status(what, error);
    if (status.type() == fs::file_type::not_found) fail_missing(what);
    if (fs::is_directory(status)) throw SceneError(what, "a folder", expected_scene);
    loaded.folder = fs::path(what).has_parent_path() ? fs::path(what).parent_path() : fs::path(".");
    // Of an image, which may be large, only the header is read. A pipe can be read only once.
    const bool image = fs::is_regular_file(status) && is_image(read_file(what, kind_size));
    loaded.text = image ? scene_in_image(what) : read_file(what);
    if (!image && is_image(loaded.text)) loaded.text = scene_in_image(what);
    if (image) loaded.contents = read_embedded_contents(what).value_or("");
    if (!image) loaded.source = what;
    loaded.files = {what};
  }
  read_text_of(loaded, overrides);
  return loaded;
}

LoadedScene load_scene_text(const std::string& text, const std::string& name, const fs::path& folder,
                            const std::vector<Override>& overrides) {
  LoadedScene loaded;
  loaded.name = name;
  loaded.folder = folder;
  loaded.text = text;
  read_text_of(loaded, overrides);
  return loaded;
}

std::vector<fs::path> files_of_scene(const fs::path& file) {
  std::vector<fs::path> files{file};
  try {
    const JsonDocument json = parse_json(read_file(file.string()));
    const auto add = [&](const JsonValue* picture) {
      if (const std::string name = text_of(find(picture, "file")); !name.empty())
        files.push_back(picture_name(file.parent_path() / name).file);
    };
    const JsonValue* named = find(&json.root, "textures");
    if (const auto* textures = named ? std::get_if<JsonObject>(&named->value) : nullptr)
      for (const JsonMember& texture : *textures) add(&texture.value);
    add(find(&json.root, "background"));
  } catch (const SceneError&) {  // it cannot be read
  } catch (const ParseError&) {  // it is not JSON
  }
  return files;
}

std::vector<std::string> texture_remarks(const Scene& scene) {
  std::vector<std::string> remarks;
  each_picture(scene, [&](const auto& picture) {
    if (!picture.pixels) return;
    for (const std::string& remark : picture.pixels->remarks)
      if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) remarks.push_back(remark);
  });
  return remarks;
}

std::string contents_hash(const Scene& scene) {
  Checksum sum;
  bool any = false;
  each_picture(scene, [&](const auto& picture) {
    if (!picture.pixels) return;
    any = true;
    sum.add_number(picture.pixels->width);
    sum.add_number(picture.pixels->height);
    sum.add(picture.pixels->rgb.data(), picture.pixels->rgb.size() * sizeof(float));
  });
  return any ? hash_text(sum.value()) : "";
}

std::string contents_remark(const LoadedScene& loaded) {
  if (!loaded.contents) return "";
  const std::string now = contents_hash(loaded.scene);
  if (now.empty() || now == *loaded.contents) return "";
  return loaded.name +
         (loaded.contents->empty() ? ": does not say which pixels its textures and sky had"
                                   : ": its textures or sky have other pixels now than when the picture was made") +
         "; those of now are taken";
}

Scene move_textures(Scene scene, const fs::path& from, const fs::path& to) {
  const fs::path target = whole_path(to);
  if (target == whole_path(from)) return scene;
  each_picture(scene, [&](auto& picture) {
    if (fs::path(picture.file).is_absolute()) return;
    const fs::path file = whole_path(from / picture.file);
    const fs::path relative = file.lexically_relative(target);
    const std::string text = (relative.empty() ? file : relative).generic_string();
    picture.file = is_utf8(text) ? text : all_printable(text);
  });
  return scene;
}

}  // namespace tyndall
