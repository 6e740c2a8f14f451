// The two formats that stb decodes. What it would misread is refused here; all that pixels take must be in the file.
#include "core/image/image_io_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace tyndall {
namespace {

[[noreturn]] void fail_colour(const std::filesystem::path& file, std::uint32_t colour, std::int64_t colours) {
  cannot_read(file, "damaged: found colour " + std::to_string(colour) + ", expected one of the palette's " +
                        std::to_string(colours));
}

/// The header of a BMP. Microsoft: Windows GDI, BITMAPFILEHEADER to BITMAPV5HEADER.
struct BmpHeader {
  std::span<const std::uint8_t> bytes;
  std::uint32_t number(std::size_t at, std::size_t size = 4) const { return low_first(bytes, at, size); }
  std::uint32_t pixels() const { return number(10); }
  std::uint32_t size() const { return number(14); }
  bool is_os2() const { return size() == 12; }
  std::int64_t width() const { return signed_number(18, 18); }
  /// Below 0: the first row is at the top.
  std::int64_t height() const { return signed_number(20, 22); }
  std::int64_t signed_number(std::size_t at_os2, std::size_t at) const {
    if (is_os2()) return number(at_os2, 2);
    return static_cast<std::int32_t>(number(at));
  }
  std::uint32_t bits() const { return is_os2() ? number(24, 2) : number(28, 2); }
  std::uint32_t compression() const { return is_os2() ? 0 : number(30); }
  std::uint64_t row() const { return (static_cast<std::uint64_t>(width()) * bits() + 31) / 32 * 4; }
};

void refuse_kinds(const std::filesystem::path& file, const BmpHeader& header) {
  const std::uint32_t compression = header.compression(), bits = header.bits();
  if (compression == 1 || compression == 2)
    cannot_read(file, "found a BMP whose rows are run-length encoded (RLE), expected one that is not compressed");
  if (compression != 0 && compression != 3)
    cannot_read(file, "found a BMP of compression " + std::to_string(compression) + ", expected none or bit fields");
  if (bits != 1 && bits != 4 && bits != 8 && bits != 16 && bits != 24 && bits != 32)
    cannot_read(file, "found a BMP of " + std::to_string(bits) + " bits a pixel, expected 1, 4, 8, 16, 24 or 32");
  if (compression == 3 && header.size() != 40 && header.size() < 108)
    cannot_read(file, "found a BMP with bit fields in a header of " + std::to_string(header.size()) +
                          " bytes, expected 40, 108 or 124");
  if (header.is_os2() && bits <= 8)
    cannot_read(file, "found a BMP of OS/2 with a palette, expected a header of 40 bytes or more");
}

/// Throws unless each pixel's number is one of the palette's.
void check_palette(const std::filesystem::path& file, const BmpHeader& header) {
  const std::uint32_t bits = header.bits(), mask = (1u << bits) - 1;
  const std::int64_t colours = (std::int64_t{header.pixels()} - 14 - header.size()) / 4;
  for (std::uint64_t y = 0, height = static_cast<std::uint64_t>(std::abs(header.height())); y < height; ++y)
    for (std::uint64_t x = 0; x < static_cast<std::uint64_t>(header.width()); ++x) {
      const std::uint64_t bit = x * bits, at = header.pixels() + y * header.row() + bit / 8;
      const std::uint32_t colour = header.bytes[at] >> (8 - bits - bit % 8) & mask;
      if (colour >= colours) fail_colour(file, colour, std::max<std::int64_t>(colours, 0));
    }
}

/// Whether a header says that its colours are sRGB's, or says nothing of them.
bool is_srgb(const BmpHeader& header) {
  if (header.size() < 108) return true;
  constexpr std::size_t kind_at = 70, primaries_at = 74, gamma_at = 110, profile_at = 126;
  constexpr std::uint32_t calibrated = 0, srgb = 0x73524742, windows = 0x57696e20, embedded = 0x4d424544;
  const std::uint32_t kind = header.number(kind_at);
  if (kind == srgb || kind == windows) return true;
  if (kind == embedded && header.size() >= 124) {
    const std::size_t start = std::size_t{14} + header.number(profile_at), size = header.number(profile_at + 4);
    return start <= header.bytes.size() && size <= header.bytes.size() - start &&
           is_srgb_profile(header.bytes.subspan(start, size));
  }
  if (kind != calibrated) return false;
  // Red, green and blue as x, y and z, with 30 bits behind the point; exponents with 16. Zeros say nothing.
  constexpr double primaries[] = {0.64, 0.33, 0.03, 0.30, 0.60, 0.10, 0.15, 0.06, 0.79};
  bool near = true, nothing = true;
  for (std::size_t i = 0; i < 9; ++i) {
    const std::uint32_t found = header.number(primaries_at + 4 * i);
    nothing = nothing && found == 0;
    near = near && (i % 3 == 2 || std::abs(found / 1073741824.0 - primaries[i]) <= 0.01);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double exponent = header.number(gamma_at + 4 * i) / 65536.0;
    near = near && (exponent == 0 || std::abs(exponent / 2.2 - 1) <= 0.05 || std::abs(exponent * 2.2 - 1) <= 0.05);
  }
  return near || nothing;
}

/// The header of a TGA, and what a file of version 2.0 says in its extension area.
/// Truevision TGA File Format Specification, version 2.0.
struct TgaHeader {
  std::span<const std::uint8_t> bytes;
  std::uint32_t number(std::size_t at, std::size_t size) const { return low_first(bytes, at, size); }
  bool has_palette() const { return bytes[1] == 1; }
  bool is_mapped() const { return (bytes[2] & 7) == 1; }
  bool has_runs() const { return bytes[2] >= 8; }
  std::uint32_t colours() const { return number(5, 2); }
  std::uint32_t width() const { return number(12, 2); }
  std::uint32_t height() const { return number(14, 2); }
  std::uint32_t pixel_size() const { return (bytes[16] + 7u) / 8; }
  std::uint64_t first_pixel() const {
    return kind_size + bytes[0] + (has_palette() ? std::uint64_t{colours()} * ((bytes[7] + 7u) / 8) : 0);
  }
};

/// Goes through all pixels, in runs where they are compressed so. Throws unless they are in the file, and each number
/// of a colour is one of the palette's.
void check_pixels(const std::filesystem::path& file, const TgaHeader& header) {
  std::uint64_t at = header.first_pixel(), left = std::uint64_t{header.width()} * header.height();
  const std::uint64_t size = header.pixel_size(), end = header.bytes.size();
  while (left > 0) {
    std::uint64_t count = left, stored = left;
    if (header.has_runs() && at < end) {
      const std::uint8_t code = header.bytes[at++];
      count = 1 + (code & 127u), stored = code >= 128 ? 1 : count;
    }
    if (at > end || stored * size > end - at) cannot_read(file, "damaged: the TGA ends in the middle");
    if (count > left) cannot_read(file, "damaged: a run of the TGA does not fit");
    for (std::uint64_t i = 0; header.is_mapped() && i < stored; ++i) {
      const std::uint32_t colour = header.number(at + i * size, size);
      if (colour >= header.colours()) fail_colour(file, colour, header.colours());
    }
    at += stored * size, left -= count;
  }
}

/// Tells what a file of version 2.0 says of its pixels, where it says anything that counts here.
void tell_extension(PictureFile& picture, const std::filesystem::path& file, const TgaHeader& header) {
  constexpr std::string_view mark("TRUEVISION-XFILE.\0", 18);
  constexpr std::size_t footer = 26, gamma_at = 478, attributes_at = 494;
  const std::size_t size = header.bytes.size();
  const std::string_view text(reinterpret_cast<const char*>(header.bytes.data()), size);
  if (size < footer || !text.ends_with(mark)) return;
  const std::size_t start = header.number(size - footer, 4);
  if (start == 0 || header.number(start, 2) <= attributes_at || start + attributes_at >= size) return;
  const double above = header.number(start + gamma_at, 2), below = header.number(start + gamma_at + 2, 2);
  if (below > 0 && std::abs(above / below / 2.2 - 1) > 0.05)
    add_remark(picture, file, "its gamma is not that of sRGB; its pixels are read as sRGB");
  constexpr std::uint32_t multiplied = 4;
  if (header.number(start + attributes_at, 1) == multiplied)
    add_remark(picture, file, "its colours are multiplied by their alpha, and are read as they stand");
}

/// Alpha that is 0 everywhere is what programs leave that know no alpha.
void drop_empty_alpha(Samples& samples) {
  if (samples.channels != 4) return;
  for (std::size_t at = 3; at < samples.bytes.size(); at += 4)
    if (samples.bytes[at] != 0) return;
  for (std::size_t at = 3; at < samples.bytes.size(); at += 4) samples.bytes[at] = 255;
}

}  // namespace

PictureFile read_bmp(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const BmpHeader header{bytes};
  refuse_kinds(file, header);
  const std::int64_t height = std::abs(header.height());
  check_readable(file, header.width(), height);
  const std::uint64_t last_row = (static_cast<std::uint64_t>(header.width()) * header.bits() + 7) / 8;
  check_enough(file, bytes.size(), header.pixels() + header.row() * static_cast<std::uint64_t>(height - 1) + last_row);
  if (header.bits() <= 8) check_palette(file, header);
  PictureFile picture = picture_of(decode_stb(file, bytes), srgb_curve);
  if (!is_srgb(header)) add_remark(picture, file, "its colour space is not sRGB; its pixels are read as sRGB");
  return picture;
}

PictureFile read_tga(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const TgaHeader header{bytes};
  if (header.has_palette() != header.is_mapped())
    cannot_read(file, "found a TGA with a palette that its pixels do not use");
  if ((header.bytes[17] & 0xc0) != 0)
    cannot_read(file, "found a TGA with interleaved rows, expected one row after the other");
  if (header.is_mapped() && header.number(3, 2) != 0)
    cannot_read(file, "found a TGA whose palette begins with colour " + std::to_string(header.number(3, 2)) +
                          ", expected colour 0");
  check_readable(file, header.width(), header.height());
  check_pixels(file, header);
  Samples samples = decode_stb(file, bytes);
  drop_empty_alpha(samples);
  PictureFile picture = picture_of(samples, srgb_curve);
  picture.image = oriented(std::move(picture.image), {false, (bytes[17] & 0x10) != 0, false});
  tell_extension(picture, file, header);
  return picture;
}

}  // namespace tyndall
