#include "core/scene/json_tree.h"
#include "tests/scene/everything.h"
#include "tests/scene/files.h"
#include "tests/scene/random_scene.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <limits>

namespace tyndall::test::read_test {

namespace {

template <class T, class Variant>
const T& as(const Variant& variant) {
  REQUIRE(std::holds_alternative<T>(variant));
  return std::get<T>(variant);
}

}  // namespace

TEST_CASE("read_scene: the settings") {
  const Scene scene = parsed(everything);
  CHECK(scene.name == "Everything");
  CHECK(scene.width == 600);
  CHECK(scene.height == 300);
  CHECK(scene.camera == Camera{{278, 278, -800}, {278, 278, 0}, {0, 2, 0}, 40, 0.5, 10.0, 0.25, 0.75});
  CHECK(as<Hemispheres>(scene.background) == Hemispheres{{1, 2, 3}, {0, 0, 0.5}});
  CHECK(scene.render == RenderSettings{50, 200, Integrator::path, SamplerKind::random, FresnelKind::schlick,
                                       Caustics::scatter, false, 4294967295u, true});
  CHECK(scene.display == Display{-1.5, ToneMap::aces});
}

TEST_CASE("read_scene: materials and textures, in the file's order, wherever they stand") {
  const Scene scene = parsed(everything);
  REQUIRE(scene.materials.size() == 6);
  CHECK(scene.materials[0].name == "floor");
  CHECK(as<TextureIndex>(scene.materials[0].colour).index == 0);
  CHECK(as<Metal<>>(scene.materials[1].kind).fuzz == 0.3);
  CHECK(as<Vec3d>(scene.materials[1].colour) == Vec3d{0.8, 0.6, 0.2});
  CHECK(as<Dielectric<>>(scene.materials[2].kind).refractive_index == 0.5);
  CHECK(as<Vec3d>(scene.materials[3].colour) == Vec3d{7, 8, 9});
  CHECK(scene.materials[4].name == "a/b~c \"d\"");
  CHECK(as<TextureIndex>(scene.materials[4].colour).index == 3);
  CHECK(as<TextureIndex>(scene.materials[5].colour).index == 4);
  REQUIRE(scene.textures.size() == 5);
  CHECK(as<Checker<>>(scene.textures[0].kind) == Checker<>{0.32, {0.2, 0.3, 0.1}, {0.9, 0.9, 0.9}});
  CHECK(as<Noise<>>(scene.textures[1].kind) == Noise<>{4, Noise<>::Style::turbulence});
  CHECK(as<Noise<>>(scene.textures[2].kind).style == Noise<>::Style::marble);
  CHECK(as<Solid<>>(scene.textures[3].kind).color == Vec3d{0.1, 0.2, 0.3});
  const Image& image = as<Image>(scene.textures[4].kind);
  CHECK(image.file == "../textures/planet.png");
  REQUIRE(image.pixels);
  CHECK(image.pixels->width > 100);
  CHECK(image.pixels->rgb.size() == static_cast<std::size_t>(3 * image.pixels->width * image.pixels->height));
}

TEST_CASE("read_scene: objects, media, groups and their transforms") {
  const Scene scene = parsed(everything);
  REQUIRE(scene.objects.size() == 9);
  const auto& ball = as<Solid3d>(scene.objects[0].kind);
  CHECK(scene.objects[0].name == "ball");
  CHECK(ball.material == 2);
  CHECK(as<Sphere<>>(ball.shape) == Sphere<>{{0, 1, 0}, -0.9, std::nullopt});
  CHECK(as<Sphere<>>(as<Solid3d>(scene.objects[1].kind).shape).center_end == Vec3d{4, 1.5, 0});
  CHECK(as<Quad<>>(as<Solid3d>(scene.objects[2].kind).shape) == Quad<>{{0, 1, 2}, {555, 0, 0}, {0, 0, 555}});
  CHECK(as<Box<>>(as<Solid3d>(scene.objects[3].kind).shape) == Box<>{{0, 0, 0}, {165, 330, 165}});
  CHECK(scene.objects[3].transform == Transform{RotateY{15}, Translate{{265, 0, 295}}});
  const auto& fog = as<Volume>(scene.objects[4].kind);
  CHECK(fog.medium == Medium<>{0.01, -0.5});
  CHECK(as<TextureIndex>(fog.albedo).index == 1);
  CHECK(as<Box<>>(fog.boundary) == Box<>{{0, 0, 0}, {1, 1, 1}});
  CHECK(fog.boundary_transform == Transform{Translate{{1, 2, 3}}});
  CHECK(scene.objects[4].transform == Transform{RotateY{1}});
  const auto& pair = as<Group>(scene.objects[5].kind);
  CHECK(scene.objects[5].transform == Transform{RotateY{2}});
  REQUIRE(pair.objects.size() == 2);
  CHECK(as<Group>(pair.objects[0].kind).objects.empty());
  CHECK(as<Solid3d>(pair.objects[1].kind).material == 4);
}

TEST_CASE("read_scene: what a file leaves out has the format's defaults") {
  const Scene scene = parsed("{ \"tyndall\": 1 }");
  CHECK(scene == Scene());
  CHECK(scene.camera == Camera{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90, 0, std::nullopt, 0, 0});
  CHECK(scene.render.max_depth == 1000);
  CHECK_FALSE(scene.render.spp);
  CHECK(scene.render.fresnel == FresnelKind::exact);
  CHECK(as<Vec3d>(scene.background) == Vec3d{0, 0, 0});
}

TEST_CASE("read_scene: one picture in memory, however many textures use its file") {
  const Scene scene = parsed(R"({ "tyndall": 1, "textures": {
    "a": { "type": "image", "file": "../textures/planet.png" },
    "b": { "type": "image", "file": "../textures/planet.png" } } })");
  CHECK(as<Image>(scene.textures[0].kind).pixels == as<Image>(scene.textures[1].kind).pixels);
}

TEST_CASE("leading_comments: the lines above a scene") {
  CHECK(leading_comments(everything) == std::vector<std::string>{"A first line", "and a second."});
  CHECK(leading_comments("\xef\xbb\xbf /* one\r\n   two */\n//three\r\n{} // four") ==
        std::vector<std::string>{"one", "two", "three"});
  CHECK(leading_comments("// a\x1b[31m\n{}") == std::vector<std::string>{"a\\u001b[31m"});
  CHECK(leading_comments("//") == std::vector<std::string>{});
  CHECK(leading_comments("/* for ever") == std::vector<std::string>{"for ever"});
  CHECK(leading_comments("{}") == std::vector<std::string>{});
  CHECK(leading_comments("") == std::vector<std::string>{});
}

TEST_CASE("reading: a zero byte is refused wherever it is, and what follows it is not left out") {
  const std::string scene = R"({"tyndall": 1})";
  CHECK(complaint(scene + "\n ").empty());
  const std::string expected = ": found a zero byte, expected text in UTF-8";
  CHECK(complaint(scene + '\0') == "line 1, column 15" + expected);
  CHECK(complaint(scene + "\n" + '\0' + " {\"tyndall\": 2}") == "line 2, column 1" + expected);
  CHECK(complaint("// comment" + std::string(1, '\0') + "\n" + scene) == "line 1, column 11" + expected);
  CHECK(complaint(std::string(1, '\0') + scene) == "line 1, column 1" + expected);
}

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

}  // namespace tyndall::test::read_test
