#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// JPEG files for tests of the reader.
namespace tyndall::test {

struct JpegKind {
  int channels = 3;  ///< 1: grey, 3: RGB, 4: CMYK
  bool progressive = false;
  bool arithmetic = false;
  bool untransformed = false;  ///< RGB as it is, which only the marker of Adobe says
  std::string exif{};          ///< a TIFF with EXIF; empty: none
  std::string profile{};       ///< colour profile (ICC); empty: none
};

/// A JPEG file's bytes. pixels: 8 bits a channel, row by row, top row first.
std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& pixels, JpegKind kind);

}  // namespace tyndall::test
