#include "app/files/y4m.h"

#include "core/base/error.h"
#include "core/image/tonemap.h"
#include "core/image/whole_file.h"

#include <fmt/core.h>

#include <cmath>

namespace tyndall {

static constexpr std::string_view frame_header = "FRAME\n";

std::vector<std::uint8_t> ycbcr_planes(const std::vector<std::uint8_t>& rgb) {
  constexpr double red = 0.299, green = 0.587, blue = 0.114;
  const std::size_t pixels = rgb.size() / 3;
  std::vector<std::uint8_t> planes(3 * pixels);
  const auto rounded = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  for (std::size_t i = 0; i < pixels; ++i) {
    const double r = rgb[3 * i] / 255.0, g = rgb[3 * i + 1] / 255.0, b = rgb[3 * i + 2] / 255.0;
    const double luma = red * r + green * g + blue * b;
    planes[i] = rounded(16 + 219 * luma);
    planes[pixels + i] = rounded(128 + 224 * (b - luma) / (2 * (1 - blue)));
    planes[2 * pixels + i] = rounded(128 + 224 * (r - luma) / (2 * (1 - red)));
  }
  return planes;
}

Y4mFile::Y4mFile(const std::filesystem::path& file, const Y4mFormat& format, bool fresh)
    : file_(file),
      stream_(is_stream(file)),
      // Readers such as FFmpeg's allow at most 95 bytes. Programs pass over the matrix; films of another one are not
      // gone on with.
      header_(fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C444 XCOLORRANGE=LIMITED XBT601 X{}\n", format.width,
                          format.height, format.rate, format.rate_divisor, format.mark)),
      frame_bytes_(frame_header.size() +
                   std::uint64_t{3} * static_cast<unsigned>(format.width) * static_cast<unsigned>(format.height)),
      bytes_(file == "-" ? OpenFile(standard_output) : OpenFile(file, stream_ ? OpenFor::writing : OpenFor::changing)) {
  check(bytes_.error());
  if (stream_) {
    write(header_);
    return;
  }
  std::string found(header_.size(), '\0');
  std::size_t got = 0;
  std::uint64_t size = 0;
  check(bytes_.read(found.data(), found.size(), got));
  check(bytes_.size(size));
  found.resize(got);
  if (!fresh && !header_.starts_with(found))
    throw UsageError(file_.string() + ": found " +
                     (found.starts_with("YUV4MPEG2 ") ? "a film of another scene, other settings or another version"
                                                      : "a file that is no film of this command") +
                     ", expected one to go on with; --fresh replaces it");
  if (!fresh && found == header_) frames_ = static_cast<int>((size - header_.size()) / frame_bytes_);
  check(cut_off());
  if (frames_ == 0) write(header_);
}

void Y4mFile::check(int error) const {
  if (error != 0)
    throw IoError((file_ == "-" ? "standard output" : file_.string()) + ": cannot write: " + error_text(error));
}

/// Leaves the whole frames, and goes on behind them.
int Y4mFile::cut_off() const {
  const std::uint64_t end = frames_ > 0 ? header_.size() + static_cast<unsigned>(frames_) * frame_bytes_ : 0;
  const int problem = bytes_.truncate(end);
  return problem != 0 ? problem : bytes_.seek(end);
}

void Y4mFile::write(const std::string& bytes) {
  const int problem = bytes_.write(bytes.data(), bytes.size());
  if (problem != 0 && !stream_) cut_off();
  check(problem);
}

void Y4mFile::add(const LinearImage& image, const Display& display) {
  const auto dither = display.dither ? std::optional(DitherOrigin{}) : std::nullopt;
  const std::vector<std::uint8_t> planes =
      ycbcr_planes(tone_map(image.rgb, display.exposure, display.tone_map, image.width, dither));
  write(std::string(frame_header) + std::string(planes.begin(), planes.end()));
  if (!stream_) check(bytes_.synchronise());
  ++frames_;
}

}  // namespace tyndall
