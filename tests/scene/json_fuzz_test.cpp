#include "tests/scene/files.h"
#include "tests/support/paths.h"
#include "tests/support/prepared.h"
#include "tests/support/thorough.h"

#include <doctest/doctest.h>

#include <random>
#include <sstream>

namespace tyndall::test::json_fuzz_test {
namespace {

const std::filesystem::path scenes = assets_folder() / "scenes";

/// Pieces that change what a file means more often than a random byte does.
std::vector<std::string> make_pieces() {
  std::istringstream words(R"({ } [ ] , : " null true - 0 1e999 1e-999 -1e38 4294967296 1e308 \u0000 \ud800 // /* */
    "type" "name" "sphere" "material" [[[[[[[[ ]]]]]]]] "objects":[ {"type":"group","objects":[)");
  std::vector<std::string> pieces{"\n", "\xff"};
  for (std::string word; words >> word;) pieces.push_back(word);
  return pieces;
}

void mutate(std::string& text, std::mt19937& random) {
  static const std::vector<std::string> pieces = make_pieces();
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
      text.insert(at, pieces[below(pieces.size())]);
      break;
    case 3:
      text.insert(at, text.substr(below(text.size()), length));
      break;
    case 4:
      text.replace(at, below(6), pieces[below(pieces.size())]);
      break;
    default:
      text.resize(at + 1);
  }
}

/// One to three changes.
std::string damaged(std::string text, std::mt19937& random) {
  for (auto k = 1 + random() % 3; k > 0 && !text.empty(); --k) mutate(text, random);
  return text;
}

/// Whether a message is one line that says what was found and what is expected.
bool is_clear(const std::string& what) {
  return what.starts_with("damaged.json: ") && what.find(": found ") != what.npos &&
         what.find(", expected ") != what.npos && what.size() < 1500 &&
         std::none_of(what.begin(), what.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

/// Whether a scene renders: one sample of its first pixel.
bool renders(Scene scene) {
  scene.render.max_depth = std::min(scene.render.max_depth, 20);
  const RenderOptions options{.threads = 1, .isa = "scalar", .region = Region{0, 0, 1, 1}, .spp = 1};
  return render(*prepare(scene), options).film.pixels[0].taken == 1;
}

}  // namespace

TEST_CASE("read_scene: a file with random damage is one clear line, or a scene that is written, read and rendered") {
  std::vector<std::string> originals;
  for (const auto& file : json_files(scenes))
    if (std::string text = test::read_text(file); text.size() < 4000) originals.push_back(std::move(text));
  REQUIRE(originals.size() > 10);
  std::mt19937 random(20240607);
  int read = 0, errors = 0;
  const int tries = thorough() ? 200'000 : 6000;
  for (int i = 0; i < tries; ++i) {
    const std::string text = damaged(originals[random() % originals.size()], random);
    try {
      const Scene scene = read_scene(text, "damaged.json", scenes);
      if (++read % 8 != 0) continue;
      CHECK(read_scene(write_scene(scene), "written", scenes) == scene);
      if (thorough()) CHECK(renders(scene));
    } catch (const SceneError& error) {
      ++errors;
      if (!is_clear(error.what())) FAIL_CHECK(error.what());
    }
  }
  MESSAGE(read, " of ", tries, " were read");
  CHECK(read > tries / 20);
  CHECK(errors > tries / 2);
}

}  // namespace tyndall::test::json_fuzz_test
