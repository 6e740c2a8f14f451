#include "app/window/document/document.h"
#include "tests/app/window/opened_session.h"
#include "tests/support/allocations.h"

#include <doctest/doctest.h>

#include <mutex>

namespace tyndall::test::session_edits_test {
using test::OpenedSession;

TEST_CASE("an edit goes to the renderer, the same value again does not") {
  OpenedSession opened("edit");
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.edit(Half::current) == 1);
  opened.set_fuzz(0.25);
  CHECK_FALSE(opened.session->send(1e9));
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.edit(Half::current) == 2);
  opened.session->editor.undo();
  CHECK(opened.fuzz() == 0.25);
  CHECK_FALSE(edited(opened.session->editor.document()));
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers.edit(Half::current) == 3);
}

TEST_CASE("an edit copies the scene once, and its kept file once more, on another thread") {
  constexpr std::size_t many = 997;
  OpenedSession opened("copies");
  Scene large = opened.session->editor.scene();
  large.objects.resize(many, large.objects[0]);
  opened.session->editor.edit(std::move(large), 0);
  REQUIRE(opened.finishes());
  opened.session->flush_edits();  // the file of the edit before, which would else be counted now and then
  const test::AllocationCount copies(many * sizeof(Object));
  Scene next = opened.session->editor.scene();
  next.camera.vfov -= 1;
  opened.session->editor.edit(std::move(next), 0, "/camera/vfov");
  REQUIRE(opened.finishes());
  opened.session->flush_edits();
  CHECK(opened.session->renderers.edit(Half::current) == 3);
  CHECK(copies.count() == 2);
}

TEST_CASE("exposure, tone map and name start nothing over, but can be undone") {
  OpenedSession opened("display");
  REQUIRE(opened.finishes());
  Scene scene = opened.session->editor.scene();
  scene.display.exposure = 2;
  scene.display.tone_map = ToneMap::aces;
  opened.session->editor.edit(scene, 0);
  CHECK_FALSE(opened.session->send(1e9));
  CHECK(edited(opened.session->editor.document()));
  opened.session->editor.undo();
  CHECK(opened.session->editor.scene().display.exposure == 0);
  CHECK(opened.session->renderers.edit(Half::current) == 1);
}

TEST_CASE("while a picture is awaited only the newest scene waits, and those between are never rendered") {
  OpenedSession opened("waiting");
  {
    const std::lock_guard hold(opened.gate);
    const int before = opened.frames;
    ++opened.session->wanted.restarts;
    opened.session->send(0);
    REQUIRE(opened.news.wait_until([&] { return opened.frames != before; }));
    // The renderer has shown the first edit and stands still.
    opened.set_fuzz(0.3, 7);
    CHECK(opened.session->send(0));
    opened.set_fuzz(0.4, 7);
    CHECK_FALSE(opened.session->send(0));
    opened.set_fuzz(0.5, 7);
    CHECK_FALSE(opened.session->send(0));
    CHECK(opened.session->renderers.edit(Half::current) == 2);
    CHECK(opened.session->send(1e9));  // so late that the edit is sent although a picture is awaited
    CHECK(opened.session->renderers.edit(Half::current) == 3);
  }
  REQUIRE(opened.finishes());
  CHECK(opened.fuzz() == 0.5);
  opened.session->editor.undo();
  CHECK(opened.fuzz() == 0.25);
}

TEST_CASE("an edit that breaks the scene is refused with a reason, which goes away with the next valid edit") {
  OpenedSession opened("broken");
  Scene scene = opened.session->editor.scene();
  scene.camera.look_at = scene.camera.look_from;
  opened.session->editor.edit(scene, 0);
  CHECK(opened.session->messages.current().error);
  CHECK(opened.session->messages.current().text.find("/camera") == 0);
  CHECK_FALSE(edited(opened.session->editor.document()));
  opened.set_fuzz(0.75);
  CHECK(opened.session->messages.current().text.empty());
}

}  // namespace tyndall::test::session_edits_test
