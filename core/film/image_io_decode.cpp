#include "core/film/image_io_file.h"

#include <stb_image.h>

#include <array>
#include <memory>

namespace tyndall {

namespace {

struct Release {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// Throws for what stb does not know or would be too large.
void check_size(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height, &channels) == 0) {
    cannot_read(file,
                std::string("found no image (") + stbi_failure_reason() + "), expected PNG, JPEG, BMP, TGA or HDR");
  }
  if (width < 1 || height < 1) cannot_read(file, "the image has no pixels");
  if (std::int64_t{width} * height > max_image_pixels) {
    cannot_read(file, "found " + std::to_string(width) + " x " + std::to_string(height) +
                          " pixels, expected at most 2^28 in all");
  }
}

}  // namespace

Rgb8Image decode_rgb8(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  check_size(file, bytes);
  const int size = static_cast<int>(bytes.size());
  if (stbi_is_hdr_from_memory(bytes.data(), size) != 0) {
    cannot_read(file, "found floating-point pixels, expected 8-bit ones (PNG, JPEG, BMP, TGA)");
  }
  Rgb8Image image;
  int channels = 0;
  const std::unique_ptr<stbi_uc, Release> pixels(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 3));
  if (!pixels) cannot_read(file, std::string("damaged: ") + stbi_failure_reason());
  const std::size_t count =
      std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgb.assign(pixels.get(), pixels.get() + count);
  return image;
}

Rgb8Image read_rgb8(const std::filesystem::path& file) { return decode_rgb8(file, read_bytes(file)); }

LinearImage read_hdr(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  check_size(file, bytes);
  LinearImage image;
  int channels = 0;
  const std::unique_ptr<float, Release> pixels(
      stbi_loadf_from_memory(bytes.data(), static_cast<int>(bytes.size()), &image.width, &image.height, &channels, 3));
  if (!pixels) cannot_read(file, std::string("damaged: ") + stbi_failure_reason());
  const std::size_t count =
      std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.rgb.assign(pixels.get(), pixels.get() + count);
  return image;
}

}  // namespace tyndall
