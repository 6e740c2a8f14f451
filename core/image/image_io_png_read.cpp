// PNG files are read by libpng, which refuses what their checksums call damaged. It gets no chunk but those that pixels
// are made of and the colour profile, which is compressed; the small ones that say what pixels mean are read here, so
// that no version of libpng passes one over.
#include "core/image/image_io_file.h"

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace tyndall {
namespace {

/// libpng's decoder. Its errors arrive as calls that must not return; they jump to where `stop` was set. Between that
/// place and the jump no object may live that has to be destroyed.
struct PngDecoder {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::span<const std::uint8_t> left;  ///< bytes that were not read yet
  std::jmp_buf stop{};
  char problem[128] = "libpng cannot be used";
  bool out_of_memory = false;
  int passes = 1;  ///< over the rows: more where these are interlaced

  PngDecoder() = default;
  ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
};

void on_error(png_structp png, png_const_charp problem) {
  auto& decoder = *static_cast<PngDecoder*>(png_get_error_ptr(png));
  std::snprintf(decoder.problem, sizeof decoder.problem, "%s", problem);
  std::longjmp(decoder.stop, 1);
}

/// The checksum behind the compressed pixels is the only one that libpng merely warns of.
void on_warning(png_structp png, png_const_charp problem) {
  if (std::strstr(problem, "incorrect data check")) on_error(png, problem);
}

void* take_memory(png_structp png, png_alloc_size_t size) {
  void* memory = std::malloc(size);
  if (!memory) static_cast<PngDecoder*>(png_get_mem_ptr(png))->out_of_memory = true;
  return memory;
}

void take_bytes(png_structp png, png_bytep to, std::size_t size) {
  auto& decoder = *static_cast<PngDecoder*>(png_get_io_ptr(png));
  if (size > decoder.left.size()) png_error(png, "the PNG ends in the middle");
  std::memcpy(to, decoder.left.data(), size);
  decoder.left = decoder.left.subspan(size);
}

/// Reads up to the pixels, which become RGB or RGBA of 8 or 16 bits. False: see `problem`.
bool read_png_header(PngDecoder& decoder) {
  if (setjmp(decoder.stop) != 0) return false;
  decoder.png =
      png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &decoder, on_error, on_warning, &decoder, take_memory, nullptr);
  if (decoder.png) decoder.info = png_create_info_struct(decoder.png);
  if (!decoder.info) return false;
  constexpr png_alloc_size_t usual_chunk = 4'000'000;
  const png_alloc_size_t size = decoder.left.size();
  png_set_user_limits(decoder.png, max_image_pixels, max_image_pixels);
  png_set_chunk_malloc_max(decoder.png, size < usual_chunk ? usual_chunk : size);
  png_set_crc_action(decoder.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_keep_unknown_chunks(decoder.png, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("iCCP"), 1);
  png_set_read_fn(decoder.png, &decoder, take_bytes);
  png_read_info(decoder.png, decoder.info);
  png_set_expand(decoder.png);
  png_set_gray_to_rgb(decoder.png);
  decoder.passes = png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  return true;
}

/// Reads all rows, and what follows them, so that all checksums are looked at. False: see `problem`.
bool read_png_rows(PngDecoder& decoder, Samples& samples) {
  if (setjmp(decoder.stop) != 0) return false;
  const std::size_t row = samples.bytes.size() / static_cast<std::size_t>(samples.height);
  for (int pass = 0; pass < decoder.passes; ++pass)
    for (std::size_t at = 0; at < samples.bytes.size(); at += row)
      png_read_row(decoder.png, samples.bytes.data() + at, nullptr);
  png_read_end(decoder.png, nullptr);
  return true;
}

/// The fewest bytes that a PNG of this size can have: Deflate shrinks at most 1032 times.
std::uint64_t min_png_bytes(std::span<const std::uint8_t> png) {
  constexpr std::uint64_t channels_of[8] = {1, 1, 3, 1, 2, 1, 4, 1};  // by colour type
  const std::uint64_t bits = png[24] * channels_of[png[25] & 7u];
  return (1 + high_first(png, 16, 4) * bits / 8) * high_first(png, 20, 4) / 1032;
}

Samples read_samples(const std::filesystem::path& file, PngDecoder& decoder) {
  const auto fail = [&] {
    if (decoder.out_of_memory) throw std::bad_alloc();
    cannot_read(file, std::string("damaged: ") + decoder.problem);
  };
  if (!read_png_header(decoder)) fail();
  Samples samples;
  samples.width = static_cast<int>(png_get_image_width(decoder.png, decoder.info));
  samples.height = static_cast<int>(png_get_image_height(decoder.png, decoder.info));
  samples.channels = png_get_channels(decoder.png, decoder.info);
  samples.largest = png_get_bit_depth(decoder.png, decoder.info) == 16 ? 65535 : 255;
  samples.bytes.resize(png_get_rowbytes(decoder.png, decoder.info) * static_cast<std::size_t>(samples.height));
  if (!read_png_rows(decoder, samples)) fail();
  return samples;
}

/// What a PNG says of its colours.
struct PngColour {
  const std::filesystem::path& file;
  std::span<const std::uint8_t> png;
  std::vector<const char*> remarks;

  /// The data of a chunk, which has `size` bytes where it is there.
  std::optional<std::span<const std::uint8_t>> chunk(const char* type, std::size_t size) {
    const auto data = png_chunk(png, type);
    if (data && data->size() != size)
      cannot_read(file, "damaged: found " + std::to_string(data->size()) + " bytes in the chunk " + type +
                            ", expected " + std::to_string(size));
    return data;
  }

  /// cICP names primaries, curve, matrix and range by the numbers of ITU-T H.273.
  double power_of_code_points(std::span<const std::uint8_t> code) {
    constexpr std::uint8_t bt709 = 1, gamma_22 = 4, linear = 8, srgb = 13;
    const std::uint8_t curve = code[1];
    const bool video = curve == 1 || curve == 6 || curve == 14 || curve == 15;  // frames of ordinary videos
    if ((!video && curve != gamma_22 && curve != linear && curve != srgb) || code[2] != 0 || code[3] != 1) {
      std::string found = "found the colours (cICP) ";
      for (std::size_t i = 0; i < 4; ++i) found += (i > 0 ? "/" : "") + std::to_string(code[i]);
      cannot_read(file, found + ", expected 1/13/0/1, which is sRGB, 1/4/0/1 or 1/8/0/1");
    }
    if (code[0] != bt709)
      remarks.push_back("its primaries (cICP) are not those of sRGB; its pixels are read as sRGB's");
    if (video) remarks.push_back("its curve (cICP) is that of videos; its pixels are read by that of sRGB");
    return curve == linear ? 1 : srgb_curve;
  }

  /// cHRM: white, red, green and blue as x and y, times 100,000. Without it they are sRGB's.
  void look_at_primaries() {
    constexpr int srgb[8] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
    const auto primaries = chunk("cHRM", 32);
    for (std::size_t i = 0; primaries && i < 8; ++i) {
      if (std::abs(static_cast<double>(high_first(*primaries, 4 * i, 4)) - srgb[i]) <= 1000) continue;
      remarks.push_back("its primaries (cHRM) are not those of sRGB; its pixels are read as sRGB's");
      return;
    }
  }

  /// gAMA: the exponent that made numbers of light, times 100,000.
  double power_of_gamma() {
    const auto gamma = chunk("gAMA", 4);
    if (!gamma) return srgb_curve;
    const std::uint32_t exponent = high_first(*gamma, 0, 4);
    if (exponent == 0) cannot_read(file, "found the exponent (gAMA) 0, expected a number above 0");
    return power_of_exponent(exponent / 1e5);
  }

  /// The power that makes light of numbers. The chunks go before each other in this order.
  double power(PngDecoder& decoder) {
    if (const auto code = chunk("cICP", 4)) return power_of_code_points(*code);
    if (png_chunk(png, "sRGB")) return srgb_curve;
    if (png_chunk(png, "iCCP")) {
      png_charp name = nullptr;
      png_bytep profile = nullptr;
      int method = 0;
      png_uint_32 size = 0;
      png_get_iCCP(decoder.png, decoder.info, &name, &method, &profile, &size);
      if (!is_srgb_profile({profile, size})) remarks.push_back(other_profile);
      return srgb_curve;
    }
    look_at_primaries();
    return power_of_gamma();
  }
};

}  // namespace

PictureFile read_png(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  // What the header asks for is believed only where the file is long enough for it.
  if (bytes.size() >= 26) {
    check_readable(file, high_first(bytes, 16, 4), high_first(bytes, 20, 4));
    check_enough(file, bytes.size(), min_png_bytes(bytes));
  }
  if (!png_chunk(bytes, "IEND")) cannot_read(file, "damaged: the PNG ends in the middle");
  PngDecoder decoder;
  decoder.left = bytes;
  const Samples samples = read_samples(file, decoder);
  PngColour colour{file, bytes, {}};
  PictureFile picture = picture_of(samples, colour.power(decoder));
  for (const char* remark : colour.remarks) add_remark(picture, file, remark);
  if (png_chunk(bytes, "acTL")) add_remark(picture, file, "it is animated (acTL); its still picture is read");
  if (const auto exif = png_chunk(bytes, "eXIf"))
    picture.image = oriented(std::move(picture.image), exif_orientation(*exif));
  return picture;
}

}  // namespace tyndall
