#include "app/comparison/comparison.h"

#include "app/text/values.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tyndall {
namespace {

using Path = std::filesystem::path;

std::string text_of(const Region& r) { return fmt::format("{},{},{},{}", r.x0, r.y0, r.x1, r.y1); }
std::string size_of(const LinearImage& image) { return fmt::format("{}x{}", image.width, image.height); }

[[noreturn]] void refuse(const PairedPicture& image, const PairedPicture& reference, const std::string& found,
                         const std::string& expected) {
  throw UsageError(
      fmt::format("{}: found {}, expected {} as in {}", image.name.string(), found, expected, reference.name.string()));
}

/// Refuses two EXR files whose pixels cannot be the same ones.
void check_frames(const PairedPicture& image, const PairedPicture& reference) {
  const ImageFrame &a = *image.pixels.frame, &b = *reference.pixels.frame;
  if (!(a.display == b.display))
    refuse(image, reference, "the display window " + text_of(a.display), text_of(b.display));
  if (a.pixel_aspect != b.pixel_aspect)
    refuse(image, reference, fmt::format("pixelAspectRatio {}", a.pixel_aspect), fmt::format("{}", b.pixel_aspect));
  if (a.white_luminance && b.white_luminance && *a.white_luminance != *b.white_luminance)
    refuse(image, reference, fmt::format("whiteLuminance {}", *a.white_luminance),
           fmt::format("{}", *b.white_luminance));
}

/// Where the pixels of a picture lie, compared with another one.
Region place_of(const PairedPicture& picture, const PairedPicture& other) {
  if (picture.pixels.frame) return picture.pixels.frame->data;
  const Region whole{0, 0, other.pixels.width, other.pixels.height};
  const ImageFrame frame = other.pixels.frame.value_or(ImageFrame{whole, whole});
  if (frame.pixel_aspect != 1)
    refuse(picture, other, "square pixels", fmt::format("pixelAspectRatio {}", frame.pixel_aspect));
  for (const Region& place : {frame.display, frame.data})
    if (place.width() == picture.pixels.width && place.height() == picture.pixels.height) return place;
  const std::string data = frame.data == frame.display ? "" : " or " + size_of(other.pixels);
  refuse(picture, other, size_of(picture.pixels) + " pixels",
         fmt::format("{}x{}{}", frame.display.width(), frame.display.height(), data));
}

/// The pixels of `part`, which lies within `place`: where the pixels of the image lie.
void cut(LinearImage& image, const Region& place, const Region& part) {
  if (place == part) return;
  std::vector<float> rgb;
  rgb.reserve(std::size_t{3} * static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  const std::ptrdiff_t row = std::ptrdiff_t{3} * image.width;
  for (int y = part.y0; y < part.y1; ++y) {
    const auto start = image.rgb.begin() + (y - place.y0) * row + std::ptrdiff_t{3} * (part.x0 - place.x0);
    rgb.insert(rgb.end(), start, start + std::ptrdiff_t{3} * part.width());
  }
  image.width = part.width(), image.height = part.height(), image.rgb = std::move(rgb);
  if (image.frame) image.frame->data = part;
}

[[noreturn]] void refuse_noise(const Path& file, const std::string& found, const std::string& expected) {
  throw UsageError("--max-z: " + file.string() + ": found " + found + ", expected " + expected);
}

/// error_name: the picture of the standard errors of each value; squared: of their squares.
NoisyImage read_with_errors(const Path& name, const Path& error_name, bool squared) {
  LinearImage image = read_image(name), errors = read_image(error_name);
  if (errors.width != image.width || errors.height != image.height)
    refuse_noise(error_name, fmt::format("{}x{} pixels", errors.width, errors.height),
                 fmt::format("{}x{} as in {}", image.width, image.height, name.string()));
  if (std::any_of(errors.rgb.begin(), errors.rgb.end(), [](float v) { return !(v >= 0 && std::isfinite(v)); }))
    refuse_noise(error_name, "a standard error that is negative or not finite", "the noise of every pixel");
  if (squared)
    for (float& value : errors.rgb) value = std::sqrt(value);
  return {{}, std::move(image.rgb), std::move(errors.rgb)};
}

NoisyImage read_exr(const Path& file) {
  if (const auto film = read_film(file)) {
    if (auto image = noisy_image(*film)) return std::move(*image);
    refuse_noise(file, "pixels with fewer than 2 samples", "two of each, as noise is the difference of the two halves");
  }
  const Path variance = file.string() + ":Variance";
  try {
    NoisyImage image = read_with_errors(file, variance, true);
    // What the figures in an EXR of Tyndall say of its samples.
    const auto json = nlohmann::json::parse(read_embedded_stats(file).value_or(""), nullptr, false);
    if (json.contains("spp") && json["spp"].is_number()) image.spp = json["spp"].get<double>();
    image.correlated = json.contains("sharing") && json["sharing"].is_boolean() && json["sharing"].get<bool>();
    return image;
  } catch (const NoSuchLayer&) {
    refuse_noise(file, "neither a film nor a layer Variance", "one of them: tyndall render writes both");
  }
}

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

LinearImage take_pixels(PairFiles& files, const Path& name, PictureFile picture) {
  files.has_ppm = files.has_ppm || picture.kind == ImageKind::ppm;
  for (std::string& remark : picture.remarks) files.remarks.push_back(std::move(remark));
  if (picture.has_alpha)
    files.remarks.push_back(name.string() + ": alpha is not looked at: what is hidden beneath it is compared");
  return std::move(picture.image);
}

PicturePair read_pair(const Path& image_name, const Path& reference_name, PpmCurve ppm) {
  PicturePair pair;
  PairedPicture &image = pair.image, &reference = pair.reference;
  image = {image_name, take_pixels(pair, image_name, read_picture(image_name, ppm))};
  const std::vector<std::string> told = pair.remarks;
  reference = {reference_name, take_pixels(pair, reference_name, read_picture(reference_name, ppm))};
  if (image_name == reference_name) pair.remarks = told;
  pair.image_pixels = image.pixels.rgb.size() / 3, pair.reference_pixels = reference.pixels.rgb.size() / 3;
  if (image.pixels.frame && reference.pixels.frame) check_frames(image, reference);
  image.place = place_of(image, reference), reference.place = place_of(reference, image);
  const Region both = common_part(image.place, reference.place);
  if (both.x0 >= both.x1 || both.y0 >= both.y1)
    refuse(image, reference, "pixels in the data window " + text_of(image.place) + " alone",
           "some in " + text_of(reference.place));
  for (PairedPicture* one : {&image, &reference}) cut(one->pixels, one->place, both);
  return pair;
}

PictureFile read_whole_picture(const Path& name) {
  PictureFile picture = read_picture(name);
  LinearImage& image = picture.image;
  if (!image.frame) return picture;
  const Region display = image.frame->display, data = image.frame->data;
  if (image.frame->pixel_aspect != 1)
    throw UsageError(
        fmt::format("{}: found pixelAspectRatio {}, expected square pixels", name.string(), image.frame->pixel_aspect));
  if (!(common_part(data, display) == display))
    throw UsageError(
        fmt::format("{}: found the pixels of its data window {} alone, expected all of its display window {}",
                    name.string(), text_of(data), text_of(display)));
  cut(image, data, display);
  return picture;
}

NoisyImage read_noisy_image(const Path& name, const Region& place) {
  const auto [file, layer] = picture_name(name);
  const std::string ending = lower_case(file.extension().string());
  const bool exr = ending == ".exr" && !layer;
  Path errors = file;
  errors.replace_extension(".error.pfm");
  std::error_code error;
  if (!exr && !(ending == ".pfm" && std::filesystem::exists(errors, error)))
    refuse_noise(
        name,
        ending == ".pfm" ? "no " + errors.filename().string() + " beside it" : "a picture that does not say its noise",
        "an EXR as tyndall render writes it (-o NAME.exr), or a PFM with its standard errors beside it in "
        "NAME.error.pfm");
  NoisyImage image = exr ? read_exr(file) : read_with_errors(file, errors, false);
  image.region = place;
  return image;
}

Comparison compare_images(const Path& image, const Path& reference, PpmCurve ppm, bool noise) {
  PicturePair pair = read_pair(image, reference, ppm);
  const Region place = pair.image.place, reference_place = pair.reference.place;
  Comparison result = compare_pair(std::move(pair));
  if (noise && result.not_finite.empty())
    result.noise = noise_scores(read_noisy_image(image, place), read_noisy_image(reference, reference_place));
  return result;
}

std::string noise_text(const NoiseScores& s) {
  std::string text = fmt::format("means {:.3g}, blocks {:.3g}", std::ranges::max(s.mean_z), s.block_z);
  if (s.compares_outliers) text += fmt::format(", outliers {:.3g}", s.outlier_z);
  text += fmt::format(" standard errors, corrected for {} blocks", s.blocks);
  if (s.unclear_blocks > 0)
    text += fmt::format("; cannot tell in {} of them, which have 60 effective samples or fewer", s.unclear_blocks);
  if (s.lit_blocks == 0) text += "; nothing is lit in either";
  return text;
}

Comparison compare_pair(PicturePair pair) {
  const LinearImage &image = pair.image.pixels, &reference = pair.reference.pixels;
  Comparison result{std::move(static_cast<PairFiles&>(pair)),
                    image.width,
                    image.height,
                    image_error(image.rgb, reference.rgb),
                    0,
                    flip_map(image.rgb, reference.rgb, image.width, image.height),
                    outside_error(image.rgb, reference.rgb)};
  // What is equal to nothing: says so in words, and in the map of FLIP, which takes such values for black or white.
  for (const PairedPicture* one : {&pair.image, &pair.reference})
    if (const std::string text = not_finite_text(one->pixels); !text.empty())
      result.not_finite.push_back(all_printable(one->name.string()) + ": " + text);
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
