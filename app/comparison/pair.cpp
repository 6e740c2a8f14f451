#include "app/comparison/pair.h"

#include "app/text/values.h"
#include "core/image/image_io.h"

#include <fmt/core.h>

#include <algorithm>

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

bool has_size(const LinearImage& image, const Region& region) {
  return image.width == region.width() && image.height == region.height();
}

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

/// Where the pixels of a picture that does not say it lie, compared with an EXR.
Region place_beside(const Placed& plain, const Placed& exr) {
  const ImageFrame& frame = *exr.image.frame;
  if (frame.pixel_aspect != 1)
    refuse(plain, exr, "square pixels", fmt::format("pixelAspectRatio {}", frame.pixel_aspect));
  if (has_size(plain.image, frame.display)) return frame.display;
  if (has_size(plain.image, frame.data)) return frame.data;
  const std::string data = frame.data == frame.display ? "" : " or " + size_of(exr.image);
  refuse(plain, exr, size_of(plain.image) + " pixels",
         fmt::format("{}x{}{}", frame.display.width(), frame.display.height(), data));
}

std::pair<Region, Region> places_of(const Placed& image, const Placed& reference) {
  if (image.image.frame && reference.image.frame) {
    check_frames(image, reference);
    return {image.image.frame->data, reference.image.frame->data};
  }
  if (image.image.frame) return {image.image.frame->data, place_beside(reference, image)};
  if (reference.image.frame) return {place_beside(image, reference), reference.image.frame->data};
  if (size_of(image.image) != size_of(reference.image))
    refuse(image, reference, size_of(image.image) + " pixels", size_of(reference.image));
  const Region whole{0, 0, image.image.width, image.image.height};
  return {whole, whole};
}

Region common(const Region& a, const Region& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
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

/// Takes over what is told of a file, and returns its pixels.
LinearImage take(PicturePair& pair, const Path& name, PictureFile picture) {
  pair.has_ppm = pair.has_ppm || picture.kind == ImageKind::ppm;
  for (std::string& remark : picture.remarks) pair.remarks.push_back(std::move(remark));
  if (picture.has_alpha)
    pair.remarks.push_back(name.string() + ": alpha is not looked at: what is hidden beneath it is compared");
  return std::move(picture.image);
}

}  // namespace

PicturePair read_pair(const Path& image_name, const Path& reference_name, PpmCurve ppm) {
  PicturePair pair;
  pair.image = take(pair, image_name, read_picture(image_name, ppm));
  const std::vector<std::string> told = pair.remarks;
  pair.reference = take(pair, reference_name, read_picture(reference_name, ppm));
  if (image_name == reference_name) pair.remarks = told;
  pair.image_pixels = pair.image.rgb.size() / 3, pair.reference_pixels = pair.reference.rgb.size() / 3;
  const Placed image{image_name, pair.image}, reference{reference_name, pair.reference};
  const auto [a, b] = places_of(image, reference);
  const Region both = common(a, b);
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
  if (!(common(data, display) == display))
    throw UsageError(
        fmt::format("{}: found the pixels of its data window {} alone, expected all of its display window {}",
                    name.string(), text_of(data), text_of(display)));
  cut(image, data, display);
  return picture;
}

}  // namespace tyndall
