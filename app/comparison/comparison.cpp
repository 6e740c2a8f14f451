#include "app/comparison/comparison.h"

#include "app/text/values.h"
#include "core/accuracy/flip.h"
#include "core/image/image_io.h"

#include <fmt/core.h>

namespace tyndall {

Comparison compare_images(const std::filesystem::path& image_file, const std::filesystem::path& reference_file) {
  const LinearImage image = read_image(image_file), reference = read_image(reference_file);
  const auto size = [](const LinearImage& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
  if (image.width != reference.width || image.height != reference.height)
    throw UsageError(image_file.string() + ": found " + size(image) + " pixels, expected " + size(reference) +
                     " as in " + reference_file.string());
  Comparison result{image.width, image.height, image_error(image.rgb, reference.rgb), 0, {}};
  result.flip_map = flip_map(image.rgb, reference.rgb, image.width, image.height);
  for (const float value : result.flip_map) result.flip += static_cast<double>(value);
  result.flip /= static_cast<double>(result.flip_map.size());
  return result;
}

std::vector<std::string> too_large(const Comparison& c, const Tolerance& limits) {
  std::vector<std::string> lines;
  const auto check = [&lines](const char* name, double value, const std::optional<double>& limit) {
    if (!limit || value <= *limit) return;
    lines.push_back(fmt::format("{} is {:.6g}, expected at most {:.6g}", name, value, *limit));
  };
  check("RMSE", c.error.rmse, limits.rmse);
  check("relMSE", c.error.rel_mse, limits.rel_mse);
  check("FLIP", c.flip, limits.flip);
  return lines;
}

}  // namespace tyndall
