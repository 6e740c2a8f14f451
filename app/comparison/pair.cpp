#include "app/comparison/comparison.h"

#include "app/text/values.h"
#include "core/base/text.h"
#include "core/image/image_io.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

using Path = std::filesystem::path;

/// One of the two pictures, for messages and for its place.
struct Placed {
  const Path& name;
  const LinearImage& image;
};

std::string text_of(const Region& r) { return fmt::format("{},{},{},{}", r.x0, r.y0, r.x1, r.y1); }
std::string size_of(const LinearImage& image) { return fmt::format("{}x{}", image.width, image.height); }

[[noreturn]] void refuse(const Placed& image, const Placed& reference, const std::string& found,
                         const std::string& expected) {
  throw UsageError(
      fmt::format("{}: found {}, expected {} as in {}", image.name.string(), found, expected, reference.name.string()));
}

/// Refuses two EXR files whose pixels cannot be the same ones.
void check_frames(const Placed& image, const Placed& reference) {
  const ImageFrame &a = *image.image.frame, &b = *reference.image.frame;
  if (!(a.display == b.display))
    refuse(image, reference, "the display window " + text_of(a.display), text_of(b.display));
  if (a.pixel_aspect != b.pixel_aspect)
    refuse(image, reference, fmt::format("pixelAspectRatio {}", a.pixel_aspect), fmt::format("{}", b.pixel_aspect));
  if (a.white_luminance && b.white_luminance && *a.white_luminance != *b.white_luminance)
    refuse(image, reference, fmt::format("whiteLuminance {}", *a.white_luminance),
           fmt::format("{}", *b.white_luminance));
}

/// Where the pixels of a picture lie, compared with another one.
Region place_of(const Placed& picture, const Placed& other) {
  if (picture.image.frame) return picture.image.frame->data;
  const Region whole{0, 0, other.image.width, other.image.height};
  const ImageFrame frame = other.image.frame.value_or(ImageFrame{whole, whole});
  if (frame.pixel_aspect != 1)
    refuse(picture, other, "square pixels", fmt::format("pixelAspectRatio {}", frame.pixel_aspect));
  for (const Region& place : {frame.display, frame.data})
    if (place.width() == picture.image.width && place.height() == picture.image.height) return place;
  const std::string data = frame.data == frame.display ? "" : " or " + size_of(other.image);
  refuse(picture, other, size_of(picture.image) + " pixels",
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

/// errors: of each value of the picture; squared: their squares.
NoisyImage with_errors(const Path& name, LinearImage image, const Path& error_name, LinearImage errors, bool squared) {
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
void read_figures(const Path& file, NoisyImage& image) {
  const auto text = read_embedded_stats(file);
  if (!text) return;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object()) return;
  if (json.contains("spp") && json["spp"].is_number()) image.spp = json["spp"].get<double>();
  image.correlated = json.contains("sharing") && json["sharing"].is_boolean() && json["sharing"].get<bool>();
}

NoisyImage read_exr(const Path& file) {
  if (const auto film = read_film(file)) {
    if (auto image = noisy_image(*film)) return std::move(*image);
    refuse_noise(file, "pixels with fewer than 2 samples", "two of each, as noise is the difference of the two halves");
  }
  const Path variance = file.string() + ":Variance";
  try {
    NoisyImage image = with_errors(file, read_image(file), variance, read_image(variance), true);
    read_figures(file, image);
    return image;
  } catch (const NoSuchLayer&) {
    refuse_noise(file, "neither a film nor a layer Variance", "one of them: tyndall render writes both");
  }
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
  pair.image = take_pixels(pair, image_name, read_picture(image_name, ppm));
  const std::vector<std::string> told = pair.remarks;
  pair.reference = take_pixels(pair, reference_name, read_picture(reference_name, ppm));
  if (image_name == reference_name) pair.remarks = told;
  pair.image_pixels = pair.image.rgb.size() / 3, pair.reference_pixels = pair.reference.rgb.size() / 3;
  const Placed image{image_name, pair.image}, reference{reference_name, pair.reference};
  if (pair.image.frame && pair.reference.frame) check_frames(image, reference);
  const Region a = place_of(image, reference), b = place_of(reference, image), both = common_part(a, b);
  if (both.x0 >= both.x1 || both.y0 >= both.y1)
    refuse(image, reference, "pixels in the data window " + text_of(a) + " alone", "some in " + text_of(b));
  pair.image_place = a, pair.reference_place = b;
  cut(pair.image, a, both);
  cut(pair.reference, b, both);
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
  NoisyImage image = exr ? read_exr(file) : with_errors(file, read_image(file), errors, read_image(errors), false);
  image.region = place;
  return image;
}

}  // namespace tyndall
