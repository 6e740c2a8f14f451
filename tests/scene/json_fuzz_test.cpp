#include "tests/scene/files.h"
#include "tests/scene/garbage.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <random>

namespace tyndall::test::json_fuzz_test {

namespace {

const std::filesystem::path scenes = assets_folder() / "scenes";

}  // namespace

TEST_CASE("read_scene: a scene file with random damage is a scene or one clear line, and nothing else") {
  std::vector<std::string> originals;
  for (const auto& file : json_files(scenes))
    if (std::string text = test::read_text(file); text.size() < 4000) originals.push_back(std::move(text));
  REQUIRE(originals.size() > 10);
  std::mt19937 random(20240607);
  int scenes_read = 0, errors = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::string text = test::damaged(originals[random() % originals.size()], random);
    try {
      const Scene scene = read_scene(text, "damaged.json", scenes);
      ++scenes_read;
      if (scenes_read % 8 == 0) CHECK(read_scene(write_scene(scene), "written", scenes) == scene);
    } catch (const SceneError& error) {
      ++errors;
      const std::string what = error.what();
      if (!test::is_clear(what)) FAIL_CHECK(what);
    }
  }
  CHECK(scenes_read > 300);
  CHECK(errors > 3000);
}

}  // namespace tyndall::test::json_fuzz_test
