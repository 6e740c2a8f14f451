#pragma once
#include "app/check/book_paths.h"
#include "core/image/image.h"

#include <string>
#include <vector>

/// The numbers of a picture file, and the light that they stand for by one way of reading them or another.
namespace tyndall {

/// How numbers of a file stand for light. light: they are light, without limits (floating-point files).
enum class TransferCurve { light, srgb, power22, gamma2, none, gamma2_twice };

/// One way to read a picture. The first members are what programs choose, the others mistakes.
struct Reading {
  TransferCurve curve = TransferCurve::srgb;
  bool upside_down = false, mirrored = false;  ///< the first row is at the bottom; the first column at the right
  bool swapped = false;                        ///< red and blue have changed places
  bool operator==(const Reading&) const = default;
};

/// Whether the reading holds no mistake.
bool is_right(const Reading& reading);
/// The readings that are tried for a picture, the right ones first.
std::vector<Reading> readings_of(bool coded);
/// "gamma 2", "sRGB's curve", ... of a right curve; "": nothing has to be said of it.
std::string curve_text(TransferCurve curve);

/// The pixels of a file before they are read as light.
struct PictureNumbers {
  int width = 0, height = 0;
  /// 3 a pixel, top row first. coded: in [0, 1], in the middle of the interval that the file's number stands for.
  std::vector<float> numbers;
  bool coded = true;        ///< numbers stand for light by a curve, and end at white
  float step = 1 / 256.0f;  ///< how far the numbers may be off by themselves: 8 bits, compression
};

PictureNumbers numbers_of(const PictureFile& picture);

/// Light at the pixels of a lattice, 3 floats a pixel.
struct ReadPixels {
  std::vector<float> light;
  std::vector<float> tolerance;  ///< by how much the light may be off because of PictureNumbers::step
};
ReadPixels read_pixels(const PictureNumbers& picture, const Lattice& lattice, const Reading& reading);

}  // namespace tyndall
