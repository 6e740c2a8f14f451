#include "core/image/image_io.h"

#include "core/base/text.h"
#include "core/image/image_io_file.h"

#include <utility>

namespace tyndall {
namespace {

/// A text that Tyndall has written into a PNG or EXR; nothing if it is not there.
std::optional<std::string> embedded_text(const std::filesystem::path& file, const std::string& name) {
  // Pipes are left alone: what is read from one here could not be read as a scene afterwards.
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  const ImageKind kind = image_kind(read_bytes(file, kind_size));
  if (kind == ImageKind::png) return png_text(file, read_bytes(file), name);
  if (kind == ImageKind::exr) return exr_text(file, name);
  return {};
}

}  // namespace

PictureName picture_name(const std::filesystem::path& name) {
  std::error_code error;
  const std::string text = name.string();
  if (std::filesystem::exists(name, error)) return {name};
  for (std::size_t colon = text.rfind(':'); colon != text.npos && colon > 0; colon = text.rfind(':', colon - 1)) {
    const std::filesystem::path file = text.substr(0, colon);
    if (std::filesystem::exists(file, error) && !std::filesystem::is_directory(file, error))
      return {file, text.substr(colon + 1)};
  }
  return {name};
}

PictureFile read_picture(const std::filesystem::path& name, PpmCurve ppm) {
  const auto [file, layer] = picture_name(name);
  // A pipe can be read only once, so that it is not asked for its first bytes alone.
  std::error_code error;
  const bool whole = std::filesystem::is_fifo(file, error);
  std::vector<std::uint8_t> bytes = whole ? read_bytes(file) : read_bytes(file, kind_size);
  const ImageKind kind = image_kind(bytes);
  PictureFile picture;
  if (kind == ImageKind::exr && whole)
    cannot_read(file, "found an EXR in a pipe, expected a file: it is not read in order");
  if (kind == ImageKind::exr) {
    picture.image = read_exr(file, layer);
  } else {
    if (layer)
      throw NoSuchLayer(name.string() + ": found a layer's name after a file that is no EXR, expected " +
                        file.string());
    if (!whole && kind != ImageKind::unknown) bytes = read_bytes(file);
    constexpr std::pair<ImageKind, decltype(&read_png)> readers[] = {
        {ImageKind::png, read_png}, {ImageKind::jpeg, read_jpeg}, {ImageKind::bmp, read_bmp},
        {ImageKind::tga, read_tga}, {ImageKind::pfm, read_pfm},   {ImageKind::hdr, read_hdr}};
    for (const auto& [its_kind, read] : readers)
      if (kind == its_kind) picture = read(file, bytes);
    if (kind == ImageKind::ppm) picture = read_ppm(file, bytes, ppm);
    if (kind == ImageKind::unknown)
      cannot_read(file, "found no image, expected PNG, PPM, JPEG, BMP, TGA, PFM, HDR or EXR");
  }
  picture.kind = kind;
  return picture;
}

PictureFile read_texture(const std::filesystem::path& file) {
  const ImageKind kind = image_kind(read_bytes(file, kind_size));
  if (kind == ImageKind::pfm || kind == ImageKind::hdr || kind == ImageKind::exr)
    cannot_read(file, "found floating-point pixels, expected 8 or 16 bits (PNG, PPM, JPEG, BMP, TGA)");
  return read_picture(file);
}

PictureFile read_sky(const std::filesystem::path& name) {
  constexpr std::size_t max_pixels = (std::size_t(1) << 31) / 3;  // kernels count floats by 32 bits
  const auto file = picture_name(name).file;
  const ImageKind kind = image_kind(read_bytes(file, kind_size));
  if (kind != ImageKind::pfm && kind != ImageKind::hdr && kind != ImageKind::exr && kind != ImageKind::unknown)
    cannot_read(file, "found 8 or 16 bits a number, expected radiance in floating point (HDR, EXR, PFM)");
  PictureFile picture = read_picture(name);
  const LinearImage& image = picture.image;
  if (image.frame && !(image.frame->data == image.frame->display))
    cannot_read(file, "found a data window that is not the display window, expected pixels of the whole sky");
  if (image.rgb.size() >= 3 * max_pixels)
    cannot_read(file, "found " + std::to_string(image.rgb.size() / 3) + " pixels, expected fewer than " +
                          std::to_string(max_pixels));
  return picture;
}

LinearImage read_image(const std::filesystem::path& file) { return read_picture(file).image; }

std::optional<std::string> read_embedded_scene(const std::filesystem::path& file) {
  return embedded_text(file, "tyndall:scene");
}
std::optional<std::string> read_embedded_stats(const std::filesystem::path& file) {
  return embedded_text(file, "tyndall:stats");
}
std::optional<std::string> read_embedded_contents(const std::filesystem::path& file) {
  return embedded_text(file, "tyndall:contents");
}

bool is_image_output(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".png" || ending == ".exr" || ending == ".pfm" || ending == ".hdr" || ending == ".ppm";
}

}  // namespace tyndall
