#include "core/scene/check.h"
#include "core/scene/place.h"
#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <ctime>
#include <limits>
#include <regex>
#include <sstream>

namespace tyndall::test::bad_scenes_test {

namespace {

const std::filesystem::path folder = tests_folder() / "scene";

/// The file that a line of the table stands for.
std::string file_of(const std::string& line) {
  const std::string begin = R"({ "tyndall": 1, )", object = "  object ", text = "  text ";
  const std::string materials = R"("materials": { "white": { "type": "lambertian", "albedo": [0.7, 0.7, 0.7] },
    "glass": { "type": "dielectric", "refractive_index": 1.5 } }, "objects": [)";
  if (line.starts_with(object)) return begin + materials + line.substr(object.size()) + "] }";
  if (line.starts_with(text)) return std::regex_replace(line.substr(text.size()), std::regex("⏎"), "\n");
  return begin + line + " }";
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

TEST_CASE("bad scenes: each is refused with the line that it carries") {
  std::istringstream table(test::read_text(folder / "bad_scenes.txt"));
  int scenes = 0;
  for (std::string expected, line; std::getline(table, expected);) {
    if (expected.starts_with("#")) continue;
    std::getline(table, line);
    CAPTURE(line);
    std::string found = complaint(file_of(line), {}, folder);
    CHECK_FALSE(has_control_character(found));
    if (constexpr std::string_view more = "…"; expected.ends_with(more)) {
      expected.resize(expected.size() - more.size());
      CHECK(found.size() > expected.size());
      found.resize(std::min(found.size(), expected.size()));
    }
    CHECK(found == expected);
    ++scenes;
  }
  CHECK(scenes > 100);
}

TEST_CASE("bad scenes: empty files, broken texts and odd bytes are refused, too") {
  CHECK(complaint("") == "/: found an empty file, expected a scene: { \"tyndall\": 1, … }");
  CHECK(complaint(" \n\t ") == "/: found an empty file, expected a scene: { \"tyndall\": 1, … }");
  CHECK(complaint(std::string(3, '\0')) == "line 1, column 1: found a zero byte, expected text in UTF-8");
  CHECK(complaint("{\"tyndall\": 1, \"name\": \"\xff\"}") ==
        "line 1, column 25: found bytes that are not UTF-8, expected text in UTF-8");
  CHECK(complaint("{\"t\": \"abc").starts_with("line 1, column 11: found a text that is not closed"));
  CHECK(complaint("{\"t\": \"\\ud800\"}").find("half of a \\u pair") != std::string::npos);
  CHECK(complaint("{\"t\": \"\\u12x\"}").find("without 4 hexadecimal digits") != std::string::npos);
  CHECK(complaint("{\"ä\": ö}").starts_with("line 1, column 7: found 'ö', expected a value"));
  CHECK(complaint("{\r\n  \"tyndall\": 1,\r\n  nix\r\n}").starts_with("line 3, column 3: found 'nix'"));
  CHECK(complaint("\"" + std::string(1000, 'x') + "\" 1").size() < 200);
  CHECK(complaint("\xef\xbb\xbf{ \"tyndall\": 1 }") == "");  // a byte order mark is no fault
}

TEST_CASE("bad scenes: nesting is refused before it is built, 64 levels are not") {
  const std::clock_t start = std::clock();  // processor time
  const std::string deep = complaint(std::string(1000000, '['));
  const auto more = complaint("{ \"tyndall\": 1, \"objects\": " + std::string(1000000, '['));
  CHECK(std::clock() - start < 2 * CLOCKS_PER_SEC);
  CHECK(deep == "/0/0/0/…: found brackets nested more than 64 deep, expected at most 64 levels");
  CHECK(more == "/objects/0/0/…: found brackets nested more than 64 deep, expected at most 64 levels");
  std::string groups = "{ \"tyndall\": 1";
  for (int level = 0; level < 33; ++level) groups += ", \"objects\": [{ \"type\": \"group\"";
  CHECK(complaint(groups).starts_with("/objects/0/objects/…: found brackets nested more than 64 deep"));
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  CHECK(complaint(nested(65)).find("nested more") != std::string::npos);
  CHECK(complaint(nested(64)) == "/: found an array of 1 value, expected a scene: { \"tyndall\": 1, … }");
}

TEST_CASE("bad scenes: long names and values are cut in the message") {
  const std::string name(100000, 'n');
  CHECK(complaint("{ \"tyndall\": 1, \"" + name + "\": 1 }").size() < 1000);
  CHECK(complaint("{ \"tyndall\": 1, \"name\": 1, \"camera\": \"" + name + "\" }").size() < 1000);
}

TEST_CASE("bad scenes: a scene of more than 256 MiB is refused") {
  std::string text(std::size_t(256) << 20, ' ');
  const std::string begin = "{ \"tyndall\": 1 }";
  text.replace(0, begin.size(), begin);
  CHECK(complaint(text) == "");
  text += ' ';
  CHECK(complaint(text) == "/: found more than 256 MiB of text, expected a scene of at most 256 MiB");
}

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scene with a texture of each sort, a material and a few objects: valid.
Scene good() {
  Scene scene;
  const auto pixels = std::make_shared<const Image::Pixels>(Image::Pixels{1, 1, {1, 2, 3}});
  scene.textures = {{"tiles", Checker<>()}, {"planet", Image{"planet.png", pixels}}};
  scene.materials = {{"white", Vec3d{0.7, 0.7, 0.7}, Lambertian<>()}, {"a/b", Vec3d{1, 1, 1}, Metal<>{0.5}}};
  Volume fog;
  fog.boundary = Sphere<>{{0, 0, 0}, 1, std::nullopt};
  scene.objects = {{"ball", Solid3d{Sphere<>(), 0}, {}},
                   {"fog", fog, {}},
                   {"pair", Group{{{"quad", Solid3d{Quad<>(), 1}, {}}}}, {}}};
  return scene;
}

/// Where a scene is broken after `edit`; "" if it is not.
template <class Edit>
std::string where_after(const Edit& edit) {
  Scene scene = good();
  edit(scene);
  const auto error = check(scene);
  return error ? error->where : "";
}

template <class Edit>
void breaks(const std::string& where, const Edit& edit) {
  CHECK(where_after(edit) == where);
}

Solid3d& solid(Scene& scene) { return std::get<Solid3d>(scene.objects[0].kind); }
Volume& fog(Scene& scene) { return std::get<Volume>(scene.objects[1].kind); }
Solid3d& in_group(Scene& scene) { return std::get<Solid3d>(std::get<Group>(scene.objects[2].kind).objects[0].kind); }

}  // namespace

TEST_CASE("check: a valid scene and the empty one pass") {
  CHECK(where_after([](Scene&) {}) == "");
  CHECK_FALSE(check(Scene()));
}

TEST_CASE("check: numbers that are not finite, wherever an edit may put them") {
  breaks("/camera/look_from/1", [](Scene& s) { s.camera.look_from.y = not_a_number; });
  breaks("/camera/shutter/1", [](Scene& s) { s.camera.shutter_close = infinity; });
  breaks("/camera/focus_distance", [](Scene& s) { s.camera.focus_distance = not_a_number; });
  breaks("/display/exposure", [](Scene& s) { s.display.exposure = -infinity; });
  breaks("/background/2", [](Scene& s) { s.background = Vec3d{0, 0, infinity}; });
  breaks("/background/up/1", [](Scene& s) { s.background = Hemispheres{{1, not_a_number, 1}, {}}; });
  breaks("/textures/tiles/scale", [](Scene& s) { s.textures[0].kind = Checker<>{not_a_number, {}, {}}; });
  breaks("/materials/a~1b/fuzz", [](Scene& s) { s.materials[1].kind = Metal<>{not_a_number}; });
  breaks("/materials/white/albedo/0", [](Scene& s) { s.materials[0].colour = Vec3d{not_a_number, 0, 0}; });
  breaks("/objects/0/radius", [](Scene& s) { solid(s).shape = Sphere<>{{}, infinity, {}}; });
  breaks("/objects/0/center_end/2", [](Scene& s) { solid(s).shape = Sphere<>{{}, 1, Vec3d{0, 0, not_a_number}}; });
  breaks("/objects/0/transform/1/rotate_y", [](Scene& s) {
    s.objects[0].transform = {RotateY{}, RotateY{not_a_number}};
  });
  breaks("/objects/1/density", [](Scene& s) { fog(s).medium.density = infinity; });
  breaks("/objects/1/boundary/transform/0/translate/0", [](Scene& s) {
    fog(s).boundary_transform = {Translate{{not_a_number, 0, 0}}};
  });
  breaks("/objects/2/objects/0/u/0", [](Scene& s) { in_group(s).shape = Quad<>{{}, {not_a_number, 0, 0}, {}}; });
}

// What files may not hold either is in bad_scenes.txt: reading ends with the same check.
TEST_CASE("check: what is just valid passes, and so does a colour that nobody looks at") {
  breaks("", [](Scene& s) { s.height = 65536; });
  breaks("", [](Scene& s) { s.render.max_depth = 0; });
  breaks("", [](Scene& s) { s.materials[0].kind = Light<>(), s.materials[0].colour = Vec3d{0, 0, 100}; });
  breaks("", [](Scene& s) { s.materials[0].kind = Dielectric<>(), s.materials[0].colour = Vec3d{9, 9, 9}; });
  breaks("", [](Scene& s) { s.camera.shutter_open = 1, s.camera.shutter_close = 1; });
  breaks("", [](Scene& s) { fog(s).medium.g = 1 - 1e-6; });
  breaks("", [](Scene& s) { fog(s).albedo = TextureIndex{0}; });
}

TEST_CASE("check: indices must be in range, names unique, and textures must have their pictures") {
  breaks("/objects/0/material", [](Scene& s) { solid(s).material = 2; });
  breaks("/objects/0/material", [](Scene& s) { solid(s).material = -1; });
  breaks("/materials/white/albedo", [](Scene& s) { s.materials[0].colour = TextureIndex{2}; });
  breaks("", [](Scene& s) { s.materials[0].colour = TextureIndex{1}; });
  breaks("/objects/1/albedo", [](Scene& s) { fog(s).albedo = TextureIndex{-1}; });
  breaks("/materials/white", [](Scene& s) { s.materials[1].name = "white"; });
  breaks("/textures/tiles", [](Scene& s) { s.textures[1].name = "tiles"; });
  breaks("/textures/planet/file", [](Scene& s) { s.textures[1].kind = Image{"planet.png", nullptr}; });
  breaks("/background/file", [](Scene& s) { s.background = SkyPicture{}; });
  breaks("/render/integrator", [](Scene& s) { s.render.integrator = static_cast<Integrator>(9); });
}

TEST_CASE("check: quads without area are refused, judged by their own size") {
  const auto where = [](Vec3d u, Vec3d v) { return where_after([&](Scene& s) { solid(s).shape = Quad<>{{}, u, v}; }); };
  for (const double size : {1e-30, 1e-6, 1.0, 1e6, 1e30}) {
    CAPTURE(size);
    CHECK(where({size, 0, 0}, {0, size, 0}) == "");
    CHECK(where({size, 0, 0}, {0, 1, 0}) == "");
    CHECK(where({size, 0, 0}, {size, 1e-5 * size, 0}) == "");
    CHECK(where({size, 0, 0}, {size, 1e-7 * size, 0}) == "/objects/0");
    CHECK(where({size, 2 * size, 3 * size}, {-1, -2, -3}) == "/objects/0");
    CHECK(where({size, 0, 0}, {0, 0, 0}) == "/objects/0");
  }
}

TEST_CASE("check: the camera needs a direction, and an up vector that is not parallel to it") {
  const auto where = [](Vec3d from, Vec3d at, Vec3d up) {
    return where_after([&](Scene& s) { s.camera.look_from = from, s.camera.look_at = at, s.camera.vup = up; });
  };
  CHECK(where({0, 0, 0}, {0, -1e-20, 0}, {0, 1e20, 0}) == "/camera/vup");
  CHECK(where({0, 0, 0}, {0, 5, 0.01}, {0, 1, 0}) == "");
}

TEST_CASE("what is expected, in words: form, range, unit, meaning") {
  CHECK(expected_text({between(0, 1)}, Form::number) == "a number in [0, 1]");
  CHECK(expected_text({inside(0, 180), "°"}, Form::number) == "a number > 0 and < 180 in °");
  CHECK(expected_text({above(0)}, Form::whole) == "a whole number > 0");
  CHECK(expected_text({at_least(0), "", "samples"}, Form::whole) == "a whole number >= 0 (samples)");
  CHECK(expected_text({not_zero()}, Form::number) == "a number other than 0");
  CHECK(expected_text({any_number()}, Form::vector) == "an array of 3 numbers");
}

TEST_CASE("a place's JSON pointer") {
  const Place scene, materials{scene, "materials"}, gold{materials, "a/b~c"};
  CHECK(pointer(scene) == "/");
  CHECK(pointer({gold, std::size_t{2}}) == "/materials/a~1b~0c/2");
}

}  // namespace tyndall::test::bad_scenes_test
