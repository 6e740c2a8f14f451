#include "core/scene/slots.h"

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

}  // namespace tyndall::test::slots_test
