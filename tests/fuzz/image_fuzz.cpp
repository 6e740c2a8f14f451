// Images of all formats, by their first bytes: PNG, PPM, JPEG, PFM, HDR, EXR, BMP, TGA.
#include "core/image/image_io.h"
#include "tests/fuzz/fuzz_input.h"

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile file(data, size);
  fuzz::survives<ImageFileError>([&] {
    const LinearImage image = read_image(file.path());
    if (image.rgb.size() != 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
      std::abort();
  });
  fuzz::survives<ImageFileError>([&] { read_image(file.path().string() + ":a"); });  // a layer, where it has one
  fuzz::survives<ImageFileError>([&] { read_texture(file.path()); });
  fuzz::survives<ImageFileError>([&] { read_embedded_scene(file.path()); });
  return 0;
}
