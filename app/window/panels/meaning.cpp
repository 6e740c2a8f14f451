#include "app/window/panels/meaning.h"

#include "app/text/numbers.h"
#include "app/window/tools/camera_control.h"
#include "core/base/math.h"

#include <fmt/core.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <utility>

namespace tyndall {
namespace {

constexpr double degree = pi / 180;

/// 0.0032 -> "0.3 %", 0.47 -> "47 %".
std::string percent(double fraction) {
  const double value = 100 * fraction;
  const double unit = value < 9.95 ? 10 : 1;
  const double shown = std::round(value * unit) / unit;
  std::string text = format_short(shown);
  if (unit == 10 && text.find('.') == std::string::npos) text += ".0";
  return text + " %";
}

std::string format_three(double value) { return fmt::format("{:.3g}", value); }

double luminance(Vec3d c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

std::string degrees_text(double degrees) { return format_short(std::round(10 * degrees) / 10) + "°"; }

}  // namespace

double fuzz_loss(double fuzz) { return 0.1 * fuzz * fuzz; }

double forward_fraction(double g) {
  if (std::abs(g) < 1e-3) return 0.5 + 0.75 * g;  // here the formula below cancels; the next term is of third order
  return (1 - g * g) / (2 * g) * (1 / (1 - g) - 1 / std::sqrt(1 + g * g));
}

SharpRange sharp_range(const Camera& camera, int image_height) {
  const double focus = focus_distance(camera), lens = focus * std::tan(0.5 * degree * camera.defocus_angle);
  const double pixel = 2 * std::tan(0.5 * degree * camera.vfov) / image_height;  // per unit of depth
  // A point at depth z blurs to a disc of 2 lens |focus - z| / z on the plane in focus, whose pixels are pixel · focus.
  const double open = 2 * lens, blur = pixel * focus;
  const double infinite = std::numeric_limits<double>::infinity();
  return {open * focus / (open + blur), open > blur ? open * focus / (open - blur) : infinite};
}

std::string meaning(const Metal<>& metal, std::string_view) {
  if (metal.fuzz == 0) return "a perfect mirror";
  return percent(fuzz_loss(metal.fuzz)) + " of the light lost below the surface";
}

std::string meaning(const Dielectric<>& glass, std::string_view) {
  const double n = glass.refractive_index;
  if (n == 1) return "as the surroundings: invisible";
  // Both fit on one line, so that rows beneath do not jump.
  const std::string head_on = "reflects " + percent(fresnel(1.0, n));
  if (n > 1) return head_on + " head on, all beyond " + degrees_text(std::asin(1 / n) / degree);
  return head_on + ", all beyond " + degrees_text(std::asin(n) / degree) + " outside";
}

std::string meaning(const Medium<>& medium, std::string_view field) {
  if (field == "density")
    return medium.density > 0 ? "mean free path " + format_three(1 / medium.density) : "empty: light passes";
  if (medium.g == 0) return "isotropic: scatters evenly";
  const double forward = forward_fraction(medium.g);
  return medium.g > 0 ? percent(forward) + " goes on forward" : percent(1 - forward) + " goes back";
}

std::string meaning(const Sphere<>& sphere, std::string_view field) {
  if (field == "radius" && sphere.radius < 0) return "negative: the normal points inward";
  if (field == "center_end" && sphere.center_end) return "moves while the shutter is open";
  return "";
}

std::string meaning(const Disk<>& disk, std::string_view field) {
  if (field == "u" || field == "v") return "half axis of " + format_three(length(field == "u" ? disk.u : disk.v));
  if (field == "inner") return disk.inner > 0 ? "a ring: the hole is " + percent(disk.inner) + " as wide" : "no hole";
  return "";
}

std::string meaning(const Camera& camera, std::string_view field) {
  if (field == "vfov") {
    const double lens = 12 / std::tan(0.5 * degree * camera.vfov);  // half of 24 mm
    return "as a " + format_short(lens < 100 ? std::round(lens) : 10 * std::round(lens / 10)) +
           " mm lens on 35 mm film";
  }
  if (field == "defocus_angle") {
    if (camera.defocus_angle == 0) return "a pinhole: all is sharp";
    const double lens = focus_distance(camera) * std::tan(0.5 * degree * camera.defocus_angle);
    return "lens radius " + format_three(lens) + "; Shift+click focuses";
  }
  return "";
}

std::string meaning(const Display& display, std::string_view field) {
  return field == "exposure" ? "brightness × " + format_short(std::exp2(display.exposure)) : "";
}

std::string colour_meaning(const Material& material, Vec3d colour) {
  const double y = luminance(colour);
  if (std::holds_alternative<Light<>>(material.kind)) return "luminance " + format_short(y);
  if (!colour_name(material.kind)) return "";
  return "reflects " + percent(y) + " of white light";
}

std::string albedo_meaning(const Medium<>&, Vec3d albedo) {
  const double y = luminance(albedo);
  if (y == 0) return "absorbs only";
  if (albedo == Vec3d{1, 1, 1}) return "scatters, absorbs nothing";
  return "absorbs " + percent(1 - y) + " at each event";
}

}  // namespace tyndall
