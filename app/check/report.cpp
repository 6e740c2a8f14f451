#include "app/check/check.h"

#include "core/base/text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_objects = 6;
constexpr double min_light = 0.005;  // below that a relative difference says nothing

/// "-12 %", or for dark objects "+0.02".
std::string channel_text(double image, double expected) {
  if (expected < min_light) return fmt::format("{:+.3f}", image - expected);
  const double percent = 100 * (image / expected - 1);
  return fmt::format("{:+.{}f} %", percent, std::abs(percent) < 9.5 ? 1 : 0);
}

std::string object_line(const ObjectDifference& d) {
  return fmt::format("object   {}: red {}, green {}, blue {} ({} pixels)\n", d.object.name,
                     channel_text(d.image.x, d.expected.x), channel_text(d.image.y, d.expected.y),
                     channel_text(d.image.z, d.expected.z), d.pixels);
}

/// Of a right curve; "": nothing has to be said of it.
const char* curve_text(TransferCurve curve) {
  return curve == TransferCurve::srgb      ? "sRGB's curve"
         : curve == TransferCurve::power22 ? "gamma 2.2"
         : curve == TransferCurve::gamma2  ? "gamma 2"
                                           : "";
}

/// What the objects that differ have in common; "": nothing.
std::string common_kind(const Findings& v) {
  std::set<std::string> differ, all;
  for (const ObjectDifference& d : v.objects) differ.insert(d.object.kind);
  for (std::size_t pixel = 0; pixel < v.seen.of_pixel.size(); ++pixel) all.insert(v.seen.at(pixel).kind);
  return differ.size() == 1 && all.size() > 1 ? *differ.begin() : "";
}

std::string how_made(const Findings& v) {
  std::vector<std::string> parts;
  if (v.samples > 0)
    parts.push_back(fmt::format("about {} samples a pixel, as its noise tells", std::lround(v.samples)));
  if (const std::string curve = curve_text(v.curve); !curve.empty()) parts.push_back(curve);
  for (const Difference& choice : v.choices) parts.push_back(choice.words);
  return parts.empty() ? "" : "picture  " + joined(parts, "; ") + "\n";
}

int percent(double explained) { return static_cast<int>(std::lround(100 * std::clamp(explained, 0.0, 1.0))); }

std::string mistake_text(const Findings& v) {
  if (v.mistake)
    return fmt::format("mistake  likely: {} (that explains {} % of the difference)\n", v.mistake->words,
                       percent(v.mistake->explained));
  std::string text =
      v.untried > 0 ? "mistake  none is named, as the time was up" : "mistake  none of the usual ones explains it";
  text += fmt::format("; {} were tried", v.tried.size());
  if (!v.tried.empty() && v.tried.front().explained > 0.3)
    text += fmt::format(", the closest explains {} %, and something else is there: {}",
                        percent(v.tried.front().explained), v.tried.front().words);
  if (v.untried > 0)
    text += fmt::format("\nmistake  {} more are tried with more time: --time {:g}", v.untried, 2 * v.seconds);
  return text + "\n";
}

}  // namespace

std::string verdict_text(const Findings& v) {
  if (v.unknown)
    return "check    it cannot be told whether they agree: programs of the books find the light of this scene so "
           "seldom\n"
           "         that few samples show little of it\n";
  const std::string blocks = fmt::format("of {} blocks of {}x{} pixels", v.blocks, v.block_edge, v.block_edge);
  std::string text = fmt::format("check    the pictures differ by more than noise, in {} {}\n", v.different, blocks);
  if (v.too_few)
    text = fmt::format("check    too few samples to tell: a change of all light by {} % would not show{}\n",
                       std::lround(100 * v.unseen),
                       v.enough > 0 ? fmt::format("; about {:.0f} a pixel would do", v.enough) : "");
  else if (v.agrees)
    text = fmt::format("check    the pictures agree within the noise, in {} {}\n", v.blocks - v.different, blocks);
  text += how_made(v);
  if (std::ranges::any_of(v.seen.objects, &SeenObjects::Object::noisy_texture))
    text += "left out objects with noise textures: their veins lie elsewhere in Tyndall\n";
  if (v.too_few || v.agrees) return text;
  for (std::size_t k = 0; k < std::min(max_objects, v.objects.size()); ++k) text += object_line(v.objects[k]);
  if (v.objects.size() > max_objects) text += fmt::format("object   and {} others\n", v.objects.size() - max_objects);
  const std::string kind = common_kind(v);
  if (!kind.empty()) text += fmt::format("object   only {} differ{}\n", kind, kind.back() == 's' ? "" : "s");
  return text + mistake_text(v);
}

static void to_json(Json& json, const Difference& d) {
  json = {{"name", d.name}, {"text", d.words}, {"explained", d.explained}};
}
static void to_json(Json& json, const ObjectDifference& d) {
  json = {{"name", d.object.name},
          {"kind", d.object.kind},
          {"pixels", d.pixels},
          {"mean_image", {d.image.x, d.image.y, d.image.z}},
          {"mean_reference", {d.expected.x, d.expected.y, d.expected.z}}};
}

Json verdict_json(const Findings& v) {
  return {{"agrees", v.unknown || v.too_few ? Json() : Json(v.agrees)},
          {"too_few_samples", v.too_few},
          {"explanation", v.mistake ? Json(*v.mistake) : Json()},
          {"choices", v.choices},
          {"curve", curve_text(v.curve)},
          {"samples", v.samples},
          {"blocks", {{"count", v.blocks}, {"different", v.different}, {"edge", v.block_edge}}},
          {"objects", v.objects},
          {"tried", v.tried},
          {"out_of_time", v.untried > 0}};
}

}  // namespace tyndall
