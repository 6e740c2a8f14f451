#pragma once
#include <limits>

/// The list of a struct's editable values. Reading, writing, checking, the schema, the window's rows and the options of
/// the command line are loops over it: a value is described in one place, beside the struct that holds it.
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
/// For values without a slider, for example places in the scene: their range follows from the scene's size.
constexpr Slider no_slider() { return {0, 0}; }
constexpr bool has_slider(const Slider& slider) { return slider.low < slider.high; }

/// One editable value of Owner. T: double, int, std::uint32_t, bool, Vec3<double>, an enum with words (choice.h), or
/// std::optional of one of them; what an empty one means is said beside the member.
template <class Owner, class T>
struct Field {
  const char* name;  ///< key in the scene file; options spell it with dashes
  T Owner::*value;
  Valid valid;
  Slider slider;
  const char* unit;        ///< "" for a pure number
  const char* help;        ///< one phrase: what it means physically
  bool required;           ///< a scene file must give it
  const char* label = "";  ///< on screen; "": the name with a capital, and spaces
  const char* words = "";  ///< what other programs call it, separated by ", "

  /// A number or a vector.
  constexpr Field(const char* name_, T Owner::*value_, Valid valid_, Slider slider_, const char* unit_,
                  const char* help_, bool required_ = false)
      : name(name_), value(value_), valid(valid_), slider(slider_), unit(unit_), help(help_), required(required_) {}
  /// A switch or a choice.
  constexpr Field(const char* name_, T Owner::*value_, const char* help_)
      : Field(name_, value_, Valid{}, no_slider(), "", help_) {}

  constexpr Field called(const char* on_screen) const {
    Field field = *this;
    field.label = on_screen;
    return field;
  }
  constexpr Field also(const char* other_words) const {
    Field field = *this;
    field.words = other_words;
    return field;
  }
};

/// The list of T.
template <class T>
constexpr auto fields_of() {
  return fields(static_cast<const T*>(nullptr));
}

}  // namespace tyndall
