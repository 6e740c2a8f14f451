#include "app/cli/commands.h"
#include "app/files/outputs.h"
#include "app/report/heat_map.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/bias.h"
#include "core/accuracy/error.h"
#include "core/accuracy/flip.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace tyndall {
namespace {

struct Comparison {
  int width = 0, height = 0;
  ImageError error;
  double flip = 0;  ///< mean
  std::vector<float> flip_map;
  std::optional<BlockScores> blocks;  ///< if both files hold films of one region
};

/// If both are EXR files with films: scores that tell whether they differ by more than their noise.
std::optional<BlockScores> compare_films(const CompareCommand& command) {
  if (!is_exr(command.image) || !is_exr(command.reference)) return std::nullopt;
  const auto image = read_film(command.image), reference = read_film(command.reference);
  if (!image || !reference) return std::nullopt;
  const BlockScores scores = block_scores(*image, *reference);
  return scores.blocks > 0 ? std::optional(scores) : std::nullopt;
}

Comparison compare(const CompareCommand& command) {
  const LinearImage image = read_image(command.image), reference = read_image(command.reference);
  const auto size = [](const LinearImage& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
  if (image.width != reference.width || image.height != reference.height)
    throw UsageError(command.image.string() + ": found " + size(image) + " pixels, expected " + size(reference) +
                     " as in " + command.reference.string());
  Comparison result{image.width, image.height, image_error(image.rgb, reference.rgb), 0, {}, compare_films(command)};
  result.flip_map = flip_map(image.rgb, reference.rgb, image.width, image.height);
  for (const float value : result.flip_map) result.flip += static_cast<double>(value);
  result.flip /= static_cast<double>(result.flip_map.size());
  return result;
}

std::string json_text(const Comparison& c) {
  const auto channels = [](Vec3d v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  nlohmann::ordered_json json;
  json["width"] = c.width;
  json["height"] = c.height;
  json["mse"] = c.error.mse;
  json["rmse"] = c.error.rmse;
  json["relmse"] = c.error.rel_mse;
  json["psnr"] = c.error.psnr;  // infinite for equal images: null
  json["flip"] = c.flip;
  json["mean_image"] = channels(c.error.mean_image);
  json["mean_reference"] = channels(c.error.mean_reference);
  if (c.blocks)
    json["blocks"] = {{"count", c.blocks->blocks},
                      {"mean_square_z", c.blocks->mean_square},
                      {"worst_z", c.blocks->worst},
                      {"limit", c.blocks->most},
                      {"only_noise", c.blocks->noise()}};
  return json.dump(2) + "\n";
}

std::string blocks_text(const BlockScores& b) {
  return fmt::format("blocks   mean z^2 {:.3g} in {} blocks of 16x16 (up to {:.3g} is noise), worst |z| {:.3g}: {}\n",
                     b.mean_square, b.blocks, b.most, b.worst, b.noise() ? "only noise" : "more than noise");
}

std::string row(const char* name, double value, const char* note) {
  const std::string line = fmt::format("{:<8} {:<13.6g} {}", name, value, note);
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string table(const Comparison& c) {
  const Vec3d a = c.error.mean_image, b = c.error.mean_reference;
  const std::string means = fmt::format(
      "mean     image         reference\n"
      "  red    {:<13.6g} {:.6g}\n"
      "  green  {:<13.6g} {:.6g}\n"
      "  blue   {:<13.6g} {:.6g}\n",
      a.x, b.x, a.y, b.y, a.z, b.z);
  return row("MSE", c.error.mse, "") + row("RMSE", c.error.rmse, "") +
         row("relMSE", c.error.rel_mse, "depends on the unit of radiance") + row("PSNR", c.error.psnr, "dB, sRGB") +
         row("FLIP", c.flip, "mean, 67 pixels a degree, sRGB") + (c.blocks ? blocks_text(*c.blocks) : "") + means;
}

/// Whether all checks pass; prints which errors are too large. An error that is not a number always is.
bool passes(const CompareCommand& command, const Comparison& c) {
  bool good = true;
  const auto check = [&good](const char* name, double value, const std::optional<double>& limit) {
    if (!limit || value <= *limit) return;
    complain(fmt::format("check failed: {} is {:.6g}, expected at most {:.6g}", name, value, *limit));
    good = false;
  };
  check("RMSE", c.error.rmse, command.max_rmse);
  check("relMSE", c.error.rel_mse, command.max_rel_mse);
  check("FLIP", c.flip, command.max_flip);
  return good;
}

}  // namespace

int run(const CompareCommand& command) {
  check_outputs({{"--heatmap", command.heatmap}}, {command.image, command.reference});
  if (!command.heatmap.empty()) check_can_write(command.heatmap);
  const Comparison comparison = compare(command);
  if (!command.heatmap.empty())
    write_png(command.heatmap, heat_map(comparison.flip_map, comparison.width, comparison.height), 0, ToneMap::srgb,
              {});
  write_standard_output(command.json ? json_text(comparison) : table(comparison));
  return passes(command, comparison) ? 0 : 1;
}

}  // namespace tyndall
