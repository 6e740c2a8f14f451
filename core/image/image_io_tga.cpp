#include "core/image/image_io_file.h"

#include <cmath>
#include <string_view>

namespace tyndall {
namespace {

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
  bool from_right() const { return (bytes[17] & 0x10) != 0; }
  std::uint64_t pixels() const { return std::uint64_t{width()} * height(); }
  std::uint64_t first_pixel() const {
    return kind_size + bytes[0] + (has_palette() ? std::uint64_t{colours()} * ((bytes[7] + 7u) / 8) : 0);
  }
};

void refuse_kinds(const std::filesystem::path& file, const TgaHeader& header) {
  if (header.has_palette() != header.is_mapped())
    cannot_read(file, "found a TGA with a palette that its pixels do not use");
  if ((header.bytes[17] & 0xc0) != 0)
    cannot_read(file, "found a TGA with interleaved rows, expected one row after the other");
  if (header.is_mapped() && header.number(3, 2) != 0)
    cannot_read(file, "found a TGA whose palette begins with colour " + std::to_string(header.number(3, 2)) +
                          ", expected colour 0");
}

/// Goes through all pixels, in runs where they are compressed so. Throws unless they are in the file, and each number
/// of a colour is one of the palette's.
void check_pixels(const std::filesystem::path& file, const TgaHeader& header) {
  std::uint64_t at = header.first_pixel(), left = header.pixels();
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
      if (colour >= header.colours())
        cannot_read(file, "damaged: found colour " + std::to_string(colour) + ", expected one of the palette's " +
                              std::to_string(header.colours()));
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

PictureFile read_tga(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  const TgaHeader header{bytes};
  refuse_kinds(file, header);
  check_readable(file, header.width(), header.height());
  check_pixels(file, header);
  Samples samples = decode_stb(file, bytes);
  drop_empty_alpha(samples);
  PictureFile picture = picture_of(samples, srgb_curve);
  picture.image = oriented(std::move(picture.image), {false, header.from_right(), false});
  tell_extension(picture, file, header);
  return picture;
}

}  // namespace tyndall
