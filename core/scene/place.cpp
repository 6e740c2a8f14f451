#include "core/scene/place.h"

#include "core/base/text.h"

#include <cmath>
#include <utility>

namespace tyndall {
namespace {

std::string range_text(const Valid& valid) {
  const bool low = std::isfinite(valid.low), high = std::isfinite(valid.high);
  std::string text;
  if (low && high && !valid.low_open && !valid.high_open) {
    text = " in [" + number_text(valid.low) + ", " + number_text(valid.high) + "]";
  } else {
    if (low) text += (valid.low_open ? " > " : " >= ") + number_text(valid.low);
    if (low && high) text += " and";
    if (high) text += (valid.high_open ? " < " : " <= ") + number_text(valid.high);
  }
  if (valid.nonzero) text += " other than 0";
  return text;
}

}  // namespace

std::string pointer_step(std::string_view key) {
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

std::string pointer(const Place& place) {
  if (!place.parent) return "/";
  const std::string step = place.key.data() ? pointer_step(place.key) : std::to_string(place.index);
  return (place.parent->parent ? pointer(*place.parent) : "") + "/" + step;
}

void fail(const Place& place, std::string found, std::string expected) {
  throw ParseError{pointer(place), std::move(found), std::move(expected)};
}

Meaning colour_meaning(std::string_view colour_name) {
  if (colour_name == "radiance") return {at_least(0), "", "radiance, linear RGB", Slider{0, 20}};
  return {between(0, 1), "", "share of the light that goes on, linear RGB", Slider{0, 1}};
}

std::string expected_text(const Meaning& meaning, Form form) {
  const char* kind = form == Form::number  ? "a number"
                     : form == Form::whole ? "a whole number"
                                           : "an array of 3 numbers";
  std::string text = kind + range_text(meaning.valid);
  if (*meaning.unit) text += std::string(" in ") + meaning.unit;
  if (*meaning.help) text += std::string(" (") + meaning.help + ")";
  return text;
}

}  // namespace tyndall
