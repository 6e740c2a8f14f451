#include "app/comparison/comparison.h"

#include "app/text/values.h"
#include "core/accuracy/flip.h"
#include "core/image/image_io.h"

#include <fmt/core.h>

namespace tyndall {

namespace {

void take_remarks(Comparison& comparison, const std::filesystem::path& file, PictureFile& picture) {
  comparison.has_ppm = comparison.has_ppm || picture.kind == ImageKind::ppm;
  for (std::string& remark : picture.remarks) comparison.remarks.push_back(std::move(remark));
  if (picture.has_alpha)
    comparison.remarks.push_back(file.string() + ": alpha is not looked at: what is hidden beneath it is compared");
}

}  // namespace

Comparison compare_images(const std::filesystem::path& image_file, const std::filesystem::path& reference_file,
                          PpmCurve ppm) {
  PictureFile image_picture = read_picture(image_file, ppm), reference_picture = read_picture(reference_file, ppm);
  const LinearImage &image = image_picture.image, &reference = reference_picture.image;
  const auto size = [](const LinearImage& i) { return std::to_string(i.width) + "x" + std::to_string(i.height); };
  if (image.width != reference.width || image.height != reference.height)
    throw UsageError(image_file.string() + ": found " + size(image) + " pixels, expected " + size(reference) +
                     " as in " + reference_file.string());
  Comparison result{image.width, image.height, image_error(image.rgb, reference.rgb), 0, {}};
  take_remarks(result, image_file, image_picture);
  if (reference_file != image_file) take_remarks(result, reference_file, reference_picture);
  result.flip_map = flip_map(image.rgb, reference.rgb, image.width, image.height);
  for (const float value : result.flip_map) result.flip += static_cast<double>(value);
  result.flip /= static_cast<double>(result.flip_map.size());
  return result;
}

void check_gamma2(PpmCurve ppm, bool has_ppm) {
  if (ppm == PpmCurve::gamma2 && !has_ppm)
    throw UsageError("--gamma2: found no PPM among the images, expected one: only PPM is read so");
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
