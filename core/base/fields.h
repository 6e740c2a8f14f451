#pragma once
#include <limits>

/// The list of a struct's editable values. Reading, writing, validation, the sliders and the schema are loops over it,
/// so a value is described in one place: beside the struct that holds it.
namespace tyndall {

/// Which numbers are meaningful; anything else is refused, never clamped. For a vector: each component.
struct Valid {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is not valid
  bool high_open = false;  ///< high itself is not valid
  bool nonzero = false;

  constexpr bool contains(double v) const {
    return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high) && !(nonzero && v == 0);
  }
};

constexpr Valid any_number() { return {}; }
constexpr Valid above(double low) { return {.low = low, .low_open = true}; }
constexpr Valid at_least(double low) { return {.low = low}; }
constexpr Valid between(double low, double high) { return {.low = low, .high = high}; }
constexpr Valid inside(double low, double high) {
  return {.low = low, .high = high, .low_open = true, .high_open = true};
}
constexpr Valid not_zero() { return {.nonzero = true}; }

/// What a slider offers: a useful part of the valid range. Logarithmic where the range spans magnitudes.
struct Slider {
  double low = 0, high = 1;
  bool logarithmic = false;
};

/// One editable value of Owner. T: double, int, Vec3<double>, std::optional<Vec3<double>>, ...
template <class Owner, class T>
struct Field {
  const char* name;  ///< key in the scene file
  T Owner::*value;
  Valid valid;
  Slider slider;
  const char* unit;  ///< "" for a pure number
  const char* help;  ///< one phrase: what it means physically
  bool required = false;
};
template <class Owner, class T>
Field(const char*, T Owner::*, Valid, Slider, const char*, const char*) -> Field<Owner, T>;
template <class Owner, class T>
Field(const char*, T Owner::*, Valid, Slider, const char*, const char*, bool) -> Field<Owner, T>;

}  // namespace tyndall
