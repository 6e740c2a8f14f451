#include "core/image/image_io.h"

#include "core/image/image_io_file.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace tyndall {

namespace {

LinearImage to_linear(const Rgb8Image& image) {
  std::array<float, 256> linear;
  for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = srgb_decode(static_cast<float>(i) / 255);
  LinearImage decoded{image.width, image.height, {}};
  decoded.rgb.reserve(image.rgb.size());
  for (const std::uint8_t value : image.rgb) decoded.rgb.push_back(linear[value]);
  return decoded;
}

}  // namespace

PictureName picture_name(const std::filesystem::path& name) {
  std::error_code error;
  const std::string& text = name.native();
  if (std::filesystem::exists(name, error)) return {name};
  for (std::size_t colon = text.rfind(':'); colon != text.npos && colon > 0; colon = text.rfind(':', colon - 1)) {
    const std::filesystem::path file = text.substr(0, colon);
    if (std::filesystem::exists(file, error) && !std::filesystem::is_directory(file, error))
      return {file, text.substr(colon + 1)};
  }
  return {name};
}

LinearImage read_image(const std::filesystem::path& name) {
  const auto [file, layer] = picture_name(name);
  // A pipe can be read only once, so that it is not asked for its first bytes alone.
  std::error_code error;
  const bool whole = std::filesystem::is_fifo(file, error);
  std::vector<std::uint8_t> bytes = whole ? read_bytes(file) : read_bytes(file, 16);
  const ImageKind kind = image_kind(bytes);
  if (kind == ImageKind::exr && whole)
    cannot_read(file, "found an EXR in a pipe, expected a file: it is not read in order");
  if (kind == ImageKind::exr) return read_exr(file, layer);
  if (layer)
    throw NoSuchLayer(name.string() + ": found a layer's name after a file that is no EXR, expected " + file.string());
  if (kind == ImageKind::unknown) cannot_read(file, "found no image, expected PNG, JPEG, PFM, HDR or EXR");
  if (!whole) bytes = read_bytes(file);
  if (kind == ImageKind::pfm) return read_pfm(file, bytes);
  if (kind == ImageKind::hdr) return read_hdr(file, bytes);
  return to_linear(decode_rgb8(file, bytes));
}

std::optional<std::string> read_embedded_scene(const std::filesystem::path& file) {
  // Pipes are left alone: what is read from one here could not be read as a scene afterwards.
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  const ImageKind kind = image_kind(read_bytes(file, 16));
  if (kind == ImageKind::png) return png_text(file, read_bytes(file), "tyndall:scene");
  if (kind == ImageKind::exr) return exr_text(file, "tyndall:scene");
  return {};
}

bool is_image_output(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".png" || ending == ".exr" || ending == ".pfm" || ending == ".hdr";
}

}  // namespace tyndall
