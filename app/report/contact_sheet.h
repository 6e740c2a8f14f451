#pragma once
#include "app/text/values.h"
#include "core/image/image.h"
#include "core/scene/settings.h"

#include <cstdint>
#include <string>
#include <vector>

/// Many pictures on one, with a line or two beneath each.
namespace tyndall {

/// A font file's path in the first folder that has it, of those of Debian, Arch, Fedora and the user; "" if none has.
std::string find_font(const std::string& file);

/// A picture as a screen shows it: 8-bit sRGB, 3 bytes a pixel, top row first.
struct ScreenPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct SheetPicture {
  ScreenPicture picture;
  std::string title;    ///< beneath it: "fuzz 0.18"
  std::string detail;   ///< beneath that, smaller: "+1.2 % ± 0.1 %"
  bool marked = false;  ///< has a frame
};

/// Pixels that a picture has on a sheet of `count` pictures in so many columns: large ones are made smaller, so that
/// the sheet stays below about 4,000 pixels, and very small ones larger by a whole factor.
Size sheet_cell(int width, int height, int columns);
/// The number of columns with which a sheet of such pictures is about as wide as a screen.
int sheet_columns(int width, int height, int count);

/// The picture in these pixels, as a screen shows it. Light is averaged where it is made smaller.
ScreenPicture on_sheet(const LinearImage& image, const Display& display, Size cell);

/// The pictures, which have one size, row by row. What they are called is written in a font of the system; in a plain
/// built-in one, of Latin letters and digits alone, where there is none.
ScreenPicture contact_sheet(const std::vector<SheetPicture>& pictures, int columns, const std::string& heading,
                            const std::string& note);

/// The picture as light, for the writers of files.
LinearImage light_of(const ScreenPicture& picture);

}  // namespace tyndall
