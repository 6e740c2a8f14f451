// node tyndall_headless.js ASSETS ISA WIDTH HEIGHT SPP THREADS SCENE...: renders built-in scenes without a window, for
// tests of the build for browsers. Prints a line for each: its name, the hash of its picture, and millions of rays a
// second.
#include "core/base/fnv1a.h"
#include "core/files/film_files.h"
#include "core/render/render.h"
#include "core/scene/load.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) try {
  using namespace tyndall;
  setenv("TYNDALL_ASSETS", argv[1], 1);  // node hands on no environment
  for (int k = 7; k < argc; ++k) {
    LoadedScene loaded = load_scene(argv[k]);
    loaded.scene.width = std::atoi(argv[3]), loaded.scene.height = std::atoi(argv[4]);
    const auto prepared = prepare(loaded.scene);
    const RenderResult result =
        render(*prepared,
               {.threads = std::atoi(argv[6]), .isa = argv[2], .spp = static_cast<std::uint32_t>(std::atoi(argv[5]))});
    const FinishedPicture picture = finished_picture(*prepared, result);
    std::printf("%s %s %.3f\n", argv[k], hash_text(picture.hash).c_str(),
                1e-6 * static_cast<double>(result.rays) / result.seconds);
  }
} catch (const std::exception& error) {
  std::printf("error: %s\n", error.what());
  return 1;
}
