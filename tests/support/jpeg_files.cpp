#include "tests/support/jpeg_files.h"

#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace tyndall::test {

std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& pixels, JpegKind kind) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = static_cast<JDIMENSION>(width);
  info.image_height = static_cast<JDIMENSION>(height);
  info.input_components = kind.channels;
  info.in_color_space = kind.channels == 1 ? JCS_GRAYSCALE : kind.channels == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  if (kind.untransformed) jpeg_set_colorspace(&info, JCS_RGB);
  info.arith_code = kind.arithmetic ? TRUE : FALSE;
  if (kind.progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  const auto bytes_of = [](const std::string& text) { return reinterpret_cast<const JOCTET*>(text.data()); };
  const std::string exif = std::string("Exif\0\0", 6) + kind.exif;
  if (!kind.exif.empty()) jpeg_write_marker(&info, JPEG_APP0 + 1, bytes_of(exif), static_cast<unsigned>(exif.size()));
  if (!kind.profile.empty())
    jpeg_write_icc_profile(&info, bytes_of(kind.profile), static_cast<unsigned>(kind.profile.size()));
  while (info.next_scanline < info.image_height) {
    const std::size_t row =
        std::size_t{info.next_scanline} * info.image_width * static_cast<std::size_t>(info.input_components);
    JSAMPROW pointer = const_cast<JSAMPROW>(pixels.data() + row);
    jpeg_write_scanlines(&info, &pointer, 1);
  }
  jpeg_finish_compress(&info);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&info);
  std::free(bytes);
  return file;
}

}  // namespace tyndall::test
