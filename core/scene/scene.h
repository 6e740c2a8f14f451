#pragma once
#include "core/materials/materials.h"
#include "core/media/medium.h"
#include "core/scene/settings.h"
#include "core/shapes/shapes.h"
#include "core/textures/textures.h"

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What the user writes, edits, undoes and saves: plain values in double. An edit is a copy, undo a list of copies,
/// "nothing changed" is ==. References are indices, given in the file as names.
namespace tyndall {

/// Index into Scene::textures.
struct TextureIndex {
  int index = 0;
  bool operator==(const TextureIndex&) const = default;
};
/// Linear RGB, or the texture that gives it.
using ColourOrTexture = std::variant<Vec3d, TextureIndex>;

struct Material {
  std::string name;
  ColourOrTexture colour = Vec3d{0.5, 0.5, 0.5};  ///< albedo in [0, 1], or a light's radiance; unused by dielectrics
  MaterialKinds<double> kind;
  bool operator==(const Material&) const = default;
};

struct Texture {
  std::string name;
  TextureKinds<double> kind;
  bool operator==(const Texture&) const = default;
};

/// Turns about the y axis in the books' sense: x' = cos·x + sin·z, z' = -sin·x + cos·z. In degrees, as in the file.
struct RotateY {
  double degrees = 0;
  bool operator==(const RotateY&) const = default;
};
struct Translate {
  Vec3d offset;
  bool operator==(const Translate&) const = default;
};
inline constexpr auto fields(const RotateY*) {
  return std::tuple{
      Field{"rotate_y", &RotateY::degrees, any_number(), Slider{-180, 180}, "°", "turn about the y axis", true}
          .called("Turn")
          .also("rotate, rotation, rotate y, yaw")};
}
inline constexpr auto fields(const Translate*) {
  return std::tuple{
      Field{"translate", &Translate::offset, any_number(), no_slider(), "", "shift along x, y, z, scene units", true}
          .called("Move")
          .also("translation, offset, shift")};
}
/// Applied in the order of the list.
using Transform = std::vector<std::variant<RotateY, Translate>>;

/// A shape with a surface of some material.
struct Solid3d {
  std::variant<Sphere<>, Quad<>, Box<>, Triangle<>, Disk<>> shape;
  int material = 0;  ///< index into Scene::materials
  bool operator==(const Solid3d&) const = default;
};

/// A medium and what bounds it.
struct Volume {
  std::variant<Sphere<>, Box<>> boundary;  ///< sphere: radius > 0, at rest
  Transform boundary_transform;
  Medium<> medium;
  ColourOrTexture albedo = Vec3d{1, 1, 1};
  bool operator==(const Volume&) const = default;
};

struct Object;
struct Group {
  std::vector<Object> objects;
  bool operator==(const Group&) const;
};

struct Object {
  std::string name;  ///< may be empty
  std::variant<Solid3d, Volume, Group> kind;
  Transform transform;
  bool operator==(const Object&) const = default;
};
inline bool Group::operator==(const Group& other) const { return objects == other.objects; }

/// What a ray that escapes sees.
struct Gradient {
  static constexpr const char* type = "gradient";
  static constexpr const char* about =
      "(1 - a) * bottom + a * top, where a = (y + 1) / 2 of the unit direction: the books' sky.";
  Vec3d bottom{1, 1, 1}, top{0.5, 0.7, 1.0};
  bool operator==(const Gradient&) const = default;
};
inline constexpr auto fields(const Gradient*) {
  return std::tuple{
      Field{"bottom", &Gradient::bottom, at_least(0), Slider{0, 2}, "", "radiance straight below", true}.also(
          "horizon"),
      Field{"top", &Gradient::top, at_least(0), Slider{0, 2}, "", "radiance straight above", true}.also("zenith")};
}
struct Hemispheres {
  static constexpr const char* type = "hemispheres";
  static constexpr const char* about = "One radiance above the horizon (y > 0), another below.";
  Vec3d up{1, 1, 1}, down{0, 0, 0};
  bool operator==(const Hemispheres&) const = default;
};
inline constexpr auto fields(const Hemispheres*) {
  return std::tuple{
      Field{"up", &Hemispheres::up, at_least(0), Slider{0, 2}, "", "radiance where y > 0", true}.called("Above").also(
          "sky above"),
      Field{"down", &Hemispheres::down, at_least(0), Slider{0, 2}, "", "radiance where y <= 0", true}
          .called("Below")
          .also("ground color, ground colour")};
}
/// A picture of the whole sky by longitude (across) and latitude (down), infinitely far away. As seen from within: the
/// middle of the picture lies towards -z, the middle of its right half towards +x, its first row around +y. Integrators
/// nee and mis sample it as a light (core/trace/sky.h).
struct SkyPicture {
  static constexpr const char* type = "image";
  static constexpr const char* about =
      "A picture of the whole sky by longitude and latitude, bilinear: its middle is towards -z, its top towards +y, "
      "and +x is to the right of -z. It is a light, which nee and mis sample.";
  std::string file;  ///< as written in the scene file
  double rotate_y = 0, scale = 1;
  std::shared_ptr<const Image::Pixels> pixels;  ///< shared by copies of the scene; never null after reading
  bool operator==(const SkyPicture& other) const {
    return file == other.file && rotate_y == other.rotate_y && scale == other.scale &&
           (pixels == other.pixels || (pixels && other.pixels && *pixels == *other.pixels));
  }
};
inline constexpr auto fields(const SkyPicture*) {
  return std::tuple{
      Field{"rotate_y", &SkyPicture::rotate_y, any_number(), Slider{-180, 180}, "°", "turn about the y axis"}
          .called("Turn")
          .also("sky rotation, rotate sky, rotate environment"),
      Field{"scale", &SkyPicture::scale, at_least(0), Slider{0.01, 100, true}, "", "factor on the picture's radiance"}
          .also("sky strength, environment strength")};
}
using Background = std::variant<Vec3d, Gradient, Hemispheres, SkyPicture>;

struct Scene {
  std::string name;
  int width = 800, height = 450;  ///< pixels
  Camera camera;
  Background background = Vec3d{0, 0, 0};
  RenderSettings render;
  Display display;
  std::optional<Animation> animation;  ///< of films; pictures are of the scene without it
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Object> objects;
  bool operator==(const Scene&) const = default;
};

/// Calls visit(picture) for each picture file that the scene names: Image of its textures, SkyPicture of its sky. Both
/// have members `file` and `pixels`.
template <class Visit>
void each_picture(auto& scene, const Visit& visit) {
  for (auto& texture : scene.textures)
    if (auto* image = std::get_if<Image>(&texture.kind)) visit(*image);
  if (auto* sky = std::get_if<SkyPicture>(&scene.background)) visit(*sky);
}

/// The picture's size: the keys of "image".
inline constexpr auto image_fields() {
  return std::tuple{Field{"width", &Scene::width, between(1, 65536), no_slider(), "", "pixels in a row", true},
                    Field{"height", &Scene::height, between(1, 65536), no_slider(), "", "rows of pixels", true}};
}

/// Which parts of a scene an edit has changed, among those on which samples depend. The scene's name, its display
/// settings, its animation and the number of samples at which to stop are not among them.
struct SceneChange {
  bool camera = false;
  bool others = false;  ///< anything but the camera
  bool light = false;   ///< what light paths from lamps depend on: all but the picture, its sampling and the camera,
                        ///< of which the shutter counts
  bool none() const { return !camera && !others; }
};
SceneChange change_between(const Scene& before, const Scene& after);

}  // namespace tyndall
