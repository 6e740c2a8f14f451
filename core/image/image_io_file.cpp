#include "core/image/image_io_file.h"

#include "core/base/text.h"
#include "core/system/files.h"
#include "core/system/open_file.h"

#include <algorithm>
#include <cassert>
#include <cerrno>

namespace tyndall {
namespace {

bool is_valid_size(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= max_image_pixels && height <= max_image_pixels / width;
}

std::string size_problem(std::int64_t width, std::int64_t height) {
  return "found an image of " + std::to_string(width) + " x " + std::to_string(height) +
         " pixels, expected 1 to 2^28 in all";
}

bool is_line_end(std::string_view text) { return text.starts_with('\n') || text.starts_with("\r\n"); }

/// A TGA has no mark: it is told by values of its header that can hardly be anything else.
/// Truevision TGA File Format Specification, version 2.0.
bool is_tga(std::span<const std::uint8_t> start) {
  if (start.size() < kind_size) return false;
  const unsigned palette = start[1], type = start[2], bits = start[16];
  const bool mapped = type == 1 || type == 9, coloured = type == 2 || type == 3 || type == 10 || type == 11;
  const bool known_bits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  return known_bits && ((palette == 1 && (mapped || coloured)) || (palette == 0 && coloured));
}

}  // namespace

void cannot_read(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot read: " + printable(why));
}

void cannot_write(const std::filesystem::path& file, const std::string& why) {
  throw ImageFileError(file.string() + ": cannot write: " + printable(why));
}

void check_readable(const std::filesystem::path& file, std::int64_t width, std::int64_t height) {
  if (!is_valid_size(width, height)) cannot_read(file, size_problem(width, height));
}

void check_enough(const std::filesystem::path& file, std::uint64_t size, std::uint64_t minimum) {
  if (size < minimum)
    cannot_read(file, "damaged: found " + std::to_string(size) + " bytes, expected at least " +
                          std::to_string(minimum) + " for the size that it says");
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
  const ReadStream stream(open_stream(file, "rb"));
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

std::size_t pixels_after(std::span<const std::uint8_t> bytes, std::size_t end, std::size_t pixels) {
  const bool two = end + 1 < bytes.size() && bytes[end] == '\r' && bytes[end + 1] == '\n';
  const std::size_t start = std::min(end + 1, bytes.size());
  return two && bytes.size() - start > pixels ? start + 1 : start;
}

void check_end(const std::filesystem::path& file, std::span<const std::uint8_t> after, std::string_view magic) {
  const std::string_view text(reinterpret_cast<const char*>(after.data()), after.size());
  const auto first = std::find_if_not(text.begin(), text.end(), is_space);
  if (first == text.end()) return;
  if (text.substr(static_cast<std::size_t>(first - text.begin())).starts_with(magic))
    cannot_read(file, "found several pictures in one file, expected one");
  cannot_read(file, "found " + std::to_string(after.size()) + " bytes after the last pixel, expected none");
}

ImageKind image_kind(std::span<const std::uint8_t> start) {
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  if (text.starts_with("\x89PNG\r\n\x1a\n")) return ImageKind::png;
  if (text.starts_with("\xff\xd8\xff")) return ImageKind::jpeg;
  if (text.starts_with("\x76\x2f\x31\x01")) return ImageKind::exr;
  for (const std::string_view name : {"#?RADIANCE", "#?RGBE"})
    if (text.starts_with(name) && is_line_end(text.substr(name.size()))) return ImageKind::hdr;
  if (text.starts_with("BM") && text.size() >= 6 && text.find('\0') != text.npos) return ImageKind::bmp;
  if (text.size() > 2 && text[0] == 'P' && (is_space(text[2]) || text[2] == '#')) {
    if (text[1] == 'F' || text[1] == 'f') return ImageKind::pfm;
    if (text[1] >= '1' && text[1] <= '7') return ImageKind::ppm;
  }
  return is_tga(start) ? ImageKind::tga : ImageKind::unknown;
}

}  // namespace tyndall
