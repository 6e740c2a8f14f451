#pragma once
// The materials, textures and objects of scenes, as structs. Made from the lists of fields in core by a test;
// ranges are those of scene files, and are checked when a thing is added to a scene.
// clang-format off
#include <tyndall/values.h>

namespace tyndall {
inline namespace v0 {

/// Matt: scatters with the cosine, the same in all directions of view.
struct Lambertian {
  static constexpr const char* list = "/materials/";
  Colour albedo{};  ///< linear, or a texture's name
  std::string json() const { return detail::Members("lambertian")("albedo", albedo).text(); }
};

/// A mirror, blurred by fuzz.
struct Metal {
  static constexpr const char* list = "/materials/";
  Colour albedo{};  ///< linear, or a texture's name
  double fuzz = 0;  ///< radius of the blur around the mirror direction; 0 is a mirror
  std::string json() const { return detail::Members("metal")("albedo", albedo)("fuzz", fuzz).text(); }
};

/// Smooth, clear glass or water: reflects or refracts, never absorbs.
struct Dielectric {
  static constexpr const char* list = "/materials/";
  double refractive_index = 1.5;  ///< inside over outside; below 1 for a bubble
  std::string json() const { return detail::Members("dielectric")("refractive_index", refractive_index).text(); }
};

/// Shines on both sides, reflects nothing.
struct Light {
  static constexpr const char* list = "/materials/";
  Colour radiance{};  ///< linear, or a texture's name
  std::string json() const { return detail::Members("light")("radiance", radiance).text(); }
};

/// One colour under a name that several materials can share.
struct Solid {
  static constexpr const char* list = "/textures/";
  Vec3 color{1, 1, 1};  ///< linear RGB
  std::string json() const { return detail::Members("solid")("color", color).text(); }
};

/// Cubes of two colours in space: floor(position / scale) summed over the axes, even or odd.
struct Checker {
  static constexpr const char* list = "/textures/";
  double scale = 1;  ///< edge of a cube, scene units
  Vec3 even{0, 0, 0};  ///< colour of the even cubes, linear RGB
  Vec3 odd{1, 1, 1};  ///< colour of the odd cubes, linear RGB
  std::string json() const { return detail::Members("checker")("scale", scale)("even", even)("odd", odd).text(); }
};

/// Grey gradient noise in space.
struct Noise {
  static constexpr const char* list = "/textures/";
  double scale = 1;  ///< lattice cells per scene unit; marble: veins per 2π scene units
  std::string style = "marble";  ///< what the noise is made into: perlin, turbulence, marble
  std::string json() const { return detail::Members("noise")("scale", scale)("style", style).text(); }
};

/// A picture laid on the surface by its uv coordinates, bilinear; v is up. u wraps around spheres and ends at the edge of flat shapes and boxes. An alpha channel is not looked at: what is hidden beneath it is shown. Not for media.
struct Image {
  static constexpr const char* list = "/textures/";
  std::string file{};  ///< a picture, relative to the scene's folder
  std::string json() const { return detail::Members("image")("file", file).text(); }
};

/// A sphere, at rest or moving.
struct Sphere {
  Vec3 center{0, 0, 0};  ///< centre, scene units
  double radius = 1;  ///< scene units; negative: the normal points inward (hollow glass)
  std::string material{};  ///< a material's name; empty for the boundary of a medium
  std::optional<Vec3> center_end{};  ///< centre at time 1, scene units
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("sphere")("center", center)("radius", radius)("material", material)
        ("center_end", center_end)("name", name)("transform", transform).text();
  }
};

/// A parallelogram: corner + a * u + b * v for a, b in [0, 1].
struct Quad {
  Vec3 corner{0, 0, 0};  ///< scene units
  Vec3 u{1, 0, 0};  ///< first edge, scene units
  Vec3 v{0, 1, 0};  ///< second edge, scene units
  std::string material{};  ///< a material's name; empty for the boundary of a medium
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("quad")("corner", corner)("u", u)("v", v)("material", material)("name", name)
        ("transform", transform).text();
  }
};

/// A cuboid along the axes, before its transform.
struct Box {
  Vec3 min{0, 0, 0};  ///< lower corner, scene units
  Vec3 max{1, 1, 1};  ///< upper corner, scene units
  std::string material{};  ///< a material's name; empty for the boundary of a medium
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("box")("min", min)("max", max)("material", material)("name", name)
        ("transform", transform).text();
  }
};

/// A triangle: corner + a * u + b * v for a, b >= 0 and a + b <= 1.
struct Triangle {
  Vec3 corner{0, 0, 0};  ///< scene units
  Vec3 u{1, 0, 0};  ///< edge from the corner, scene units
  Vec3 v{0, 1, 0};  ///< other edge from the corner, scene units
  std::string material{};  ///< a material's name; empty for the boundary of a medium
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("triangle")("corner", corner)("u", u)("v", v)("material", material)("name", name)
        ("transform", transform).text();
  }
};

/// A disk, an ellipse or a ring: center + a * u + b * v, where inner <= sqrt(a^2 + b^2) <= 1.
struct Disk {
  Vec3 center{0, 0, 0};  ///< centre, scene units
  Vec3 u{1, 0, 0};  ///< first half axis, scene units
  Vec3 v{0, 1, 0};  ///< second half axis, scene units
  std::string material{};  ///< a material's name; empty for the boundary of a medium
  double inner = 0;  ///< radius of the hole over that of the rim; 0: no hole
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("disk")("center", center)("u", u)("v", v)("material", material)("inner", inner)
        ("name", name)("transform", transform).text();
  }
};

/// Homogeneous fog, smoke or coloured glass: it fills its boundary, whatever lies inside. Overlapping media add. A boundary equal to an object's shape makes the medium that object's interior.
struct Medium {
  std::variant<Sphere, Box> boundary{};  ///< without a material
  double density = 1;  ///< mean number of scattering or absorption events per unit length
  Colour albedo{1, 1, 1};  ///< scattered fraction, linear, or a texture's name
  double g = 0;  ///< mean cosine of the scattering angle (Henyey-Greenstein); 0 scatters evenly
  std::string name{};  ///< for messages; may stay empty
  Transform transform{};
  std::string json() const {
    return detail::Members("medium")("boundary", boundary)("density", density)("albedo", albedo)("g", g)
        ("name", name)("transform", transform).text();
  }
};

}  // namespace v0
}  // namespace tyndall
