#pragma once
#include "core/image/image.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// What the readers and writers of image files share: whole files, kinds of files, limits and errors; how a file's
/// numbers stand for light, and where its rows and columns lie.
namespace tyndall {

/// Images of more pixels are neither read nor written.
inline constexpr std::int64_t max_image_pixels = std::int64_t{1} << 28;

/// White space in the headers that are text.
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Throws ImageFileError "FILE: cannot read: WHY" or "FILE: cannot write: WHY".
[[noreturn]] void cannot_read(const std::filesystem::path& file, const std::string& why);
[[noreturn]] void cannot_write(const std::filesystem::path& file, const std::string& why);

/// Closes a file that was read at the end of a scope.
struct Closer {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using ReadStream = std::unique_ptr<std::FILE, Closer>;

/// The longest file that is read into memory: stb counts bytes in an int.
inline constexpr std::size_t max_file_size = 0x7fffffff;
/// The first `limit` bytes of a file, or all if it is shorter.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file, std::size_t limit);
/// A whole file; refuses longer ones than max_file_size.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file);

/// As many bytes as image_kind() looks at.
inline constexpr std::size_t kind_size = 18;
/// The kind of an image file, by its first bytes.
ImageKind image_kind(std::span<const std::uint8_t> start);

// Readers by kind, from a file's bytes. What is damaged is refused, not guessed.
PictureFile read_pfm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
PictureFile read_hdr(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
/// layer: what the user asks for; none: the picture of the first part that has colour.
LinearImage read_exr(const std::filesystem::path& file, const std::optional<std::string>& layer);
PictureFile read_png(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
PictureFile read_ppm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, PpmCurve curve);
PictureFile read_bmp(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
PictureFile read_tga(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);
/// RGB or grey, also progressive.
PictureFile read_jpeg(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

// Encoders by kind: whole files. All throw std::bad_alloc.
std::vector<std::uint8_t> encode_png(int width, int height, const std::uint8_t* rgb);
std::vector<std::uint8_t> encode_hdr(int width, int height, const float* rgb);

/// The data of a PNG's first chunk of that type; nothing if it has none before its end or that of the file.
std::optional<std::span<const std::uint8_t>> png_chunk(std::span<const std::uint8_t> png, std::string_view type);
/// The text with that keyword in a PNG's iTXt chunks.
std::optional<std::string> png_text(const std::filesystem::path& file, std::span<const std::uint8_t> png,
                                    const std::string& keyword);
/// The string attribute with that name in an EXR's header.
std::optional<std::string> exr_text(const std::filesystem::path& file, const std::string& name);

/// Throws for an image without pixels or with more than max_image_pixels.
void check_readable(const std::filesystem::path& file, std::int64_t width, std::int64_t height);
/// Throws if a file of `size` bytes is too short for what its header promises, which takes at least `minimum` bytes
/// even if it is compressed as far as its format can. So a small file cannot ask for much memory.
void check_enough(const std::filesystem::path& file, std::uint64_t size, std::uint64_t minimum);
void check_writable(const std::filesystem::path& file, std::int64_t width, std::int64_t height);
void check_writable(const std::filesystem::path& file, const LinearImage& image);

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

/// The number in `size` of the bytes from `at` on, highest byte first; 0 beyond the end.
std::uint32_t high_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size);
/// The same, lowest byte first; bytes beyond the end count as 0.
std::uint32_t low_first(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size);

/// The pixels of a BMP or TGA, by stb. Its header has been checked: its size is believed, and all pixels are in the
/// file. 4 channels where the file has alpha, else 3.
Samples decode_stb(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// What a remark says of a profile that is not sRGB's.
inline constexpr const char* other_profile =
    "its colour profile (ICC) is not that of sRGB; its pixels are read as sRGB";

}  // namespace tyndall
