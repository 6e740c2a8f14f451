#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/whole_file.h"

#include <zlib.h>

#include <cassert>
#include <initializer_list>
#include <limits>
#include <new>
#include <string_view>

namespace tyndall {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::size_t signature_size = 8;
constexpr std::size_t header_end = signature_size + 12 + 13;  // the signature and the chunk IHDR

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
}

void put_u32(Bytes& to, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

void put_chunk(Bytes& to, std::string_view type, std::initializer_list<std::string_view> data) {
  std::size_t size = 0;
  for (const std::string_view part : data) size += part.size();
  to.reserve(to.size() + size + 12);
  put_u32(to, static_cast<std::uint32_t>(size));
  const std::size_t start = to.size();
  to.insert(to.end(), type.begin(), type.end());
  for (const std::string_view part : data) to.insert(to.end(), part.begin(), part.end());
  put_u32(to, checksum(std::span(to).subspan(start)));
}

/// Text as an iTXt chunk, not compressed, without language.
void put_text(Bytes& to, std::string_view keyword, const std::string& text) {
  if (text.empty()) return;
  // The zeros: end of the keyword, compression flag and method, empty language and translated keyword.
  put_chunk(to, "iTXt", {keyword, std::string_view("\0\0\0\0\0", 5), text});
}

/// A chunk of a PNG.
struct Chunk {
  std::string_view type;
  std::span<const std::uint8_t> checked, data;  ///< checked: type and data, of which the checksum is
  std::uint32_t checksum = 0;
};

/// The chunk that begins at `at`, which then is where the next one begins; nothing if the file ends within it.
std::optional<Chunk> take_chunk(std::span<const std::uint8_t> png, std::size_t& at) {
  if (png.size() - at < 12) return {};
  const std::size_t length = high_first(png, at, 4);
  if (length > png.size() - at - 12) return {};
  const auto checked = png.subspan(at + 4, length + 4);
  at += length + 12;
  return Chunk{
      {reinterpret_cast<const char*>(checked.data()), 4}, checked, checked.subspan(4), high_first(png, at - 4, 4)};
}

/// The text in the data of an iTXt chunk, if the chunk has that keyword.
std::optional<std::string> text_of(const std::filesystem::path& file, const Chunk& chunk, const std::string& keyword) {
  std::string_view data(reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size());
  if (!data.starts_with(keyword + '\0')) return {};
  if (checksum(chunk.checked) != chunk.checksum)
    cannot_read(file, "damaged: the checksum of the text " + keyword + " is wrong");
  data.remove_prefix(keyword.size() + 1);
  if (data.size() < 2) cannot_read(file, "damaged: the chunk iTXt is cut off");
  if (data[0] != 0) cannot_read(file, "the text " + keyword + " is compressed: another program has rewritten the file");
  data.remove_prefix(2);
  for (int i = 0; i < 2; ++i) {  // skips the language and the translated keyword
    const std::size_t end = data.find('\0');
    if (end == data.npos) cannot_read(file, "damaged: the chunk iTXt is cut off");
    data.remove_prefix(end + 1);
  }
  return std::string(data);
}

}  // namespace

Bytes png_bytes(const std::filesystem::path& name, const LinearImage& image, double exposure, ToneMap curve,
                const Embedded& embedded, std::optional<DitherOrigin> dither) {
  check_writable(name, image);
  const std::int64_t row = std::int64_t{3} * image.width;
  if ((row + 1) * image.height > std::numeric_limits<int>::max() / 2) cannot_write(name, "too many pixels for PNG");
  const Bytes rgb = tone_map(image.rgb, exposure, curve, image.width, dither);
  Bytes png = encode_png(image.width, image.height, rgb.data());
  if (png.size() < header_end) throw std::bad_alloc();
  Bytes extra;
  put_chunk(extra, "sRGB", {std::string_view("\0", 1)});  // rendering intent: perceptual
  put_text(extra, "tyndall:scene", embedded.scene);
  put_text(extra, "tyndall:stats", embedded.stats);
  put_text(extra, "tyndall:contents", embedded.label.contents);
  png.insert(png.begin() + header_end, extra.begin(), extra.end());
  return png;
}

void write_png(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               const Embedded& embedded, std::optional<DitherOrigin> dither) {
  const Bytes png = png_bytes(file, image, exposure, curve, embedded, dither);
  WholeFile out(file);
  out.write(std::as_bytes(std::span(png)));
  out.commit();
}

std::optional<std::span<const std::uint8_t>> png_chunk(std::span<const std::uint8_t> png, std::string_view type) {
  std::size_t at = signature_size;
  while (const auto chunk = take_chunk(png, at)) {
    if (chunk->type == type) return chunk->data;
    if (chunk->type == "IEND") break;
  }
  return {};
}

std::optional<std::string> png_text(const std::filesystem::path& file, std::span<const std::uint8_t> png,
                                    const std::string& keyword) {
  assert(image_kind(png) == ImageKind::png);
  std::size_t at = signature_size;
  while (const auto chunk = take_chunk(png, at)) {
    if (chunk->type == "IEND") return {};
    if (chunk->type != "iTXt") continue;
    if (auto text = text_of(file, *chunk, keyword)) return text;
  }
  cannot_read(file, "damaged: the PNG ends in the middle");
}

}  // namespace tyndall
