#include "core/image/image_io_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tyndall {
namespace {

/// The header of a BMP. Microsoft: Windows GDI, BITMAPFILEHEADER to BITMAPV5HEADER. stb reads most of it by itself;
/// what it would misread is refused here, and all that pixels take must be in the file.
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
      if (colour >= colours)
        cannot_read(file, "damaged: found colour " + std::to_string(colour) + ", expected one of the palette's " +
                              std::to_string(std::max<std::int64_t>(colours, 0)));
    }
}

BmpHeader checked_header(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const BmpHeader header{bytes};
  refuse_kinds(file, header);
  const std::int64_t height = std::abs(header.height());
  check_readable(file, header.width(), height);
  const std::uint64_t last_row = (static_cast<std::uint64_t>(header.width()) * header.bits() + 7) / 8;
  check_enough(file, bytes.size(), header.pixels() + header.row() * static_cast<std::uint64_t>(height - 1) + last_row);
  if (header.bits() <= 8) check_palette(file, header);
  return header;
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

}  // namespace

PictureFile read_bmp(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const BmpHeader header = checked_header(file, bytes);
  PictureFile picture = picture_of(decode_stb(file, bytes), srgb_curve);
  if (!is_srgb(header)) add_remark(picture, file, "its colour space is not sRGB; its pixels are read as sRGB");
  return picture;
}

}  // namespace tyndall
