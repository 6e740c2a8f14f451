#include "app/files/y4m.h"

#include "core/base/error.h"
#include "core/image/file_place.h"
#include "core/image/tonemap.h"

#include <sys/stat.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

namespace tyndall {
namespace {

constexpr std::string_view frame_header = "FRAME\n";

[[noreturn]] void cannot_write(const std::filesystem::path& file) {
  throw IoError((file == "-" ? "standard output" : file.string()) + ": cannot write: " + std::strerror(errno));
}

std::vector<std::uint8_t> screen_bytes(const LinearImage& image, const Display& display) {
  if (!display.dither) return tone_map(image.rgb, display.exposure, display.tone_map);
  return tone_map_dithered(image.rgb, display.exposure, display.tone_map, image.width, {});
}

}  // namespace

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

/// Readers such as FFmpeg's allow at most 95 bytes. Programs pass over the matrix; films of another one are not gone on
/// with.
std::string Y4mFile::header() const {
  return "YUV4MPEG2 W" + std::to_string(format_.width) + " H" + std::to_string(format_.height) + " F" +
         std::to_string(format_.rate) + ":" + std::to_string(format_.rate_divisor) +
         " Ip A1:1 C444 XCOLORRANGE=LIMITED XBT601 X" + format_.mark + "\n";
}

Y4mFile::Y4mFile(const std::filesystem::path& file, const Y4mFormat& format, bool fresh)
    : file_(file), format_(format), stream_(file == "-" || is_stream(file)) {
  if (file == "-") {
    descriptor_ = dup(STDOUT_FILENO);
  } else if (stream_) {
    descriptor_ = open(file.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    open_file(fresh);
  }
  if (descriptor_ < 0) cannot_write(file_);
  if (frames_ > 0) return;
  const std::string text = header();
  write({text.begin(), text.end()});
}

Y4mFile::~Y4mFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::uint64_t Y4mFile::end_of(int frames) const {
  const std::uint64_t planes =
      std::uint64_t{3} * static_cast<unsigned>(format_.width) * static_cast<unsigned>(format_.height);
  return header().size() + static_cast<unsigned>(frames) * (frame_header.size() + planes);
}

void Y4mFile::open_file(bool fresh) {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return;
  const std::string expected = header();
  std::string found(expected.size(), '\0');
  const ssize_t got = pread(descriptor_, found.data(), found.size(), 0);
  if (got < 0) cannot_write(file_);
  found.resize(static_cast<std::size_t>(got));
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) cannot_write(file_);
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (!fresh && !expected.starts_with(found))
    throw UsageError(file_.string() + ": found " +
                     (found.starts_with("YUV4MPEG2 ") ? "a film of another scene, other settings or another version"
                                                      : "a file that is no film of this command") +
                     ", expected one to go on with; --fresh replaces it");
  if (!fresh && found == expected) frames_ = static_cast<int>((size - end_of(0)) / (end_of(1) - end_of(0)));
  const std::uint64_t end = frames_ > 0 ? end_of(frames_) : 0;
  if (ftruncate(descriptor_, static_cast<off_t>(end)) != 0) cannot_write(file_);
  if (lseek(descriptor_, static_cast<off_t>(end), SEEK_SET) < 0) cannot_write(file_);
}

void Y4mFile::write(const std::vector<std::uint8_t>& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t put = ::write(descriptor_, bytes.data() + at, bytes.size() - at);
    if (put < 0 && errno == EINTR) continue;
    if (put > 0) {
      at += static_cast<std::size_t>(put);
      continue;
    }
    const int why = errno;
    const auto end = static_cast<off_t>(frames_ > 0 ? end_of(frames_) : 0);
    if (!stream_ && ftruncate(descriptor_, end) == 0) lseek(descriptor_, end, SEEK_SET);
    errno = why;
    cannot_write(file_);
  }
}

void Y4mFile::add(const LinearImage& image, const Display& display) {
  std::vector<std::uint8_t> bytes(frame_header.begin(), frame_header.end());
  const std::vector<std::uint8_t> planes = ycbcr_planes(screen_bytes(image, display));
  bytes.insert(bytes.end(), planes.begin(), planes.end());
  write(bytes);
  if (!stream_ && fdatasync(descriptor_) != 0) cannot_write(file_);
  ++frames_;
}

}  // namespace tyndall
