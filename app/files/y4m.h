#pragma once
#include "core/image/image.h"
#include "core/scene/settings.h"
#include "core/system/open_file.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Films as encoders read them: uncompressed frames one after the other (YUV4MPEG2), 8 bits, 4:4:4, BT.601 with the
/// limited range of video. The format has no field for the matrix; FFmpeg takes BT.601 where nothing is said.
namespace tyndall {

struct Y4mFormat {
  int width = 0, height = 0;
  int rate = 24, rate_divisor = 1;  ///< frames per rate_divisor seconds
  std::string mark;                 ///< 16 hexadecimal digits: what the film is of; a film of another mark is no part
};

/// A film that grows by whole frames. What a killed program has left of a frame is cut off, and the film goes on.
class Y4mFile {
 public:
  /// file: "-" is standard output. A file that holds frames of this format and mark is gone on with. Throws UsageError
  /// for any other file unless `fresh`, which replaces it; IoError where it cannot be written.
  Y4mFile(const std::filesystem::path& file, const Y4mFormat& format, bool fresh);

  /// Whole frames that it has.
  int frames() const { return frames_; }
  /// Adds a picture of that size. Throws IoError; what was written of the frame is taken away again.
  void add(const LinearImage& image, const Display& display);

 private:
  int cut_off() const;
  void check(int error) const;
  void write(const std::string& bytes);

  std::filesystem::path file_;
  bool stream_;
  std::string header_;
  std::uint64_t frame_bytes_;
  OpenFile bytes_;
  int frames_ = 0;
};

/// The three planes Y', Cb and Cr of pixels in 8 bits each, 3 bytes a pixel. R'G'B' to Y'CbCr: ITU-R BT.601,
/// section 2.5.
std::vector<std::uint8_t> ycbcr_planes(const std::vector<std::uint8_t>& rgb);

}  // namespace tyndall
