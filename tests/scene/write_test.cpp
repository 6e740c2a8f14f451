#include "core/scene/json_tree.h"
#include "tests/scene/files.h"
#include "tests/scene/random_scene.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <limits>

namespace tyndall::test::write_test {

namespace {

const std::filesystem::path scenes = assets_folder() / "scenes";

}  // namespace

TEST_CASE("write_scene: the normal form") {
  const std::string text = R"({
  "tyndall": 1,
  "name": "A \"name\"",
  "image": { "width": 600, "height": 300 },
  "camera": {
    "look_from": [278.5, 278, -800],
    "look_at": [278, 278, 0],
    "vup": [0, 2, 0],
    "vfov": 40,
    "defocus_angle": 0.1,
    "focus_distance": 10,
    "shutter": [0, 0.5]
  },
  "background": { "type": "gradient", "bottom": [1, 1, 1], "top": [0.5, 0.7, 1] },
  "render": { "max_depth": 50, "spp": 200, "fresnel": "schlick", "seed": 7, "adaptive": true },
  "display": { "exposure": -1.5, "tone_map": "aces" },
  "textures": {
    "tiles": { "type": "checker", "scale": 0.32, "even": [0.2, 0.3, 0.1], "odd": [0.9, 0.9, 0.9] },
    "marble": { "type": "noise", "scale": 4, "style": "turbulence" }
  },
  "materials": {
    "white": { "type": "lambertian", "albedo": "tiles" },
    "gold": { "type": "metal", "albedo": [0.8, 0.6, 0.2], "fuzz": 0.3 },
    "glass": { "type": "dielectric", "refractive_index": 1.5 },
    "lamp": { "type": "light", "radiance": [7, 7, 7] }
  },
  "objects": [
    { "name": "ball", "type": "sphere", "center": [4, 1, 0], "center_end": [4, 1.5, 0], "radius": 0.2, "material": "gold" },
    {
      "name": "a block whose description does not fit on a line",
      "type": "box",
      "min": [0, 0, 0],
      "max": [165, 330, 165],
      "material": "white",
      "transform": [{ "rotate_y": 15 }, { "translate": [265, 0, 295] }]
    },
    { "type": "medium", "boundary": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "density": 0.01, "albedo": "marble", "g": 0.5 },
    {
      "type": "group",
      "transform": [{ "rotate_y": 15 }],
      "objects": [
        { "type": "quad", "corner": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0], "material": "lamp" },
        { "type": "group", "objects": [] }
      ]
    }
  ]
}
)";
  CHECK(write_scene(parsed(text)) == text);
}

TEST_CASE("write_scene: defaults are left out") {
  CHECK(write_scene(Scene()) ==
        "{\n  \"tyndall\": 1,\n  \"image\": { \"width\": 800, \"height\": 450 },\n  \"objects\": []\n}\n");
}

TEST_CASE("write_scene: the built-in scenes come back equal, and then the same to the letter") {
  const auto files = json_files(scenes);
  CHECK(files.size() >= 18);
  for (const auto& file : files) {
    CAPTURE(file);
    const Scene scene = read_scene(test::read_text(file), file.filename().string(), scenes);
    const std::string text = write_scene(scene);
    const Scene again = read_scene(text, "written", scenes);
    CHECK(again == scene);
    CHECK(write_scene(again) == text);
  }
}

TEST_CASE("write_scene: random scenes come back equal") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const Scene scene = random_scene(seed);
    const ParseError none;
    const ParseError error = check(scene).value_or(none);
    REQUIRE(error.where + error.found == "");
    const std::string text = write_scene(scene);
    const Scene again = parsed(text);
    CHECK(again == scene);
    CHECK(write_scene(again) == text);
  }
}

TEST_CASE("printed members: in their order, counts with all digits, null for what is no number") {
  JsonObject json;
  put(json, "name", "a \"b\"");
  put(json, "count", std::uint64_t{100000000000});
  put(json, "ratio", 0.25);
  put(json, "unknown", std::numeric_limits<double>::infinity());
  put(json, "nothing", std::optional<double>());
  put(json, "yes", true);
  put(json, "words", std::vector<std::string>{"a", "b"});
  put(json, "long", std::vector<int>(60, 12));
  const std::string text = print_members(json);
  CHECK(text.substr(0, text.find("\"long\"")) == R"({
  "name": "a \"b\"",
  "count": 100000000000,
  "ratio": 0.25,
  "unknown": null,
  "nothing": null,
  "yes": true,
  "words": ["a", "b"],
  )");
  CHECK(text.find("12, 12]\n}\n") != text.npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 10);  // a line for each member and each brace
}

}  // namespace tyndall::test::write_test
