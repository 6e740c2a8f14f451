#pragma once
#include "core/base/choice.h"
#include "core/base/fields.h"

#include <string>
#include <tuple>
#include <vector>

/// Keys: what values of a scene are at some frames of a film. Between keys they follow a curve.
namespace tyndall {

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
