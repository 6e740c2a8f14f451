#include "core/image/image_io.h"
#include "core/image/image_io_file.h"

#include <stb_image.h>

#include <memory>
#include <new>
#include <string_view>

namespace tyndall {

namespace {

struct Release {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// What stb_image says of its failure. Without memory it says so, or nothing at all.
std::string why_it_failed() {
  const char* reason = stbi_failure_reason();
  if (!reason || reason == std::string_view("outofmem")) throw std::bad_alloc();
  return reason;
}

/// The fewest bytes that a file of this size can have, by kind. Deflate shrinks at most 1032 times; in the densest TGA
/// 2 bytes stand for 128 pixels; a BMP, which looks like no other kind, has at least a bit for each pixel.
std::uint64_t least_bytes(ImageKind kind, std::span<const std::uint8_t> bytes, std::uint64_t width,
                          std::uint64_t height) {
  if (kind != ImageKind::png) return width * height / 64;
  constexpr std::uint64_t channels_of[8] = {1, 1, 3, 1, 2, 1, 4, 1};  // by colour type
  const std::uint64_t bits = bytes[24] * channels_of[bytes[25] & 7u];
  return (1 + width * bits / 8) * height / 1032;
}

}  // namespace

Rgb8Image decode_rgb8(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const ImageKind kind = image_kind(bytes);
  if (kind == ImageKind::pfm || kind == ImageKind::hdr || kind == ImageKind::exr) {
    cannot_read(file, "found floating-point pixels, expected 8-bit ones (PNG, JPEG, BMP, TGA)");
  }
  if (kind == ImageKind::jpeg) return read_jpeg(file, bytes);
  // For a PNG that is too large, stb only says "unknown image type": its header is checked here first.
  if (kind == ImageKind::png && bytes.size() >= 24) {
    check_readable(file, get_u32(bytes.subspan(16)), get_u32(bytes.subspan(20)));
  }
  const int size = static_cast<int>(bytes.size());
  Rgb8Image image;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &image.width, &image.height, &channels) == 0) {
    cannot_read(file, "expected PNG, JPEG, BMP or TGA: " + why_it_failed());
  }
  check_readable(file, image.width, image.height);
  check_enough(
      file, bytes.size(),
      least_bytes(kind, bytes, static_cast<std::uint64_t>(image.width), static_cast<std::uint64_t>(image.height)));
  if (kind == ImageKind::png) check_png(file, bytes);
  const std::unique_ptr<stbi_uc, Release> pixels(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, 3));
  if (!pixels) cannot_read(file, "damaged: " + why_it_failed());
  const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.has_alpha = channels == 2 || channels == 4;
  image.rgb.assign(pixels.get(), pixels.get() + 3 * count);
  return image;
}

Rgb8Image read_rgb8(const std::filesystem::path& file) { return decode_rgb8(file, read_bytes(file)); }

}  // namespace tyndall
