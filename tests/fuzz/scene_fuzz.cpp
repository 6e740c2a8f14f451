// Scene files: what is read can be written, and reads again as the same scene.
#include "core/scene/load.h"
#include "tests/fuzz/fuzz_input.h"

using namespace tyndall;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::survives<SceneError>([&] {
    const Scene scene = read_scene(fuzz::text_of(data, size), "fuzz", "/nowhere");
    if (!(read_scene(write_scene(scene), "again", "/nowhere") == scene)) std::abort();
  });
  return 0;
}
