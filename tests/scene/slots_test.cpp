#include "core/scene/slots.h"
#include "tests/scene/files.h"
#include "tests/scene/random_scene.h"

#include <doctest/doctest.h>

namespace tyndall::test::slots_test {

namespace {

/// As a scene's file has it.
JsonValue json_of(const Slot& slot) {
  if (slot.form == ValueForm::choice)
    return {std::string(slot.choices[static_cast<std::size_t>(std::get<double>(slot.value))].name)};
  if (slot.form == ValueForm::flag) return {std::get<double>(slot.value) != 0};
  if (const double* number = std::get_if<double>(&slot.value)) return {*number};
  const Vec3d vector = std::get<Vec3d>(slot.value);
  return {JsonArray{{vector.x}, {vector.y}, {vector.z}}};
}

/// Whether both say the same; 0 and -0 are one number.
bool is_same(const JsonValue& a, const JsonValue& b) {
  const auto *number = std::get_if<double>(&a.value), *other = std::get_if<double>(&b.value);
  if (number && other) return *number == *other;
  const auto *list = std::get_if<JsonArray>(&a.value), *others = std::get_if<JsonArray>(&b.value);
  if (list && others) return std::equal(list->begin(), list->end(), others->begin(), others->end(), is_same);
  return print_json(a) == print_json(b);
}

}  // namespace

TEST_CASE("slots: values by their pointers are those of the scene's document, and are set as there") {
  int seen = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Scene scene = random_scene(seed);
    for (const std::string& part : parts_of(scene))
      for (const Slot& slot : slots_of(scene, part)) {
        const auto written = value_at_pointer(scene, slot.pointer);
        const bool open = !slot.given || slot.pointer == "/render/spp";
        if (!open) REQUIRE_MESSAGE(written, slot.pointer);
        if (!written || !slot.given || (open && std::get<double>(slot.value) == 0)) continue;
        CHECK_MESSAGE(is_same(*written, json_of(slot)), slot.pointer);
        Scene again = scene;
        CHECK(put_value(again, slot.pointer, slot.standard));
        CHECK(put_value(again, slot.pointer, slot.value));
        CHECK_MESSAGE(again == scene, slot.pointer);
        ++seen;
      }
  }
  CHECK(seen > 1000);
}

TEST_CASE("value_at_pointer: what a file leaves out has its default, also of the sky and of films") {
  Scene scene;
  scene.background = SkyPicture{};
  scene.animation = Animation{};
  for (const char* pointer :
       {"/background/rotate_y", "/background/scale", "/animation/curve", "/camera/focus_distance"})
    CHECK_MESSAGE(value_at_pointer(scene, pointer), pointer);
  for (const char* pointer : {"/background/turn", "/camera/fov", "/render/spp/0", "camera"})
    CHECK_FALSE_MESSAGE(value_at_pointer(scene, pointer), pointer);
}

TEST_CASE("slots: what a scene does not have is not found and not set") {
  Scene scene;
  const Scene before = scene;
  for (const char* pointer :
       {"/camera/fov", "/materials/gold/fuzz", "/objects/0/radius", "/animation/frames", "camera", ""}) {
    CHECK_FALSE(find_slot(scene, pointer));
    CHECK_FALSE(put_value(scene, pointer, 1.0));
  }
  CHECK(scene == before);
}

TEST_CASE("slots: a sample limit of 0 is none, and labels name fields in plain words") {
  Scene scene;
  CHECK(put_value(scene, "/render/spp", 16.0));
  CHECK(scene.render.spp == 16);
  CHECK(put_value(scene, "/render/spp", 0.0));
  CHECK_FALSE(scene.render.spp);
  CHECK(find_slot(scene, "/render/spp")->label == "Limit");
  CHECK(find_slot(scene, "/camera/vfov")->label == "Field of view");
  CHECK_FALSE(find_slot(scene, "/camera/focus_distance")->given);
}

namespace {

const std::string text = R"({
  "tyndall": 1,
  "camera": { "look_from": [0, 0, 1] },
  "materials": { "gold": { "type": "metal", "albedo": [1, 1, 1] }, "a/b~c": { "type": "lambertian", "albedo": [0, 0, 0] } },
  "objects": [{ "type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "gold" }]
})";

Scene with(const std::string& pointer, const std::string& value) { return parsed(text, {{pointer, value}}); }
std::string complaint_with(const std::string& pointer, const std::string& value = "1") {
  return complaint(text, {{pointer, value}});
}

}  // namespace

TEST_CASE("overrides: values are replaced and added, as JSON or else as text") {
  CHECK(std::get<Metal<>>(with("/materials/gold/fuzz", "0.25").materials[0].kind).fuzz == 0.25);
  CHECK(with("/camera/look_from", "[1, 2, 3]").camera.look_from == Vec3d{1, 2, 3});
  CHECK(with("/camera/look_from/2", "7").camera.look_from == Vec3d{0, 0, 7});
  CHECK(with("/camera/vfov", "40").camera.vfov == 40);
  CHECK(with("/name", "hello world").name == "hello world");
  CHECK(with("/name", "\"7\"").name == "7");
  CHECK(with("/name", "a \"b\" \\ \n c").name == "a \"b\" \\ \n c");
  CHECK(with("/render", "{ \"spp\": 3 }").render.spp == 3);
  CHECK(std::get<Vec3d>(with("/materials/a~1b~0c/albedo/1", "1").materials[1].colour) == Vec3d{0, 1, 0});
  const std::string ball = R"({ "type": "sphere", "center": [0, 0, 5], "radius": 2, "material": "gold" })";
  CHECK(with("/objects/-", ball).objects.size() == 2);
  CHECK(with("/objects/1", ball).objects.size() == 2);
  CHECK(with("/objects/0", ball).objects.size() == 1);
}

TEST_CASE("overrides: in order, the later on top of the earlier") {
  const std::vector<Override> overrides{{"/render", "{}"}, {"/render/spp", "5"}, {"/render/spp", "6"}};
  CHECK(parsed(text, overrides).render.spp == 6);
}

TEST_CASE("overrides: the object or array that holds the value must exist") {
  CHECK(complaint_with("/render/spp") == "--set /render/spp: found no /render, expected an existing parent");
  CHECK(complaint_with("/materials/gld/fuzz") ==
        "--set /materials/gld/fuzz: found no /materials/gld, expected an existing parent (did you mean \"gold\"?)");
  CHECK(complaint_with("/objects/1/radius").starts_with("--set /objects/1/radius: found no /objects/1, expected"));
  CHECK(complaint_with("/objects/-/radius").starts_with("--set /objects/-/radius: found no /objects/-, expected"));
  CHECK(complaint_with("/objects/00/radius").starts_with("--set /objects/00/radius: found no /objects/00, expected"));
  CHECK(
      complaint_with("/objects/2") ==
      "--set /objects/2: found no element \"2\" in an array of 1 value, expected an index below that, or - to append");
  CHECK(complaint_with("/tyndall/x") ==
        "--set /tyndall/x: found 1 as the parent, expected an existing object or array as the parent");
}

TEST_CASE("overrides: texts that are no JSON pointers are refused") {
  for (const char* pointer : {"", "camera", "camera/vfov", "/camera/~2", "/camera/~"})
    CHECK(complaint_with(pointer).starts_with("--set " + std::string(pointer) + ": found no JSON pointer, expected"));
}

TEST_CASE("overrides: values are held to the format's rules, at their own place") {
  CHECK(complaint_with("/materials/gold/fuzz", "2")
            .starts_with("/materials/gold/fuzz: found 2, expected a number in [0, 1]"));
  CHECK(complaint_with("/camera/vfow", "50").starts_with("/camera/vfow: found an unknown key, expected"));
  CHECK(complaint_with("/camera/vfov", "1e999").starts_with("/camera/vfov: found \"1e999\", expected a number"));
  CHECK(complaint_with("/camera/vfov", "NaN").starts_with("/camera/vfov: found \"NaN\", expected a number"));
  CHECK(complaint_with("/camera/look_from", "[1, 2").starts_with("/camera/look_from: found \"[1, 2\", expected"));
  CHECK(complaint_with("/name", "\xff") == "--set /name: found a value that is not UTF-8, expected JSON or text");
}

TEST_CASE("overrides: cannot build what a file may not hold") {
  std::vector<Override> overrides;
  std::string pointer = "/x";
  for (int i = 0; i < 10; ++i) {
    overrides.push_back({pointer, std::string(20, '[') + std::string(20, ']')});
    for (int k = 0; k < 19; ++k) pointer += "/0";
    pointer += "/0";  // appends to the innermost
  }
  CHECK(complaint(text, overrides).find("nested more than 64 deep") != std::string::npos);
}

}  // namespace tyndall::test::slots_test
