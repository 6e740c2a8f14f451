#pragma once
#include "core/base/choice.h"
#include "core/base/fields.h"
#include "core/base/random.h"
#include "core/base/vec.h"
#include "core/image/tonemap.h"
#include "core/scene/integrator.h"

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

/// What a scene says about how it is looked at: the camera, how the picture is computed, how it is shown,
/// and its keys: what values are at some frames of a film. Between keys they follow a curve.
///
/// To add a setting: a member with its default, and a line in the fields() below it. The scene file, its schema, the
/// window's row and the command line's option follow from that line. A switch that is on by default gets an option that
/// takes on or off; one that is off by default, an option that switches it on.
namespace tyndall {

/// Thin-lens camera; right-handed, looks from look_from to look_at.
struct Camera {
  Vec3d look_from{0, 0, 0}, look_at{0, 0, -1}, vup{0, 1, 0};
  double vfov = 90;                        ///< vertical and full, degrees
  double defocus_angle = 0;                ///< of the cone of rays through a pixel, degrees; 0: all is sharp
  std::optional<double> focus_distance{};  ///< along the axis; absent: the distance from look_from to look_at
  double shutter_open = 0, shutter_close = 0;
  bool operator==(const Camera&) const = default;
};

inline constexpr auto fields(const Camera*) {
  return std::tuple{
      Field{"look_from", &Camera::look_from, any_number(), no_slider(), "", "position of the eye, scene units"}
          .called("Position")
          .also("camera position, eye, look from"),
      Field{"look_at", &Camera::look_at, any_number(), no_slider(), "", "the point in the middle of the picture"}
          .called("Target")
          .also("look at, point of interest"),
      Field{"vup", &Camera::vup, any_number(), no_slider(), "", "the direction that is up in the picture"}
          .called("Up")
          .also("up vector, roll, tilt, vup"),
      Field{"vfov", &Camera::vfov, inside(0, 180), Slider{1, 120}, "°", "vertical field of view, full angle"}
          .called("Field of view")
          .also("fov, vfov, focal, focal length, lens, angle of view, zoom"),
      Field{"defocus_angle", &Camera::defocus_angle, Valid{.low = 0, .high = 180, .high_open = true}, Slider{0, 5}, "°",
            "opening of the cone of rays that meets in a point in focus; 0: all is sharp"}
          .called("Defocus")
          .also("aperture, f-stop, f-number, depth of field, dof, bokeh, lens radius, defocus blur"),
      Field{"focus_distance", &Camera::focus_distance, above(0), Slider{0.1, 100, true}, "",
            "distance of the plane in focus, along the axis, scene units"}
          .called("Focus")
          .also("focal distance, focus distance, focal plane, focus plane")};
}

/// How much light a smooth boundary reflects.
enum class FresnelKind { exact, schlick };

constexpr Label label(FresnelKind fresnel) {
  switch (fresnel) {
    case FresnelKind::exact:
      return {"exact", "Fresnel's equations, unpolarised"};
    case FresnelKind::schlick:
      return {"schlick", "the books' rule, wrong by up to 0.93 inside glass", true};
  }
  return {};
}

/// How integrator mis finds lights through glass spheres and slabs and off mirrors.
enum class Caustics { chains, scatter };

constexpr Label label(Caustics caustics) {
  switch (caustics) {
    case Caustics::chains:
      return {"chains", "exact paths through and off single balls, where they pay, and chance"};
    case Caustics::scatter:
      return {"scatter", "chance alone"};
  }
  return {};
}

/// Most samples a pixel that a film can add without losing exactness.
inline constexpr std::uint32_t max_samples = 1u << 24;

struct RenderSettings {
  int max_depth = 1000;
  std::optional<int> spp{};  ///< absent: the renderer's own choice
  Integrator integrator = Integrator::mis;
  SamplerKind sampler = SamplerKind::sobol;
  FresnelKind fresnel = FresnelKind::exact;
  Caustics caustics = Caustics::chains;
  bool sharing = true;
  std::uint32_t seed = 0;
  bool adaptive = false;
  bool operator==(const RenderSettings&) const = default;
};

inline constexpr auto fields(const RenderSettings*) {
  return std::tuple{
      Field{"max_depth", &RenderSettings::max_depth, at_least(0), Slider{1, 1000, true}, "",
            "longest path, in scattering events; 0: lights and background only"}
          .called("Depth")
          .also("bounces, max bounces, ray depth, max depth, path length, recursion"),
      Field{"spp", &RenderSettings::spp, between(1, max_samples), Slider{1, 65536, true}, "", "samples per pixel"}
          .called("Limit")
          .also("samples, spp, samples per pixel, sample count, sampling, quality"),
      Field{"integrator", &RenderSettings::integrator, "how light is found"}.also(
          "render engine, method, next event estimation, light sampling"),
      Field{"sampler", &RenderSettings::sampler, "where random numbers come from"}.also(
          "sobol, random numbers, quasi monte carlo"),
      Field{"fresnel", &RenderSettings::fresnel, "how much glass reflects"}.also("schlick, reflectivity"),
      Field{"caustics", &RenderSettings::caustics,
            "how integrator mis finds light through glass balls and panes and off mirrors"}
          .also("manifold next event estimation, mnee"),
      Field{"sharing", &RenderSettings::sharing,
            "integrator mis lets light that comes by way of walls reach eight pixels at once, where that pays"}
          .also("path reuse, reuse, restir"),
      Field{"seed", &RenderSettings::seed, between(0, 4294967295.0), Slider{0, 100}, "", "seed of the random numbers"}
          .also("random seed"),
      Field{"adaptive", &RenderSettings::adaptive,
            "more samples where the estimated error is, fewer elsewhere; spp is their mean, never exceeded; "
            "not for shards or merged films"}
          .also("adaptive sampling")};
}

/// How linear light becomes a picture; never part of rendering.
struct Display {
  double exposure = 0;
  ToneMap tone_map = ToneMap::srgb;
  bool dither = true;
  bool operator==(const Display&) const = default;
};

inline constexpr auto fields(const Display*) {
  // 2^100 and 2^-100 leave room for any picture within the range of single precision.
  return std::tuple{
      Field{"exposure", &Display::exposure, between(-100, 100), Slider{-6, 6}, "EV",
            "stops, of PNG, PPM and window only: light is multiplied by 2 to this power"}
          .also("brightness, ev, gain"),
      Field{"tone_map", &Display::tone_map, "of PNG, PPM and window only: what happens to light that is too bright"}
          .also("tonemapping, tone mapping, tone curve, view transform, color management, filmic, aces, agx"),
      Field{"dither", &Display::dither,
            "of PNG, PPM and window only: rounds to 8 bits by a fixed pattern, so that smooth shades show no bands"}
          .also("dithering, banding")};
}

enum class Curve { linear, smooth };

constexpr Label label(Curve curve) {
  switch (curve) {
    case Curve::linear:
      return {"linear", "evenly from key to key"};
    case Curve::smooth:
      return {"smooth", "without jerks, never beyond the keys (monotone cubic), at rest at both ends"};
  }
  return {};
}

/// What a value is at one frame: one number, or the components of a vector.
struct KeyFrame {
  int frame = 0;
  std::vector<double> value;
  bool operator==(const KeyFrame&) const = default;
};

/// A value that changes during the film, by its JSON pointer.
struct KeyedValue {
  std::string pointer;
  std::vector<KeyFrame> keys;  ///< at least one, in the order of their frames, each of as many numbers
  bool operator==(const KeyedValue&) const = default;
};

struct Animation {
  int frames = 120;
  Curve curve = Curve::smooth;
  bool orbit = false;
  std::vector<KeyedValue> keyed;
  bool operator==(const Animation&) const = default;
};

inline constexpr int max_frames = 1000000;

inline constexpr auto fields(const Animation*) {
  return std::tuple{
      Field{"frames", &Animation::frames, between(1, max_frames), Slider{1, 1000, true}, "", "number of frames", true}
          .also("film length, duration, frame count"),
      Field{"curve", &Animation::curve, "how values change between keys"}.also("interpolation, easing"),
      Field{"orbit", &Animation::orbit, "the camera's look_from moves around look_at in place of straight towards keys"}
          .also("turntable")};
}

/// The value at a time, counted in frames: on the curve between keys, constant before the first and after the last.
///
/// `smooth` is a cubic Hermite curve for each component. Its slope at a key is the weighted harmonic mean of the slopes
/// to both neighbours, and 0 where these differ in sign and at the first and last key, so that no value lies beyond
/// those of the keys around it. F. Fritsch, J. Butland, A Method for Constructing Local Monotone Piecewise Cubic
/// Interpolants, SIAM J. Sci. Stat. Comput. 5 (1984).
std::vector<double> value_at(const KeyedValue& keyed, Curve curve, double time);

/// Sets the key of that frame, or adds it.
void set_key(Animation& animation, const std::string& pointer, KeyFrame key);
/// The value's keys; null if it has none.
const KeyedValue* find_keys(const Animation& animation, const std::string& pointer);

}  // namespace tyndall
