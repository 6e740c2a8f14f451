#include "core/image/image_io_file.h"

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <jpeglib.h>

#include <jerror.h>

namespace tyndall {
namespace {

/// More passes over the picture than any encoder makes: a small file could ask for so many that they take hours.
constexpr int max_scans = 200;

/// libjpeg's decoder. Its errors arrive as calls that must not return; they jump to where `stop` was set. Between that
/// place and the jump no object may live that has to be destroyed.
struct JpegDecoder {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr watch{};
  std::jmp_buf stop{};
  char problem[JMSG_LENGTH_MAX] = "";
  JOCTET* profile = nullptr;  ///< colour profile; null: none, or it cannot be read
  unsigned profile_size = 0;

  JpegDecoder() = default;
  ~JpegDecoder() {
    jpeg_destroy_decompress(&info);
    std::free(profile);
  }
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
  if (decoder.info.input_scan_number <= max_scans) return;
  std::snprintf(decoder.problem, sizeof decoder.problem, "more than %d passes over the picture", max_scans);
  std::longjmp(decoder.stop, 1);
}

constexpr int exif_marker = JPEG_APP0 + 1, profile_marker = JPEG_APP0 + 2;

/// Reads up to the first scan, and what the file says of its colours and its orientation. False: see `problem`.
bool read_jpeg_header(JpegDecoder& decoder, std::span<const std::uint8_t> bytes) {
  decoder.info.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = stop_decoding;
  decoder.errors.emit_message = judge_message;
  decoder.info.client_data = &decoder;
  if (setjmp(decoder.stop) != 0) return false;
  jpeg_create_decompress(&decoder.info);
  decoder.watch.progress_monitor = watch_scans;
  decoder.info.progress = &decoder.watch;
  jpeg_mem_src(&decoder.info, bytes.data(), static_cast<unsigned long>(bytes.size()));
  for (const int marker : {exif_marker, profile_marker}) jpeg_save_markers(&decoder.info, marker, 0xffff);
  jpeg_read_header(&decoder.info, TRUE);
  jpeg_read_icc_profile(&decoder.info, &decoder.profile, &decoder.profile_size);
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

/// The data of the first marker of this number that begins so; empty if there is none.
std::span<const std::uint8_t> marker_data(const jpeg_decompress_struct& info, int number, std::string_view beginning) {
  for (const jpeg_marker_struct* marker = info.marker_list; marker; marker = marker->next) {
    const std::span<const std::uint8_t> data(marker->data, marker->data_length);
    const std::string_view text(reinterpret_cast<const char*>(data.data()), data.size());
    if (marker->marker == number && text.starts_with(beginning)) return data.subspan(beginning.size());
  }
  return {};
}

}  // namespace

PictureFile read_jpeg(const std::filesystem::path& file, std::span<const std::uint8_t> bytes) {
  JpegDecoder decoder;
  if (!read_jpeg_header(decoder, bytes)) cannot_read(file, std::string("damaged: ") + decoder.problem);
  const jpeg_decompress_struct& info = decoder.info;
  if (info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK)
    cannot_read(file, "found a JPEG for printing (CMYK), expected RGB or grey");
  if (info.arith_code != 0) cannot_read(file, "found a JPEG with arithmetic coding, expected Huffman coding");
  check_readable(file, info.image_width, info.image_height);
  // The coarsest JPEG has one bit for each block of 8 x 8 pixels.
  check_enough(file, bytes.size(), std::uint64_t{info.image_width} * info.image_height / 512);
  // The markers are gone once the rows are read.
  const bool profile = !marker_data(info, profile_marker, "ICC_PROFILE").empty();
  const Orientation orientation = exif_orientation(marker_data(info, exif_marker, std::string_view("Exif\0\0", 6)));
  Samples samples{static_cast<int>(info.image_width), static_cast<int>(info.image_height), 3, 255, {}};
  samples.bytes.resize(std::size_t{3} * info.image_width * info.image_height);
  if (!read_jpeg_rows(decoder, samples.bytes.data())) cannot_read(file, std::string("damaged: ") + decoder.problem);
  PictureFile picture = picture_of(samples, srgb_curve);
  if (profile && !is_srgb_profile({decoder.profile, decoder.profile_size})) add_remark(picture, file, other_profile);
  picture.image = oriented(std::move(picture.image), orientation);
  return picture;
}

}  // namespace tyndall
