#include "app/comparison/comparison.h"

#include "app/text/values.h"
#include "core/base/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

/// What differs by more than `limit` standard errors, a line for means, blocks and outliers.
void find_more_than_noise(const NoiseScores& s, double limit, std::vector<std::string>& lines) {
  constexpr const char* channels[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c)
    if (!(s.mean_z[c] <= limit))
      lines.push_back(
          fmt::format("the mean of {} differs by {:.3g} +- {:.2g}: {:.3g} standard errors, expected at most {:g}",
                      channels[c], s.difference[c], s.error[c], s.mean_z[c], limit));
  if (const int blocks = s.blocks_above(limit); blocks > 0)
    lines.push_back(
        fmt::format("{} of {} blocks of 16x16 pixels differ by more than {:g} standard errors; the most, by {:.3g}, "
                    "the one at {},{}",
                    blocks, s.blocks, limit, s.block_z, s.worst_block.x0, s.worst_block.y0));
  if (!(s.outlier_z <= limit))
    lines.push_back(
        fmt::format("{} pixels differ by more than 5 times the noise around them, which explains {:g}: {:.3g} "
                    "standard errors, expected at most {:g}",
                    s.outliers, s.explained_outliers, s.outlier_z, limit));
  if (s.tells()) return;
  lines.push_back(fmt::format("too few samples to tell: no block with light, of {}, has more than 60 effective samples",
                              s.lit_blocks));
  if (s.enough_spp > 0) lines.back() += fmt::format("; about {:.0f} a pixel would do", std::ceil(s.enough_spp));
}

}  // namespace

Comparison compare_images(const std::filesystem::path& image, const std::filesystem::path& reference, PpmCurve ppm,
                          bool noise) {
  PicturePair pair = read_pair(image, reference, ppm);
  const Region place = pair.image_place, reference_place = pair.reference_place;
  Comparison result = compare_pair(std::move(pair), image, reference);
  if (noise && result.not_finite.empty())
    result.noise = noise_scores(read_noisy_image(image, place), read_noisy_image(reference, reference_place));
  return result;
}

std::string noise_text(const NoiseScores& s) {
  std::string text =
      fmt::format("means {:.3g}, blocks {:.3g}", *std::max_element(s.mean_z.begin(), s.mean_z.end()), s.block_z);
  if (s.compares_outliers) text += fmt::format(", outliers {:.3g}", s.outlier_z);
  text += fmt::format(" standard errors, corrected for {} blocks", s.blocks);
  if (s.unclear_blocks > 0)
    text += fmt::format("; cannot tell in {} of them, which have 60 effective samples or fewer", s.unclear_blocks);
  if (s.lit_blocks == 0) text += "; nothing is lit in either";
  return text;
}

Comparison compare_pair(PicturePair pair, const std::filesystem::path& image_file,
                        const std::filesystem::path& reference_file) {
  const LinearImage &image = pair.image, &reference = pair.reference;
  Comparison result{std::move(static_cast<PairFiles&>(pair)),
                    image.width,
                    image.height,
                    image_error(image.rgb, reference.rgb),
                    0,
                    flip_map(image.rgb, reference.rgb, image.width, image.height),
                    outside_error(image.rgb, reference.rgb)};
  // What is equal to nothing: says so in words, and in the map of FLIP, which takes such values for black or white.
  for (const auto& [file, picture] : {std::pair(&image_file, &image), std::pair(&reference_file, &reference)})
    if (const std::string text = not_finite_text(*picture); !text.empty())
      result.not_finite.push_back(all_printable(file->string()) + ": " + text);
  for (std::size_t i = 0; i < result.flip_map.size() && !result.not_finite.empty(); ++i)
    if (!is_finite(image, i) || !is_finite(reference, i)) result.flip_map[i] = 1;
  for (const float value : result.flip_map) result.flip += static_cast<double>(value);
  result.flip /= static_cast<double>(result.flip_map.size());
  return result;
}

std::string overlap_text(const Comparison& c) {
  const std::size_t both = c.flip_map.size();
  if (both == c.image_pixels && both == c.reference_pixels) return "";
  return fmt::format("{} that both have, of {} in the image and {} in the reference", both, c.image_pixels,
                     c.reference_pixels);
}

void check_gamma2(PpmCurve ppm, bool has_ppm) {
  if (ppm == PpmCurve::gamma2 && !has_ppm)
    throw UsageError("--gamma2: found no PPM among the images, expected one: only PPM is read so");
}

std::vector<std::string> too_large(const Comparison& c, const Tolerance& limits) {
  std::vector<std::string> lines = c.not_finite;
  const auto check = [&lines](const char* name, double value, const std::optional<double>& limit) {
    if (!limit || value <= *limit) return;
    lines.push_back(fmt::format("{} is {:.6g}, expected at most {:.6g}", name, value, *limit));
  };
  check("RMSE", c.error.rmse, limits.rmse);
  check("relMSE", c.error.rel_mse, limits.rel_mse);
  check("FLIP", c.flip, limits.flip);
  if (limits.z && c.noise) find_more_than_noise(*c.noise, *limits.z, lines);
  return lines;
}

void check_finite(const std::filesystem::path& file, const LinearImage& image) {
  const std::string found = not_finite_text(image);
  if (!found.empty()) throw UsageError(file.string() + ": found that " + found + ", expected finite values");
}

}  // namespace tyndall
