#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// Text in pictures.
namespace tyndall {

/// A font file's path in the first folder that has it, of those of Debian, Arch, Fedora and the user; "" if none has.
std::string find_font(const std::string& file);
/// The code of the character at a byte of a UTF-8 text, and the place of the next one; 0xfffd for what is broken.
unsigned next_character(const std::string& text, std::size_t& at);

/// A picture as a screen shows it: 8-bit sRGB, 3 bytes a pixel, top row first.
struct ScreenPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

using SheetColour = std::array<std::uint8_t, 3>;

/// A font of the system in one size; a plain built-in one, of Latin letters and digits alone, where there is none.
class Lettering {
 public:
  /// height: of a line, pixels.
  explicit Lettering(int height);
  ~Lettering();
  Lettering(const Lettering&) = delete;
  Lettering& operator=(const Lettering&) = delete;

  /// Pixels that the text takes in a row.
  int width_of(const std::string& text) const;
  /// The text, or its beginning and "…", in at most that many pixels.
  std::string fitted(const std::string& text, int width) const;
  /// Writes with the upper left corner at (x, y). What lies outside of the picture is left out.
  void write(ScreenPicture& picture, int x, int y, const std::string& text, SheetColour colour) const;

 private:
  struct Font;
  int height_;
  std::unique_ptr<Font> font_;  ///< null: the built-in one
};

}  // namespace tyndall
