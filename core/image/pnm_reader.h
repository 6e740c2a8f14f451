#pragma once
#include "core/image/image.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The grammar of PNM pictures (PPM and PGM): the one for whole files and for pictures that come by a pipe, row by row.
/// It is in image_io_pnm.cpp.
namespace tyndall {

/// What the header of a PNM says.
struct PnmHeader {
  char kind = '6';  ///< the digit of the mark: P2 and P3 are text, P5 and P6 bytes; P2 and P5 are grey
  std::int64_t width = 0, height = 0;
  unsigned largest = 255;  ///< stands for 1; above 255 a number has two bytes, the higher one first
  bool is_text() const { return kind <= '3'; }
  std::size_t channels() const { return kind == '3' || kind == '6' ? 3 : 1; }
  std::size_t numbers() const { return channels() * static_cast<std::size_t>(width * height); }
  std::size_t number_size() const { return largest > 255 ? 2 : 1; }
};

/// Reads one picture of the kinds P2, P3, P5 or P6 as its bytes come, in pieces that are cut anywhere. Numbers are
/// separated by any white space and by remarks, which go from # to the end of the line. Netpbm, ppm(5) and pgm(5).
class PnmReader {
 public:
  /// name: what messages call the picture; curve: how numbers stand for light; has_all: take() gets all bytes that
  /// there are. Their number decides whether a line feed after a header that ends in CR is the first pixel's; else it
  /// is not.
  explicit PnmReader(std::filesystem::path name, PpmCurve curve = PpmCurve::srgb, bool has_all = false);

  /// Takes the next bytes. Appends the light of the numbers in them to `rgb`, 3 floats a pixel, top row first; the last
  /// pixel may lack some of its three. Returns how many bytes it took: fewer than it was given where something other
  /// than white space follows the picture, and, if header_only, where the pixels begin. Throws ImageFileError for what
  /// is no such picture or damaged.
  std::size_t take(std::span<const std::uint8_t> bytes, std::vector<float>& rgb, bool header_only = false);
  /// No bytes follow, which ends the last number.
  void end(std::vector<float>& rgb);

  /// Null until all of it has come.
  const PnmHeader* header() const { return part_ > Part::largest ? &header_ : nullptr; }
  /// Whether the numbers of all pixels have come.
  bool whole() const { return part_ == Part::end; }
  /// What should come next, for messages: "the width", …
  const char* expected() const;
  /// Of numbers outside of 0 to the largest one, which are read as the nearest that is within: how many they are, and
  /// where the first one is. Nothing: there is none.
  std::optional<std::string> remark() const;

 private:
  /// gap: the one character between a header and the bytes of pixels, before which a remark may stand; line_feed: what
  /// may follow if that is a CR.
  enum class Part { mark, width, height, largest, gap, line_feed, pixels, end };
  /// A number that has begun.
  struct Digits {
    std::string text;        ///< the beginning of what was found
    std::int64_t value = 0;  ///< without its sign; at most 10^17
    bool negative = false, any = false, damaged = false;
  };

  void take_pixel_byte(std::uint8_t byte, std::vector<float>& rgb);
  bool take_character(char c);
  void take_mark(char c);
  void take_digit(char c);
  [[noreturn]] void fail_number() const;
  void take_header_number(std::int64_t number);
  void put(std::int64_t number, std::vector<float>& rgb);

  std::filesystem::path name_;
  double power_;  ///< see light_table
  bool has_all_;
  Part part_ = Part::mark;
  PnmHeader header_;
  std::string mark_;
  bool in_remark_ = false;
  Digits digits_;
  std::optional<std::uint8_t> high_byte_;  ///< of a number whose second byte has not come yet
  std::vector<float> light_;               ///< of each number
  std::size_t taken_ = 0;                  ///< numbers of pixels
  std::size_t outside_ = 0, first_outside_ = 0;
  std::int64_t first_value_ = 0;
};

}  // namespace tyndall
