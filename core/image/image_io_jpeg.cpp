#include "core/image/image_io_file.h"

#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include <jerror.h>

namespace tyndall {

namespace {

/// More passes over the picture than any encoder makes: a small file could ask for so many that they take hours.
constexpr int most_scans = 200;

/// libjpeg's decoder. Its errors arrive as calls that must not return; they jump to where `stop` was set. Between that
/// place and the jump no object may live that has to be destroyed.
struct JpegDecoder {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr watch{};
  std::jmp_buf stop{};
  char problem[JMSG_LENGTH_MAX] = "";

  JpegDecoder() = default;
  ~JpegDecoder() { jpeg_destroy_decompress(&info); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
};

[[noreturn]] void stop_decoding(j_common_ptr info) {
  auto& decoder = *static_cast<JpegDecoder*>(info->client_data);
  info->err->format_message(info, decoder.problem);
  std::longjmp(decoder.stop, 1);
}

/// Called for remarks and warnings. Those about pixels that are lost or wrong end the decoding.
void judge_message(j_common_ptr info, int level) {
  const int code = info->err->msg_code;
  const bool lost = code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE || code == JWRN_JPEG_EOF ||
                    code == JWRN_MUST_RESYNC || code == JWRN_NOT_SEQUENTIAL;
  if (level < 0 && lost) stop_decoding(info);
}

void watch_scans(j_common_ptr info) {
  auto& decoder = *static_cast<JpegDecoder*>(info->client_data);
  if (decoder.info.input_scan_number <= most_scans) return;
  std::snprintf(decoder.problem, sizeof decoder.problem, "more than %d passes over the picture", most_scans);
  std::longjmp(decoder.stop, 1);
}

/// Reads up to the first scan. False: see `problem`.
bool read_jpeg_header(JpegDecoder& decoder, std::span<const std::uint8_t> bytes) {
  decoder.info.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = stop_decoding;
  decoder.errors.emit_message = judge_message;
  decoder.info.client_data = &decoder;
  if (setjmp(decoder.stop) != 0) return false;
  jpeg_create_decompress(&decoder.info);
  decoder.watch.progress_monitor = watch_scans;
  decoder.info.progress = &decoder.watch;
  jpeg_mem_src(&decoder.info, bytes.data(), bytes.size());
  jpeg_read_header(&decoder.info, TRUE);
  return true;
}

/// Reads all rows into rgb, which has room for them. False: see `problem`.
bool read_jpeg_rows(JpegDecoder& decoder, std::uint8_t* rgb) {
  jpeg_decompress_struct& info = decoder.info;
  if (setjmp(decoder.stop) != 0) return false;
  info.out_color_space = JCS_RGB;
  jpeg_start_decompress(&info);
  while (info.output_scanline < info.output_height) {
    JSAMPROW row = rgb + std::size_t{3} * info.output_width * info.output_scanline;
    jpeg_read_scanlines(&info, &row, 1);
  }
  jpeg_finish_decompress(&info);
  return true;
}

}  // namespace

Rgb8Image read_jpeg(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  JpegDecoder decoder;
  const auto damaged = [&] { cannot_read(file, std::string("damaged: ") + decoder.problem); };
  if (!read_jpeg_header(decoder, bytes)) damaged();
  const jpeg_decompress_struct& info = decoder.info;
  if (info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK)
    cannot_read(file, "found a JPEG for printing (CMYK), expected RGB or grey");
  if (info.arith_code != 0) cannot_read(file, "found a JPEG with arithmetic coding, expected Huffman coding");
  check_readable(file, info.image_width, info.image_height);
  // The coarsest JPEG has one bit for each block of 8 x 8 pixels.
  check_enough(file, bytes.size(), std::uint64_t{info.image_width} * info.image_height / 512);
  Rgb8Image image{static_cast<int>(info.image_width), static_cast<int>(info.image_height), {}};
  image.rgb.resize(std::size_t{3} * info.image_width * info.image_height);
  if (!read_jpeg_rows(decoder, image.rgb.data())) damaged();
  return image;
}

}  // namespace tyndall
