#include "core/scene/json_read.h"

#include "core/image/image_io.h"
#include "core/scene/check.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

constexpr int format_version = 1;

void read_version(const JsonObject& root, const Place& at) {
  const JsonValue& json = member_at(root, at, "tyndall", "\"tyndall\": 1 (the version of the scene format)");
  const auto* version = std::get_if<double>(&json.value);
  if (!version || *version != format_version)
    fail({at, "tyndall"}, describe(json), "1 (the version of the scene format that this program reads)");
}

void read_camera(const JsonValue& json, const Place& at, Camera& camera) {
  const JsonObject& object = read_as<JsonObject>(json, at, "an object with the camera's values");
  read_fields(object, at, fields_of<Camera>(), {"shutter"}, camera);
  const JsonValue* shutter = find(object, "shutter");
  if (!shutter) return;
  const Place here{at, "shutter"};
  const char* expected = "an array of 2 numbers (times at which the shutter opens and closes)";
  const JsonArray& array = read_as<JsonArray>(*shutter, here, expected);
  if (array.size() != 2) fail(here, describe(*shutter), expected);
  const Meaning time{any_number(), "", "time; things that move do so from 0 to 1"};
  read_value(array[0], {here, std::size_t{0}}, time, camera.shutter_open);
  read_value(array[1], {here, std::size_t{1}}, time, camera.shutter_close);
}

/// Refuses a sky with a pixel that is no radiance.
void check_sky(const LinearImage& image, const std::string& file, const Place& at) {
  const auto wrong = std::find_if_not(image.rgb.begin(), image.rgb.end(),
                                      [](float value) { return value >= 0 && std::isfinite(value); });
  if (wrong == image.rgb.end()) return;
  const auto pixel = static_cast<int>((wrong - image.rgb.begin()) / 3);
  fail(at,
       number_text(static_cast<double>(*wrong)) + " in pixel (" + std::to_string(pixel % image.width) + ", " +
           std::to_string(pixel / image.width) + ") of " + in_quotes(file),
       "radiance of the whole sky, finite and >= 0");
}

/// Loads each picture once, however many textures use it.
class PictureShelf {
 public:
  explicit PictureShelf(const std::filesystem::path& folder) : folder_(folder) {}
  /// Has the pictures of a scene.
  explicit PictureShelf(const Scene& scene) {
    each_picture(scene, [&]<class Picture>(const Picture& picture) {
      shelf_[{picture.file, std::is_same_v<Picture, SkyPicture>}] = picture.pixels;
    });
  }

  /// The picture of a texture or, with is_sky, of a sky.
  std::shared_ptr<const Image::Pixels> get(const std::string& file, const Place& at, bool is_sky) {
    const std::filesystem::path path = folder_ / file;
    auto& pixels = shelf_[{path, is_sky}];
    if (pixels) return pixels;
    std::error_code error;
    const PictureName named = picture_name(path);
    const bool exists = file.find('\0') == file.npos && std::filesystem::exists(named.file, error);
    if (!exists) fail(at, "no file " + in_quotes(path.string()), "an image, relative to the scene file");
    if (named.layer && !is_sky)
      fail(at, "layer " + in_quotes(*named.layer) + " of " + in_quotes(named.file.string()),
           "an image of 8 or 16 bits, such as PNG or JPEG, which has no layers");
    if (!std::filesystem::is_regular_file(named.file, error))
      fail(at, in_quotes(path.string()) + ", which is no file", "an image");
    try {
      PictureFile read = is_sky ? read_sky(path) : tyndall::read_texture(path);
      LinearImage& image = read.image;
      if (is_sky) check_sky(image, file, at);
      const float largest = is_sky ? *std::max_element(image.rgb.begin(), image.rgb.end()) : 1.0f;
      pixels = std::make_shared<const Image::Pixels>(Image::Pixels{image.width, image.height, std::move(image.rgb),
                                                                   read.has_alpha, std::move(read.remarks), largest});
    } catch (const ImageFileError& why) {
      fail(at, "a file that cannot be read (" + std::string(why.what()) + ")",
           is_sky ? "a picture of the sky in floating point (HDR, EXR or PFM)"
                  : "an image of 8 or 16 bits, such as PNG or JPEG");
    }
    return pixels;
  }

 private:
  std::filesystem::path folder_;
  std::map<std::pair<std::filesystem::path, bool>, std::shared_ptr<const Image::Pixels>> shelf_;
};

/// Reads a texture or sky of any kind, and the file of one that is a picture.
template <class Kinds>
void read_texture_or_sky(const JsonObject& object, const Place& at, PictureShelf& shelf, Kinds& out) {
  read_kind(object, at, out, [&]<class Kind>(Kind& kind) {
    if constexpr (std::is_same_v<Kind, Image>)
      allow_keys(object, at, {"type", "file"});
    else if constexpr (std::is_same_v<Kind, SkyPicture>)
      read_fields(object, at, fields_of<Kind>(), {"type", "file"}, kind);
    else
      read_fields(object, at, fields_of<Kind>(), {"type"}, kind);
    if constexpr (requires { kind.file; }) {
      const std::string expected = "the path of an image, relative to the scene file";
      kind.file = read_as<std::string>(member_at(object, at, "file", expected), {at, "file"}, expected);
      if (kind.file.empty()) fail({at, "file"}, "\"\"", expected);
      kind.pixels = shelf.get(kind.file, {at, "file"}, std::is_same_v<Kind, SkyPicture>);
    }
  });
}

/// The kinds of background but the plain colour.
template <class... Kinds>
std::variant<Kinds...> without_colour(const std::variant<Vec3d, Kinds...>*);
using Sky = decltype(without_colour(static_cast<const Background*>(nullptr)));

void read_background(const JsonValue& json, const Place& at, PictureShelf& shelf, Background& background) {
  if (const auto* object = std::get_if<JsonObject>(&json.value)) {
    Sky sky;
    read_texture_or_sky(*object, at, shelf, sky);
    std::visit([&](const auto& kind) { background = kind; }, sky);
  } else if (std::holds_alternative<JsonArray>(json.value)) {
    read_value(json, at, colour_meaning("radiance"), background.emplace<Vec3d>());
  } else {
    fail(at, describe(json),
         "an array of 3 numbers (radiance, linear RGB) or an object of type \"gradient\", \"hemispheres\" or "
         "\"image\"");
  }
}

void read_material(const JsonValue& json, const Place& at, const NameTable& textures, Material& material) {
  const JsonObject& object = read_as<JsonObject>(json, at, "an object that describes a material");
  read_kind(object, at, material.kind, [&]<class T>(T& kind) {
    if constexpr (T::colour_name != nullptr) {
      allow_keys(object, at, fields_of<T>(), {"type", T::colour_name});
      material.colour = read_colour(object, at, T::colour_name, textures);
    } else {
      allow_keys(object, at, fields_of<T>(), {"type"});
    }
    read_fields(object, at, fields_of<T>(), kind);
  });
}

int read_frame(const std::string& text, const Place& at) {
  int frame = -1;
  std::from_chars(text.data(), text.data() + text.size(), frame);
  if (frame < 0 || text != std::to_string(frame))
    fail({at, text}, in_quotes(text), "a frame: a whole number from 0 on, as text");
  return frame;
}

std::vector<double> read_numbers(const JsonValue& json, const Place& at) {
  constexpr const char* expected = "a number or an array of numbers";
  if (const auto* number = std::get_if<double>(&json.value)) return {*number};
  std::vector<double> numbers;
  for (const JsonValue& item : read_as<JsonArray>(json, at, expected))
    numbers.push_back(read_as<double>(item, {at, numbers.size()}, "a number"));
  if (numbers.size() < 2) fail(at, describe(json), expected);
  return numbers;
}

KeyedValue read_keyed_value(const JsonMember& member, const Place& at) {
  const auto steps = pointer_steps(member.key);
  if (!steps) fail(at, in_quotes(member.key), "a JSON pointer to a value of the scene, such as /camera/vfov");
  const std::string& part = steps->front();  // all frames of a film have one size
  if (part == "tyndall" || part == "name" || part == "image" || part == "animation")
    fail(at, in_quotes(member.key), "a value of the camera, a material, an object, …");
  KeyedValue keyed{member.key, {}};
  const JsonObject& keys =
      read_as<JsonObject>(member.value, at, "an object of values by frame, such as { \"0\": 1, \"47\": 2 }");
  for (const JsonMember& key : keys)
    keyed.keys.push_back({read_frame(key.key, at), read_numbers(key.value, {at, key.key})});
  std::sort(keyed.keys.begin(), keyed.keys.end(),
            [](const KeyFrame& a, const KeyFrame& b) { return a.frame < b.frame; });
  return keyed;
}

Animation read_animation(const JsonValue& json, const Place& at) {
  Animation animation;
  const JsonObject& object = read_as<JsonObject>(json, at, "an object with \"frames\" and \"keys\"");
  read_fields(object, at, fields_of<Animation>(), {"keys"}, animation);
  const JsonValue* keys = find(object, "keys");
  if (!keys) return animation;
  const Place here{at, "keys"};
  for (const JsonMember& member : read_as<JsonObject>(*keys, here, "an object of keys by JSON pointer"))
    animation.keyed.push_back(read_keyed_value(member, {here, member.key}));
  return animation;
}

/// Reads each member of an object of named things into `out` with `read(json, place, thing)`; returns their indices.
template <class T, class Read>
NameTable read_named(const JsonObject& root, const Place& at, const char* key, const char* expected,
                     std::vector<T>& out, const Read& read) {
  NameTable table;
  const JsonValue* json = find(root, key);
  if (!json) return table;
  const Place here{at, key};
  const JsonObject& object = read_as<JsonObject>(*json, here, expected);
  out.reserve(object.size());
  for (const JsonMember& member : object) {
    table.emplace(member.key, static_cast<int>(out.size()));
    out.emplace_back().name = member.key;
    read(member.value, Place{here, member.key}, out.back());
  }
  return table;
}

Scene scene_from(const JsonValue& json, PictureShelf shelf) {
  const Place at;
  const JsonObject& root = read_as<JsonObject>(json, at, "a scene: { \"tyndall\": 1, … }");
  read_version(root, at);
  allow_keys(root, at,
             {"tyndall", "name", "image", "camera", "background", "render", "display", "animation", "textures",
              "materials", "objects"});
  Scene scene;
  const auto part = [&](const char* key, const char* expected, const auto& list, auto& out) {
    const Place here{at, key};
    if (const JsonValue* value = find(root, key))
      read_fields(read_as<JsonObject>(*value, here, expected), here, list, {}, out);
  };
  if (const JsonValue* name = find(root, "name"))
    scene.name = read_as<std::string>(*name, {at, "name"}, "a text (the scene's name)");
  part("image", "an object with \"width\" and \"height\"", image_fields(), scene);
  if (const JsonValue* camera = find(root, "camera")) read_camera(*camera, {at, "camera"}, scene.camera);
  if (const JsonValue* background = find(root, "background"))
    read_background(*background, {at, "background"}, shelf, scene.background);
  part("render", "an object with the render settings", fields_of<RenderSettings>(), scene.render);
  part("display", "an object with the display settings", fields_of<Display>(), scene.display);
  if (const JsonValue* animation = find(root, "animation"))
    scene.animation = read_animation(*animation, {at, "animation"});
  NameTables references;
  references.textures =
      read_named(root, at, "textures", "an object of textures by name", scene.textures,
                 [&](const JsonValue& value, const Place& here, Texture& texture) {
                   read_texture_or_sky(read_as<JsonObject>(value, here, "an object that describes a texture"), here,
                                       shelf, texture.kind);
                 });
  references.materials = read_named(root, at, "materials", "an object of materials by name", scene.materials,
                                    [&](const auto& value, const Place& here, Material& material) {
                                      read_material(value, here, references.textures, material);
                                    });
  if (const JsonValue* objects = find(root, "objects"))
    scene.objects = read_objects(*objects, {at, "objects"}, references);
  return scene;
}

}  // namespace

std::shared_ptr<const Image::Pixels> read_sky_pixels(const std::string& file, const std::filesystem::path& folder,
                                                     const Place& at) {
  return PictureShelf(folder).get(file, at, true);
}

Scene scene_with_files(const JsonValue& root, const std::filesystem::path& folder) {
  return checked(scene_from(root, PictureShelf(folder)));
}

Scene scene_with_pictures(const JsonValue& root, const Scene& pictures) {
  return scene_from(root, PictureShelf(pictures));
}

}  // namespace tyndall
