#pragma once
#include "core/image/image.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

/// What the readers and writers of image files share: whole files, kinds of files, limits and errors.
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

/// The number in the first 4 of these bytes, highest byte first.
std::uint32_t get_u32(std::span<const std::uint8_t> from);
/// Throws unless every chunk of a PNG up to its last one ends within the file.
void check_png(const std::filesystem::path& file, std::span<const std::uint8_t> png);
/// The data of a PNG's first chunk of that type; nothing if it has none. The PNG must have passed check_png().
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
/// Where the pixels begin after a header in text, whose last word ends at `end`: behind one character of white space,
/// or two where a program wrote CR LF and the file is long enough for it. pixels: how many bytes the pixels have.
std::size_t pixels_after(std::span<const std::uint8_t> bytes, std::size_t end, std::size_t pixels);
/// Throws unless nothing but white space follows a picture: a further picture or bytes that nobody asked for mean that
/// the file is not what its header says. after: what follows; magic: how a further picture would begin.
void check_end(const std::filesystem::path& file, std::span<const std::uint8_t> after, std::string_view magic);
void check_writable(const std::filesystem::path& file, std::int64_t width, std::int64_t height);
void check_writable(const std::filesystem::path& file, const LinearImage& image);

}  // namespace tyndall
