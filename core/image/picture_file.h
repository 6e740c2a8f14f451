#pragma once
#include "core/image/image.h"

#include <filesystem>
#include <span>
#include <vector>

/// What the readers of picture files share: how a file's numbers stand for light, and where its rows and columns lie.
namespace tyndall {

/// Stands for sRGB's curve in place of a power.
inline constexpr double srgb_curve = 0;
/// The power that makes light of a file's numbers, by the exponent of the curve that made the numbers of light (PNG's
/// gAMA): sRGB's curve within 5 % of 1 / 2.2, for which it is a usual name, else 1 / exponent.
double power_of_exponent(double exponent);

/// The light, in [0, 1], of each number from 0 to `largest`: (number / largest)^power, or by sRGB's curve.
std::vector<float> light_table(unsigned largest, double power);

/// Samples of `channels` numbers a pixel, of which the first three are red, green and blue.
struct Samples {
  int width = 0, height = 0;
  std::size_t channels = 3;
  unsigned largest = 255;           ///< stands for 1; above 255 a number has two bytes, the higher one first
  std::vector<std::uint8_t> bytes;  ///< top row first; not above `largest`
};
/// The picture of these samples. Their fourth channel, where there is one, is alpha: it only sets `has_alpha`.
PictureFile picture_of(const Samples& samples, double power);

/// Adds "FILE: TEXT" to what should be told.
void add_remark(PictureFile& picture, const std::filesystem::path& file, const std::string& text);

/// How a file's rows lie in the picture. As it stands here: from the top, each from the left.
struct Orientation {
  bool columns = false;      ///< the file's rows are the picture's columns
  bool from_right = false;   ///< the rows begin at the right; with `columns`, the first column is at the right
  bool from_bottom = false;  ///< the first row is at the bottom; with `columns`, the columns begin there
  bool operator==(const Orientation&) const = default;
};
/// The picture that a file's rows make. stored: the rows, as they follow each other in the file.
LinearImage oriented(LinearImage stored, const Orientation& orientation);

/// The orientation in EXIF data, which begin with the header of a TIFF; what cannot be read says nothing.
/// CIPA DC-008 (Exif 2.32), tag 0x0112.
Orientation exif_orientation(std::span<const std::uint8_t> tiff);

/// Whether an ICC profile describes sRGB: its primaries within 0.003 in XYZ, its curves within 0.012, so that a plain
/// 2.2 passes; of a grey profile the curve. A profile that has only tables or is damaged is none.
/// ISO 15076-1 (ICC.1:2010), sections 7.2, 9.2 and 10.
bool is_srgb_profile(std::span<const std::uint8_t> profile);

/// The number in `size` of the bytes from `at` on, lowest byte first; bytes beyond the end count as 0.
std::uint32_t low_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size);

/// The pixels of a BMP or TGA, by stb. Its header has been checked: its size is believed, and all pixels are in the
/// file. 4 channels where the file has alpha, else 3.
Samples decode_stb(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// What a remark says of a profile that is not sRGB's.
inline constexpr const char* other_profile =
    "its colour profile (ICC) is not that of sRGB; its pixels are read as sRGB";

}  // namespace tyndall
