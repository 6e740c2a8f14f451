#include "app/files/y4m.h"

#include "app/cli/pictures.h"
#include "core/base/error.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tyndall::test::y4m_test {
namespace fs = std::filesystem;

const Y4mFormat format{3, 2, 24, 1, "0123456789abcdef"};
const LinearImage white{3, 2, std::vector<float>(18, 1.0f)}, black{3, 2, std::vector<float>(18, 0.0f)};

TEST_CASE("y4m: colours in the limited range of BT.601") {
  // ITU-R BT.601, table 2: white, black, red, green, blue in 8 bits.
  CHECK(ycbcr_planes({255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255}) ==
        std::vector<std::uint8_t>{235, 16, 81, 145, 41, 128, 128, 90, 54, 240, 128, 128, 240, 34, 110});
}

TEST_CASE("y4m: a film goes on where it ended, and what is left of a frame is cut off") {
  const fs::path file = scratch_folder("y4m") / "film.y4m";
  Y4mFile(file, format, false).add(white, {});
  const std::string one = read_text(file);
  CHECK(one.starts_with("YUV4MPEG2 W3 H2 F24:1 Ip A1:1 C444 "));
  CHECK(one.find('\n') < 85);  // FFmpeg reads up to 95, with 5 digits for width and height, and 30000:1001 for the rate
  std::ofstream(file, std::ios::binary | std::ios::app) << "FRAME\nabc";
  {
    Y4mFile film(file, format, false);
    CHECK(film.frames() == 1);
    CHECK(read_text(file) == one);
    film.add(black, {});
  }
  CHECK(Y4mFile(file, format, false).frames() == 2);
  CHECK(read_text(file).size() == one.size() + 6 + 18);
  CHECK(Y4mFile(file, format, true).frames() == 0);
  std::string before = one;  // as version 0.2.0 wrote it, in BT.709
  before.erase(before.find(" XBT601"), 7);
  write_text(file, before);
  CHECK_THROWS_AS(Y4mFile(file, format, false), UsageError);
}

TEST_CASE("y4m: a header that was cut off is begun anew; any other file is refused and left as it is") {
  const fs::path file = scratch_folder("y4m") / "other.y4m";
  write_text(file, "YUV4MPEG2 W3 H");
  CHECK(Y4mFile(file, format, false).frames() == 0);
  Y4mFile(file, format, false).add(white, {});
  const std::string before = read_text(file);
  for (const Y4mFormat& other : {Y4mFormat{3, 2, 24, 1, "0123456789abcdee"}, Y4mFormat{4, 2, 24, 1, format.mark}})
    CHECK_THROWS_AS(Y4mFile(file, other, false), UsageError);
  CHECK(read_text(file) == before);
  write_text(file, "a text that somebody needs");
  CHECK_THROWS_AS(Y4mFile(file, format, false), UsageError);
  CHECK(read_text(file) == "a text that somebody needs");
}

TEST_CASE("frame list: the last line of a frame counts, and one that was cut off is passed over") {
  const fs::path file = scratch_folder("y4m") / "frames.ppm.list";
  CHECK(read_frame_list(file).entries.empty());
  add_frame(file, 3, "begun 0123456789abcdef");
  add_frame(file, 4, "whole 0123456789abcdef");
  std::ofstream(file, std::ios::app) << "3 whole 01234";
  CHECK(read_frame_list(file).entries.at(3) == "begun 0123456789abcdef");
  add_frame(file, 3, "whole fedcba9876543210");
  const FrameList again = read_frame_list(file);
  CHECK(again.entries.at(3) == "whole fedcba9876543210");
  CHECK(again.entries.at(4) == "whole 0123456789abcdef");
}

}  // namespace tyndall::test::y4m_test
