#include "app/comparison/pair.h"

#include "app/text/values.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_noise(const fs::path& file, const std::string& found, const std::string& expected) {
  throw UsageError("--max-z: " + file.string() + ": found " + found + ", expected " + expected);
}

/// errors: of each value of the picture; squared: their squares.
NoisyImage with_errors(const fs::path& name, LinearImage image, const fs::path& error_name, LinearImage errors,
                       bool squared) {
  if (errors.width != image.width || errors.height != image.height)
    refuse_noise(error_name, fmt::format("{}x{} pixels", errors.width, errors.height),
                 fmt::format("{}x{} as in {}", image.width, image.height, name.string()));
  if (std::any_of(errors.rgb.begin(), errors.rgb.end(), [](float v) { return !(v >= 0 && std::isfinite(v)); }))
    refuse_noise(error_name, "a standard error that is negative or not finite", "the noise of every pixel");
  if (squared)
    for (float& value : errors.rgb) value = std::sqrt(value);
  return {{}, std::move(image.rgb), std::move(errors.rgb)};
}

/// Takes over what the figures in an EXR of Tyndall say of its samples.
void read_figures(const fs::path& file, NoisyImage& image) {
  const auto text = read_embedded_stats(file);
  if (!text) return;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return;
  if (json.contains("spp") && json["spp"].is_number()) image.spp = json["spp"].get<double>();
  image.correlated = json.contains("sharing") && json["sharing"].is_boolean() && json["sharing"].get<bool>();
}

NoisyImage read_exr(const fs::path& file) {
  if (const auto film = read_film(file)) {
    if (auto image = noisy_image(*film)) return std::move(*image);
    refuse_noise(file, "pixels with fewer than 2 samples", "two of each, as noise is the difference of the two halves");
  }
  const fs::path variance = file.string() + ":Variance";
  try {
    NoisyImage image = with_errors(file, read_image(file), variance, read_image(variance), true);
    read_figures(file, image);
    return image;
  } catch (const NoSuchLayer&) {
    refuse_noise(file, "neither a film nor a layer Variance", "one of them: tyndall render writes both");
  }
}

NoisyImage read_noisy(const fs::path& name) {
  const auto [file, layer] = picture_name(name);
  const std::string ending = lower_case(file.extension().string());
  if (ending == ".exr" && !layer) return read_exr(file);
  fs::path errors = file;
  errors.replace_extension(".error.pfm");
  std::error_code error;
  if (ending == ".pfm" && fs::exists(errors, error))
    return with_errors(file, read_image(file), errors, read_image(errors), false);
  refuse_noise(
      name,
      ending == ".pfm" ? "no " + errors.filename().string() + " beside it" : "a picture that does not say its noise",
      "an EXR as tyndall render writes it (-o NAME.exr), or a PFM with its standard errors beside it in "
      "NAME.error.pfm");
}

}  // namespace

NoisyImage read_noisy_image(const fs::path& name, const Region& place) {
  NoisyImage image = read_noisy(name);
  image.region = place;
  return image;
}

}  // namespace tyndall
