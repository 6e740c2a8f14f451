// The measures of compare, on images of any finite or other values: the input is a width and floats.
#include "core/accuracy/error.h"
#include "tests/fuzz/fuzz_input.h"

#include <cstring>
#include <vector>

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::size_t width = 1 + data[0] % 16, row = 3 * width, floats = (size - 1) / sizeof(float) / 2;
  const std::size_t height = floats / row;
  if (height == 0) return 0;
  std::vector<float> a(row * height), b(row * height);
  std::memcpy(a.data(), data + 1, a.size() * sizeof(float));
  std::memcpy(b.data(), data + 1 + a.size() * sizeof(float), b.size() * sizeof(float));
  image_error(a, b);
  for (const float value : flip_map(a, b, static_cast<int>(width), static_cast<int>(height)))
    if (value < 0 || value > 1.001f) std::abort();
  return 0;
}
