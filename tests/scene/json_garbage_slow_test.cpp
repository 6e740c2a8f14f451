#include "core/compile/compile.h"
#include "core/render/render.h"
#include "tests/scene/files.h"
#include "tests/scene/garbage.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

namespace tyndall::test::json_garbage_slow_test {

TEST_CASE("garbage: 200,000 scene files with random damage; what is read renders, and all else is one clear line") {
  const std::filesystem::path scenes = assets_folder() / "scenes";
  std::vector<std::string> originals;
  for (const auto& file : json_files(scenes))
    if (std::string text = test::read_text(file); text.size() < 4000) originals.push_back(std::move(text));
  RenderOptions options;
  options.threads = 1;
  options.isa = "scalar";
  options.spp = 1;
  options.region = Region{0, 0, 1, 1};
  std::mt19937 random(20261122);
  int read = 0, rendered = 0, unclear = 0;
  for (int i = 0; i < 200'000; ++i) {
    try {
      Scene scene = read_scene(test::damaged(originals[random() % originals.size()], random), "damaged.json", scenes);
      if (++read % 8 != 0) continue;
      scene.render.max_depth = std::min(scene.render.max_depth, 20);
      rendered += render(*prepare(scene), options).film.pixels[0].taken == 1;
    } catch (const SceneError& error) {
      unclear += !test::is_clear(error.what());
    }
  }
  MESSAGE(read, " of 200000 were read, ", rendered, " of them rendered");
  CHECK(rendered == read / 8);
  CHECK(read > 10'000);
  CHECK(unclear == 0);
}

}  // namespace tyndall::test::json_garbage_slow_test
