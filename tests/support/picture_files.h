#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// PNG files for tests of the reader, put together chunk by chunk, and JPEG files.
namespace tyndall::test {

/// A number of 4 bytes, highest byte first, as chunks hold them.
std::string big_endian(std::uint32_t value);

/// A chunk as it stands in a file: length, type, data, checksum.
std::string png_chunk_bytes(std::string_view type, std::string_view data);

/// What the header of a PNG says.
struct PngForm {
  std::uint32_t width = 1, height = 1;
  int bits = 8, colour_type = 2;  ///< 0: grey, 2: RGB, 3: palette, 4: grey and alpha, 6: RGBA
  bool interlaced = false;
};
/// A PNG file's bytes. rows: each a byte 0 (no filter) and its pixels. chunks: what stands between header and pixels.
std::string png_bytes(const PngForm& form, std::string_view rows, std::string_view chunks = "");

/// A colour profile: its header and tags with these primaries, times 10,000, and one curve for all channels, as the
/// data of its tag. grey: a profile of greys, which has the curve alone.
std::string icc_bytes(const int (&primaries)[9], const std::string& curve, bool grey = false);
/// Primaries and a curve (formula 3) of sRGB.
inline constexpr int srgb_primaries[9] = {4360, 2225, 139, 3851, 7169, 971, 1431, 606, 7139};
std::string srgb_icc_curve();
/// The chunk iCCP that holds a profile.
std::string iccp_chunk(const std::string& profile);

struct JpegKind {
  int channels = 3;  ///< 1: grey, 3: RGB, 4: CMYK
  bool progressive = false;
  bool arithmetic = false;
  bool untransformed = false;  ///< RGB as it is, which only the marker of Adobe says
  std::string exif{};          ///< a TIFF with EXIF; empty: none
  std::string profile{};       ///< colour profile (ICC); empty: none
};

/// A JPEG file's bytes. pixels: 8 bits a channel, row by row, top row first.
std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& pixels, JpegKind kind);

}  // namespace tyndall::test
