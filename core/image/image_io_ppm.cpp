#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/picture_file.h"
#include "core/image/pnm_reader.h"
#include "core/image/whole_file.h"

namespace tyndall {

void write_ppm(const std::filesystem::path& file, const LinearImage& image, double exposure, ToneMap curve,
               PpmCurve ppm, std::optional<DitherOrigin> dither) {
  check_writable(file, image);
  const std::string header = "P6\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n255\n";
  WholeFile out(file);
  out.write(std::span(reinterpret_cast<const std::uint8_t*>(header.data()), header.size()));
  if (ppm == PpmCurve::gamma2)
    out.write(gamma2_bytes(image.rgb, exposure, curve));
  else
    out.write(dither ? tone_map_dithered(image.rgb, exposure, curve, image.width, *dither)
                     : tone_map(image.rgb, exposure, curve));
  out.commit();
}

namespace {

/// Believes the size that a header says only where the file is long enough for it. left: bytes behind the header.
void check_length(const std::filesystem::path& file, const PnmHeader& header, std::size_t left) {
  const std::size_t needed = header.is_text() ? 2 * header.numbers() : 1 + header.numbers() * header.number_size();
  if (left < needed)
    cannot_read(file, "damaged: found " + std::to_string(left) + " bytes behind the header, expected at least " +
                          std::to_string(needed) + " for " + std::to_string(header.width) + " x " +
                          std::to_string(header.height) + " pixels");
}

}  // namespace

PictureFile read_ppm(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, PpmCurve curve) {
  PnmReader reader(file, curve, bytes.size());
  PictureFile picture;
  std::vector<float>& rgb = picture.image.rgb;
  std::size_t at = reader.take(bytes, rgb, true);
  if (!reader.header()) reader.end(rgb);
  const std::string ends = std::string("damaged: the file ends where ") + reader.expected() + " is expected";
  if (!reader.header()) cannot_read(file, ends);
  const PnmHeader& header = *reader.header();
  check_length(file, header, bytes.size() - at);
  picture.image.width = static_cast<int>(header.width), picture.image.height = static_cast<int>(header.height);
  picture.bits = header.largest > 255 ? 16 : 8;
  rgb.reserve(std::size_t{3} * static_cast<std::size_t>(header.width * header.height));
  at += reader.take(bytes.subspan(at), rgb);
  reader.end(rgb);
  if (!reader.whole())
    cannot_read(file, header.is_text() ? "damaged: the file ends where a colour is expected"
                                       : "damaged: the PPM ends in the middle");
  check_end(file, bytes.subspan(at), header.is_text() ? "P" : std::string("P") + header.kind);
  if (const auto remark = reader.remark()) add_remark(picture, file, *remark);
  return picture;
}

}  // namespace tyndall
