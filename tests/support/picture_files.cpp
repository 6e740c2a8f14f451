#include "tests/support/picture_files.h"

#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <jpeglib.h>

namespace tyndall::test {

namespace {

std::string deflated(std::string_view data) {
  const auto length = static_cast<uLong>(data.size());
  uLongf size = compressBound(length);
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()), length);
  out.resize(size);
  return out;
}

std::string fixed(double value) {
  return big_endian(static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(65536 * value))));
}

}  // namespace

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

std::string png_chunk_bytes(std::string_view type, std::string_view data) {
  const std::string content = std::string(type) + std::string(data);
  const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + content +
         big_endian(static_cast<std::uint32_t>(checksum));
}

std::string png_bytes(const PngForm& form, std::string_view rows, std::string_view chunks) {
  const std::string header = big_endian(form.width) + big_endian(form.height) + static_cast<char>(form.bits) +
                             static_cast<char>(form.colour_type) + std::string(2, '\0') +
                             static_cast<char>(form.interlaced);
  return "\x89PNG\r\n\x1a\n" + png_chunk_bytes("IHDR", header) + std::string(chunks) +
         png_chunk_bytes("IDAT", deflated(rows)) + png_chunk_bytes("IEND", "");
}

std::string icc_bytes(const int (&primaries)[9], const std::string& curve, bool grey) {
  const std::string names[] = {"wtpt", grey ? "kTRC" : "rTRC", "gTRC", "bTRC", "rXYZ", "gXYZ", "bXYZ"};
  const std::uint32_t count = grey ? 2 : 7, start = 132 + 12 * count;
  std::string data = "XYZ " + std::string(4, '\0') + fixed(0.9642) + fixed(1) + fixed(0.8249);
  std::string tags = big_endian(count);
  for (std::uint32_t tag = 0; tag < count; ++tag) {
    std::string content = data.substr(0, 20);
    if (tag >= 1) content = curve;
    if (tag >= 4) {
      content = "XYZ " + std::string(4, '\0');
      for (std::uint32_t i = 0; i < 3; ++i) content += fixed(primaries[3 * (tag - 4) + i] / 10000.0);
    }
    content.resize((content.size() + 3) / 4 * 4);
    const std::uint32_t at = tag == 0 ? 0 : static_cast<std::uint32_t>(data.size());
    if (tag > 0) data += content;
    tags += names[tag] + big_endian(start + at) + big_endian(static_cast<std::uint32_t>(content.size()));
  }
  std::string header(128, '\0');
  header.replace(0, 4, big_endian(static_cast<std::uint32_t>(start + data.size())));
  header.replace(8, 4, std::string("\x02\x40\0\0", 4));
  header.replace(12, 12, grey ? "mntrGRAYXYZ " : "mntrRGB XYZ ");
  header.replace(36, 4, "acsp");
  header.replace(68, 12, fixed(0.9642) + fixed(1) + fixed(0.8249));  // white D50
  return header + tags + data;
}

std::string srgb_icc_curve() {
  std::string curve = "para" + std::string(4, '\0') + std::string("\0\3\0\0", 4);
  for (const double number : {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045}) curve += fixed(number);
  return curve;
}

std::string iccp_chunk(const std::string& profile) {
  return png_chunk_bytes("iCCP", std::string("own\0\0", 5) + deflated(profile));
}

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
