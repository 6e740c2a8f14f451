#pragma once
#include "core/base/fields.h"

#include <string>

/// How numbers are shown, typed and put on sliders. All functions are pure.
namespace tyndall {

/// The slider's range, made large enough for a value beyond it: up to the next power of ten, or to what is valid.
Slider widened(const Slider& slider, const Valid& valid, double value);

/// Where a value is on a slider, in [0, 1]. Logarithmic sliders show the size and keep the sign.
double slider_position(const Slider& slider, double value);
/// The value at a position in [0, 1], rounded to what a user would type. `before` gives the sign on logarithmic
/// sliders. finer: so many digits more.
double slider_value(const Slider& slider, double position, double before, int finer = 0);
/// The value after dragging a number sideways by `steps`: 400 of them cross the slider. finer: so many digits more.
double dragged(const Slider& slider, double before, double steps, int finer = 0);
/// The nearest round number: of about twenty even steps across the slider, or 1, 2 or 5 times a power of ten on a
/// logarithmic one. fine: of ten times as many even steps, or of two digits.
double snapped(const Slider& slider, double value, bool fine);

/// "0.180", "34.0": with as many digits as steps of the slider have; very large or small values as format_short().
std::string format_value(const Slider& slider, double value);
/// Four significant digits at most: "278", "-0.75", "1.2e+06".
std::string format_short(double value);
/// "1,024".
std::string format_count(unsigned long long n);

/// Reads what a user typed: a number or a sum of such: "1/4", "2*pi", "(1 + 0.5)^2" or "sqrt(2)", with + - * / ^,
/// parentheses, pi and sqrt in the usual order; a decimal comma, spaces and the unit are allowed. Returns whether it is
/// one, and has a finite value.
bool parse_number(const std::string& text, const std::string& unit, double& value);

}  // namespace tyndall
