#include "core/image/image_io_file.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <memory>
#include <string_view>
#include <system_error>

namespace tyndall {

namespace {

std::string error_text(int number) { return std::generic_category().message(number); }

}  // namespace

void cannot_read(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot read: " + printable(why));
}

void cannot_write(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot write: " + printable(why));
}

namespace {

bool is_valid_size(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= max_image_pixels && height <= max_image_pixels / width;
}

std::string size_problem(std::int64_t width, std::int64_t height) {
  return "found an image of " + std::to_string(width) + " x " + std::to_string(height) +
         " pixels, expected 1 to 2^28 in all";
}

}  // namespace

void check_readable(const std::filesystem::path& file, std::int64_t width, std::int64_t height) {
  if (!is_valid_size(width, height)) cannot_read(file, size_problem(width, height));
}

void check_enough(const std::filesystem::path& file, std::uint64_t size, std::uint64_t least) {
  if (size < least)
    cannot_read(file, "damaged: found " + std::to_string(size) + " bytes, expected at least " + std::to_string(least) +
                          " for the size that it says");
}

void check_writable(const std::filesystem::path& file, std::int64_t width, std::int64_t height) {
  if (!is_valid_size(width, height)) cannot_write(file, size_problem(width, height));
}

void check_writable(const std::filesystem::path& file, const LinearImage& image) {
  check_writable(file, image.width, image.height);
  assert(image.rgb.size() ==
         std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, std::size_t limit) {
  const ReadStream stream(std::fopen(file.c_str(), "rb"));
  if (!stream) cannot_read(file, error_text(errno));
  std::vector<std::uint8_t> bytes;
  for (std::size_t size = 0, want = 0; size == want && size < limit;) {
    want = std::min(limit, std::max<std::size_t>(2 * size, 65536));
    bytes.resize(want);
    size += std::fread(bytes.data() + size, 1, want - size, stream.get());
    if (std::ferror(stream.get()) != 0) cannot_read(file, error_text(errno));
    bytes.resize(size);
  }
  return bytes;
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
  std::vector<std::uint8_t> bytes = read_bytes(file, max_file_size + 1);
  if (bytes.size() > max_file_size) cannot_read(file, "longer than 2 GiB");
  return bytes;
}

ImageKind image_kind(std::span<const std::uint8_t> start) {
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ImageKind::png;
  if (text.starts_with("\xff\xd8\xff")) return ImageKind::jpeg;
  if (text.starts_with("\x76\x2f\x31\x01")) return ImageKind::exr;
  if (text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n")) return ImageKind::hdr;
  if (text.size() > 2 && (text.starts_with("PF") || text.starts_with("Pf")) && text[2] <= ' ') return ImageKind::pfm;
  return ImageKind::unknown;
}

}  // namespace tyndall
