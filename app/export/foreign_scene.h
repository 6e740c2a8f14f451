#pragma once
#include "core/compile/flatten.h"
#include "core/image/image.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Writes scenes for other renderers. What a renderer has no equal of is refused; nothing is approximated.
///
/// First step: a scene as shapes in world space with one material and at most one medium each.
namespace tyndall {

/// A flat shape. The points are origin + a u + b v; the normal is along u × v, out of a box.
struct ForeignFlat {
  enum class Kind { quad, triangle, disk };
  Kind kind;  ///< 0 <= a, b <= 1; a, b >= 0 and a + b <= 1; inner <= sqrt(a² + b²) <= 1
  Vec3d origin, u, v;
  double inner = 0;
};

struct ForeignSphere {
  Vec3d center, center_end;  ///< while time runs from 0 to 1; equal: at rest
  double radius = 1;         ///< > 0
  bool inward = false;       ///< the normal points inward
  double degrees = 0;        ///< turn about y, for image textures
  bool moves() const { return !(center == center_end); }
};

/// A sphere, or flat shapes: one, or the faces of a box.
struct ForeignShape {
  std::optional<ForeignSphere> sphere;
  std::vector<ForeignFlat> flats;
  const Material* material = nullptr;  ///< of the scene; null: the boundary of a medium alone, which is not seen
  int medium = -1;                     ///< index into ForeignScene::media, behind the surface; -1: none
  bool shines() const { return material && std::holds_alternative<Light<double>>(material->kind); }
};

/// What a renderer has an equal of.
struct ForeignRenderer {
  const char* name;           ///< in messages: "pbrt-v4"
  bool even_mirrors = false;  ///< mirrors that reflect the same share at every angle
  bool solid_checkers = false;
  bool images = false;  ///< as textures
  bool moving_spheres = false;
  bool overlapping_media = false;
  bool depth_zero = false;  ///< pictures of lights and background alone
  bool ellipses = false;    ///< disks whose half axes differ or are not at right angles
  bool rings = false;
  bool media_in_lights = false;  ///< within a light's surface
};

struct ForeignScene {
  std::vector<ForeignShape> shapes;
  std::vector<PlacedVolume> media;  ///< whose albedo is a colour
  int camera_medium = -1;           ///< that the eye is in; -1: none
};

/// name: what messages call the scene. Throws SceneError with the first thing that the renderer has no equal of.
ForeignScene foreign_scene(const Scene& scene, const std::string& name, const ForeignRenderer& renderer);

/// The equal of a scene for a renderer, as the text of a file.
struct ForeignFile {
  std::string text;
  /// Names and pixels of PFM beside the file: skies and textures as they are read here. Names of ours need not be files
  /// there (a layer of an EXR), and others read the same files in other ways (EXPOSURE in .hdr, profiles,
  /// orientations).
  std::vector<std::pair<std::string, LinearImage>> pictures;
  std::map<std::string, std::string> meshes{};  ///< names and texts of meshes (PLY) beside the file
};
/// file: where the text is to lie. Throw SceneError as foreign_scene() does.
ForeignFile pbrt_file(const Scene& scene, const std::string& name, const std::string& file);
ForeignFile mitsuba_file(const Scene& scene, const std::string& name, const std::string& file);
ForeignFile blender_file(const Scene& scene, const std::string& name, const std::string& file);

/// "1 2 3", with `between` between the numbers.
std::string numbers_of(Vec3d v, const char* between = " ");
/// A material's colour, also one that a texture of one colour gives; nothing: it differs from point to point.
std::optional<Vec3d> plain_colour(const Material& material, const Scene& scene);
/// Distance of the plane in focus, along the axis.
double focus_of(const Camera& camera);
/// A picture of the colours that a function gives its pixels.
LinearImage picture_of(int width, int height, const std::function<Vec3d(int x, int y)>& colour);
/// One pixel of a picture.
Vec3d texel(const Image::Pixels& pixels, int x, int y);
/// A sky's picture in rows of another number: as it is seen at the distances from its top, of 1, that `place` gives for
/// each of them. At least two columns.
LinearImage sky_in_rows(const Image::Pixels& sky, int rows, double (*place)(int row, int rows));
/// A background that depends on the height of a direction (y of the unit vector) alone.
Vec3d colour_at(const Background& sky, double height);
/// The first name without folder and ending, with another ending: "a/box.pbrt" gives "box.exr".
std::string beside(const std::string& file, const std::string& ending);

}  // namespace tyndall
