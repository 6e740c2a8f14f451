#include "core/compile/compile.h"
#include "tests/app/window/opened_session.h"
#include "tests/support/allocations.h"
#include "tests/support/prepared.h"

namespace tyndall::test::session_edits_test {

TEST_CASE("an edit copies the scene once, and its kept file once more, on another thread") {
  constexpr std::size_t many = 997;
  OpenedSession opened("copies");
  opened.edit([](Scene& scene) { scene.objects.resize(many, scene.objects[0]); });
  REQUIRE(opened.finishes());
  opened.session->flush_edits();  // the file of the edit before, which would else be counted now and then
  const AllocationCount copies(many * sizeof(Object));
  opened.edit([](Scene& scene) { scene.camera.vfov -= 1; });
  REQUIRE(opened.finishes());
  opened.session->flush_edits();
  CHECK(opened.sent() == 3);
  CHECK(copies.count() == 2);
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
    for (const double fuzz : {0.3, 0.4, 0.5}) {
      opened.set_fuzz(fuzz, 7);
      CHECK(opened.session->send(0) == (fuzz == 0.3));
    }
    CHECK(opened.sent() == 2);
    CHECK(opened.session->send(1e9));  // so late that the edit is sent although a picture is awaited
    CHECK(opened.sent() == 3);
  }
  REQUIRE(opened.finishes());
  CHECK(opened.fuzz() == 0.5);
  opened.editor().undo();
  CHECK(opened.fuzz() == 0.25);
  CHECK_FALSE(opened.editor().edited());
}

TEST_CASE("an edit that breaks the scene is refused with a reason, which goes away with the next valid edit") {
  OpenedSession opened("broken");
  opened.edit([](Scene& scene) { scene.camera.look_at = scene.camera.look_from; });
  CHECK(opened.session->messages.current().error);
  CHECK(opened.message().starts_with("/camera"));
  CHECK_FALSE(opened.editor().edited());
  opened.set_fuzz(0.75);
  CHECK(opened.message().empty());
}

TEST_CASE("the selection stays on its objects through undo, redo and a file that is read again") {
  OpenedSession opened("selection");
  Editor& editor = opened.editor();
  const auto name_objects = [&](const std::vector<std::string>& names) {
    return [names](Scene& scene) {
      const Object any = scene.objects[0];
      scene.objects.clear();
      for (const std::string& name : names) scene.objects.push_back({name, any.kind, {}});
    };
  };
  opened.edit(name_objects({"a", "b", "c"}));
  editor.select({{0}, {2}});
  opened.edit(name_objects({"a", "a 2", "b", "c", "c 2"}));  // duplicated
  editor.select({{1}, {4}});
  editor.undo();
  CHECK(editor.selection() == ObjectPaths{{0}, {2}});
  editor.select({{2}});
  editor.redo();
  CHECK(editor.selection() == ObjectPaths{{3}});
  editor.save("scene.json");
  Scene other = opened.scene();
  name_objects({"new", "a", "c"})(other);
  write_text("scene.json", write_scene(other));
  REQUIRE(opened.comes_true([&] { return editor.scene().objects.size() == 3; }));
  CHECK(editor.selection() == ObjectPaths{{2}});
}

TEST_CASE("a snapshot that is opened again goes on: the EXR from its samples to the same bits, the PNG starts over") {
  OpenedSession opened("reopened");
  REQUIRE(opened.finishes());
  opened.edit([](Scene& scene) { scene.camera.vfov = 33; });
  opened.session->snapshot();  // of the newest edit, though it was not sent yet
  REQUIRE(opened.appears("scene-001.png"));
  const Scene seen = opened.scene();
  opened.session->discard_edits();
  opened.reopen([](WindowOptions& options) { options.scene = load_scene("scene-001.png"); });
  CHECK(opened.says("opened scene-001.png; it starts over"));
  CHECK(opened.scene().camera == seen.camera);
  CHECK(opened.scene().objects == seen.objects);
  CHECK(opened.editor().document().origin->file.empty());
  if (!has_openexr()) return;
  opened.reopen([](WindowOptions& options) {
    options.scene = load_scene("scene-001.exr");
    options.scene.scene.render.spp = 12;
  });
  REQUIRE(opened.says("opened scene-001.exr; it goes on from "));
  REQUIRE(opened.finishes());
  RenderOptions options;
  options.threads = 1;
  options.spp = 12;
  CHECK(resolve(opened.session->renderers.film()) == resolve(render(compile(seen), options).film));
}

}  // namespace tyndall::test::session_edits_test
