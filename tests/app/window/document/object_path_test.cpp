#include "app/window/document/document.h"

#include <doctest/doctest.h>

namespace tyndall::test::object_path_test {

namespace {

Object ball(const std::string& name, double x) { return {name, Solid3d{Sphere<>{{x, 0, 0}, 1, {}}, 0}, {}}; }
Object pair(const std::vector<Object>& objects) { return {"pair", Group{objects}, {}}; }

}  // namespace

TEST_CASE("objects are found again where they stand now, with other values, names and neighbours") {
  Scene before;
  before.objects = {ball("a", 0), ball("b", 5), ball("", 7), pair({ball("c", 10), ball("d", 15)})};
  Scene after = before;
  std::get<Sphere<>>(std::get<Solid3d>(after.objects[0].kind).shape).radius = 3;
  after.objects[1].name = "other";
  CHECK(paths_after(before, after, {{1}, {0}, {3, 1}}) == ObjectPaths{{1}, {0}, {3, 1}});
  after.objects.insert(after.objects.begin(), ball("new", 1));
  after.objects.push_back(ball("last", 1));
  CHECK(paths_after(before, after, {{0}, {2}, {3, 1}}) == ObjectPaths{{1}, {3}, {4, 1}});
  CHECK(paths_after(before, after, {{1}}).empty());  // neither its name nor all of its values are there
  CHECK(paths_after(before, {}, {{0}, {3, 1}, {9}}).empty());
}

TEST_CASE("of equal objects each is found by its number, and those too many are gone") {
  Scene before, after;
  before.objects = {ball("", 0), ball("", 0), ball("b", 2), ball("", 4), ball("", 4)};
  after.objects = {ball("", 0), ball("b", 2), ball("", 4)};
  CHECK(paths_after(before, after, {{1}, {4}}).empty());
  CHECK(paths_after(before, after, {{0}, {3}}) == ObjectPaths{{0}, {2}});
  CHECK(paths_after(after, before, {{2}}) == ObjectPaths{{3}});
}

TEST_CASE("an object without a name that changed while its list grew is where its neighbours say") {
  Scene before, after;
  before.objects = {ball("", 0), ball("", 1), ball("", 2)};
  after.objects = {ball("", 9), ball("", 0), ball("", 8), ball("", 2)};
  CHECK(paths_after(before, after, {{1}}).empty());
  after.objects = {ball("", 9), ball("", 1), ball("", 8), ball("", 2)};
  CHECK(paths_after(before, after, {{2}, {1}}) == ObjectPaths{{3}, {1}});
}

TEST_CASE("keys follow their objects, and go with them") {
  Scene before;
  before.objects = {ball("a", 0), pair({ball("b", 1), ball("c", 2)})};
  before.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  before.animation.emplace();
  set_key(*before.animation, "/objects/0/radius", {0, {1}});
  set_key(*before.animation, "/objects/1/objects/1/radius", {0, {1}});
  Scene after = before;
  after.objects.erase(after.objects.begin());
  move_keys(before, after);
  REQUIRE(after.animation);
  REQUIRE(after.animation->keyed.size() == 1);
  CHECK(after.animation->keyed[0].pointer == "/objects/0/objects/1/radius");
}

}  // namespace tyndall::test::object_path_test
