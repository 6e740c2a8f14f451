#include "app/report/contents.h"

#include "core/scene/load.h"

#include <doctest/doctest.h>

namespace tyndall::test::contents_test {

namespace {

Contents contents(const std::string& objects, const std::string& more = "") {
  return contents_of(read_scene(R"({"tyndall":1,"materials":{"white":{"type":"lambertian","albedo":[1,1,1]},
    "lamp":{"type":"light","radiance":[1,1,1]}},"objects":[)" +
                                    objects + "]" + more + "}",
                                "test", "."));
}

}  // namespace

TEST_CASE("contents: objects in groups count, boxes are six lights, the others one; a disk with a hole is a ring") {
  const Contents c = contents(R"(
    {"type":"sphere","center":[0,0,0],"radius":1,"material":"white"},
    {"type":"triangle","corner":[0,0,0],"u":[1,0,0],"v":[0,1,0],"material":"lamp"},
    {"type":"disk","center":[0,0,0],"u":[1,0,0],"v":[0,1,0],"material":"lamp"},
    {"type":"disk","center":[0,0,0],"u":[1,0,0],"v":[0,1,0],"inner":0.5,"material":"lamp"},
    {"type":"group","objects":[
      {"type":"box","min":[0,0,0],"max":[1,1,1],"material":"lamp"},
      {"type":"group","objects":[{"type":"quad","corner":[0,0,0],"u":[1,0,0],"v":[0,1,0],"material":"lamp"}]},
      {"type":"medium","boundary":{"type":"sphere","center":[0,0,0],"radius":1},"density":1,"albedo":[1,1,1],"g":0.5}
    ]})");
  using Counts = std::map<std::string, int>;
  CHECK(c.shapes == Counts{{"sphere", 1}, {"box", 1}, {"quad", 1}, {"triangle", 1}, {"disk", 1}, {"ring", 1}});
  CHECK(c.materials == Counts{{"lambertian", 1}, {"light", 1}});
  CHECK(c.lights == 10);
  CHECK(c.media == 1);
  CHECK(c.phase_functions == 1);
  CHECK(c.background == "none");
  CHECK_FALSE(c.defocus);
}

TEST_CASE("contents: something moves only while the shutter is open; lenses and backgrounds") {
  const char* moving = R"({"type":"sphere","center":[0,0,0],"center_end":[1,0,0],"radius":1,"material":"white"})";
  CHECK(contents(moving).shapes.at("moving sphere") == 1);
  CHECK_FALSE(contents(moving).motion);
  CHECK(contents(moving, R"(,"camera":{"shutter":[0,1]})").motion);
  CHECK(contents(moving, R"(,"camera":{"defocus_angle":1})").defocus);
  CHECK(contents(moving, R"(,"background":[1,0,0])").background == "constant");
  CHECK(contents(moving, R"(,"background":{"type":"hemispheres","up":[1,1,1],"down":[0,0,0]})").background ==
        "hemispheres");
}

}  // namespace tyndall::test::contents_test
