#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <random>

using namespace tyndall;

namespace {

const std::filesystem::path scenes = assets_folder() / "scenes";

/// Pieces that change what a file means more often than a random byte does.
constexpr const char* pieces[] = {"{",
                                  "}",
                                  "[",
                                  "]",
                                  ",",
                                  ":",
                                  "\"",
                                  "null",
                                  "true",
                                  "-",
                                  "0",
                                  "1e999",
                                  "1e-999",
                                  "-1e38",
                                  "4294967296",
                                  "\\u0000",
                                  "\\ud800",
                                  "\xff",
                                  "//",
                                  "/*",
                                  "*/",
                                  "\n",
                                  "\"type\"",
                                  "\"name\"",
                                  "\"sphere\"",
                                  "\"material\"",
                                  "1e308",
                                  "[[[[[[[[",
                                  "]]]]]]]]",
                                  "\"objects\": [",
                                  "{\"type\":\"group\",\"objects\":["};

void mutate(std::string& text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return n ? random() % n : 0; };
  const std::size_t at = below(text.size()), length = below(40);
  switch (below(6)) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, pieces[below(std::size(pieces))]);
      break;
    case 3:
      text.insert(at, text.substr(below(text.size()), length));
      break;
    case 4:
      text.replace(at, below(6), pieces[below(std::size(pieces))]);
      break;
    default:
      text.resize(at + 1);
  }
}

}  // namespace

TEST_CASE("read_scene: a scene file with random damage is a scene or one clear line, and nothing else") {
  std::vector<std::string> originals;
  for (const auto& file : json_files(scenes))
    if (std::string text = text_of(file); text.size() < 4000) originals.push_back(std::move(text));
  REQUIRE(originals.size() > 10);
  std::mt19937 random(20240607);
  int scenes_read = 0, errors = 0;
  for (int i = 0; i < 6000; ++i) {
    std::string text = originals[random() % originals.size()];
    for (auto k = 1 + random() % 3; k > 0 && !text.empty(); --k) mutate(text, random);
    try {
      const Scene scene = read_scene(text, "damaged.json", scenes);
      ++scenes_read;
      if (scenes_read % 8 == 0) CHECK(read_scene(write_scene(scene), "written", scenes) == scene);
    } catch (const SceneError& error) {
      ++errors;
      const std::string what = error.what();
      const bool clear =
          what.starts_with("damaged.json: ") && what.find(": found ") != what.npos &&
          what.find(", expected ") != what.npos && what.size() < 1500 &&
          std::none_of(what.begin(), what.end(), [](char c) { return (c >= 0 && c < 0x20) || c == 0x7f; });
      if (!clear) FAIL_CHECK(what);
    }
  }
  CHECK(scenes_read > 300);
  CHECK(errors > 3000);
}
