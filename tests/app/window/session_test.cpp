#include "app/window/session.h"

#include "core/image/image_io.h"
#include "tests/support/allocations.h"
#include "tests/support/news.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>

using namespace tyndall;
namespace fs = std::filesystem;

namespace {

/// A session over a small scene file of its own, and a clock that waits for it.
class Opened {
 public:
  explicit Opened(const std::string& name) : folder_(scratch_folder() / ("session_" + name)) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    before_ = fs::current_path();
    fs::current_path(folder_);
    write(0.25);
    WindowOptions options;
    options.scene = load_scene("scene.json");
    options.threads = 1;
    session = std::make_unique<Session>(
        options, [this] { news.tell(); },
        [this] {
          ++frames;
          news.tell();
          const std::lock_guard wait(gate);
        },
        nullptr);
  }
  ~Opened() {
    session.reset();
    fs::current_path(before_);
  }

  static void write(double fuzz, const std::string& file = "scene.json") {
    std::ofstream(file) << R"({ "tyndall": 1, "image": { "width": 8, "height": 8 }, "background": [1, 1, 1],
      "render": { "spp": 4, "integrator": "path", "sampler": "random" },
      "materials": { "gold": { "type": "metal", "albedo": [1, 1, 1], "fuzz": )"
                        << fuzz << R"( } },
      "objects": [{ "type": "sphere", "center": [0, 0, -2], "radius": 1, "material": "gold" }] })";
  }
  double fuzz() const { return std::get<Metal<>>(session->editor().scene().materials[0].kind).fuzz; }
  void set_fuzz(double fuzz, std::uint64_t gesture = 0) {
    Scene scene = session->editor().scene();
    std::get<Metal<>>(scene.materials[0].kind).fuzz = fuzz;
    session->editor().edit(scene, gesture);
  }
  template <class Condition>
  bool comes_true(const Condition& condition) {
    return news.wait_until([&] {
      session->collect();
      session->collect_errors();
      session->send(1e9);  // out of patience
      return condition();
    });
  }
  bool finishes() {
    return comes_true([&] {
      const auto frame = session->renderers().latest(Half::current);
      return frame && frame->finished && frame->edit == session->renderers().edit(Half::current) &&
             session->send_time() > 1e100;
    });
  }

  test::News news;
  std::mutex gate;  ///< holds the renderer after its next frame
  std::atomic<int> frames = 0;
  std::unique_ptr<Session> session;

 private:
  fs::path folder_, before_;
};

}  // namespace

TEST_CASE("an edit goes to the renderer, the same value again does not") {
  Opened opened("edit");
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == 1);
  opened.set_fuzz(0.25);
  CHECK_FALSE(opened.session->send(1e9));
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == 2);
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.25);
  CHECK_FALSE(edited(opened.session->editor().document()));
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == 3);
}

TEST_CASE("an edit copies the scene at most twice on its way to compile: to change it, and to share it") {
  constexpr std::size_t many = 997;
  Opened opened("copies");
  Scene large = opened.session->editor().scene();
  large.objects.resize(many, large.objects[0]);
  opened.session->editor().edit(std::move(large), 0);
  REQUIRE(opened.finishes());
  const test::AllocationCount copies(many * sizeof(Object));
  Scene next = opened.session->editor().scene();
  next.camera.vfov -= 1;
  opened.session->editor().edit(std::move(next), 0);
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == 3);
  CHECK(copies.count() == 2);
}

TEST_CASE("exposure, tone map and name start nothing over, but can be undone") {
  Opened opened("display");
  REQUIRE(opened.finishes());
  Scene scene = opened.session->editor().scene();
  scene.display.exposure = 2;
  scene.display.tone_map = ToneMap::aces;
  opened.session->editor().edit(scene, 0);
  CHECK_FALSE(opened.session->send(1e9));
  CHECK(edited(opened.session->editor().document()));
  opened.session->editor().undo();
  CHECK(opened.session->editor().scene().display.exposure == 0);
  CHECK(opened.session->renderers().edit(Half::current) == 1);
}

TEST_CASE("while a picture is awaited the newest scene waits, and none between is begun") {
  Opened opened("waiting");
  {
    const std::lock_guard hold(opened.gate);
    const int before = opened.frames;
    opened.session->restart();
    REQUIRE(opened.news.wait_until([&] { return opened.frames != before; }));
    // The renderer has shown the first edit and stands still.
    opened.set_fuzz(0.3, 7);
    CHECK(opened.session->send(0));
    opened.set_fuzz(0.4, 7);
    CHECK_FALSE(opened.session->send(0));
    opened.set_fuzz(0.5, 7);
    CHECK_FALSE(opened.session->send(0));
    CHECK(opened.session->renderers().edit(Half::current) == 2);
    CHECK(opened.session->send(1e9));  // out of patience
    CHECK(opened.session->renderers().edit(Half::current) == 3);
  }
  REQUIRE(opened.finishes());
  CHECK(opened.fuzz() == 0.5);
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.25);
}

TEST_CASE("what is broken is refused with a reason, and goes away with the next good edit") {
  Opened opened("broken");
  Scene scene = opened.session->editor().scene();
  scene.camera.look_at = scene.camera.look_from;
  opened.session->editor().edit(scene, 0);
  CHECK(opened.session->messages().current().error);
  CHECK(opened.session->messages().current().text.find("/camera") == 0);
  CHECK_FALSE(edited(opened.session->editor().document()));
  opened.set_fuzz(0.75);
  CHECK(opened.session->messages().current().text.empty());
}

TEST_CASE("opening another scene can be undone, with where it came from") {
  Opened opened("open");
  opened.set_fuzz(0.5);
  Opened::write(0.125, "other.json");
  opened.session->editor().open(fs::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK(opened.session->editor().document().origin->title == "other.json");
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.5);
  CHECK(opened.session->editor().document().origin->title == "scene.json");
  opened.session->editor().open("no such file");
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("the file is read again when it changes, and what was edited is one undo away") {
  Opened opened("reload");
  opened.set_fuzz(0.5);
  Opened::write(0.75);
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.75; }));
  CHECK_FALSE(edited(opened.session->editor().document()));
  opened.session->editor().undo();
  CHECK(opened.fuzz() == 0.5);
  std::ofstream("scene.json") << "{";
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.fuzz() == 0.5);
}

TEST_CASE("saving is no edit, and is not read again as one") {
  Opened opened("save");
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  const std::uint64_t edits = opened.session->renderers().edit(Half::current);
  opened.session->editor().save(opened.session->editor().document().origin->file);
  CHECK_FALSE(edited(opened.session->editor().document()));
  const auto saved = opened.session->editor().document().origin;
  // The file was read again.
  REQUIRE(opened.comes_true([&] { return opened.session->editor().document().origin != saved; }));
  REQUIRE(opened.finishes());
  CHECK(opened.session->renderers().edit(Half::current) == edits);
  CHECK(std::get<Metal<>>(load_scene("scene.json").scene.materials[0].kind).fuzz == 0.5);
  opened.session->editor().save("no/such/folder/a.json");
  CHECK(opened.session->messages().current().error);
}

TEST_CASE("a snapshot holds the newest edit, also when it was not sent yet, and is finished when the window closes") {
  Opened opened("snapshot");
  REQUIRE(opened.finishes());
  opened.set_fuzz(0.875);
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-001.png"); }));
  CHECK(std::get<Metal<>>(load_scene("scene-001.png").scene.materials[0].kind).fuzz == 0.875);
  opened.session->snapshot();
  opened.session.reset();
  CHECK(fs::exists("scene-002.png"));
}

TEST_CASE("the picture on the screen as reference: of other scenes after an edit, the old one again after undo") {
  Opened opened("reference");
  REQUIRE(opened.finishes());
  const LiveAccuracy& accuracy = opened.session->accuracy();
  CHECK_FALSE(opened.session->can_show_errors());
  opened.session->keep_as_reference();
  CHECK(accuracy.fit(Half::current) == ReferenceFit::same_samples);
  CHECK(opened.session->can_show_errors());
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  CHECK(accuracy.fit(Half::current) == ReferenceFit::other_scene);
  opened.session->editor().undo();
  Scene scene = opened.session->editor().scene();
  scene.render.seed = 4;
  opened.session->editor().edit(scene, 0);
  REQUIRE(opened.finishes());
  CHECK(accuracy.fit(Half::current) == ReferenceFit::fits);
  opened.session->shown(Half::current, opened.session->renderers().latest(Half::current));
  REQUIRE(opened.comes_true([&] { return accuracy.pair().flip.has_value(); }));
  opened.session->references().drop();
  CHECK_FALSE(opened.session->can_show_errors());
}

TEST_CASE("references from files: read in the background, refused with a reason, dropped images too") {
  Opened opened("reference_file");
  REQUIRE(opened.finishes());
  write_pfm("good.pfm", {8, 8, std::vector<float>(192, 1.0f)});
  write_pfm("small.pfm", {4, 8, std::vector<float>(96, 1.0f)});
  opened.session->references().open("small.pfm");
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.session->messages().current().text == "small.pfm: found 4x8 pixels, expected 8x8 as the picture has");
  CHECK_FALSE(opened.session->accuracy().reference());
  opened.session->references().open_dropped(fs::absolute("good.pfm"));
  REQUIRE(opened.comes_true([&] { return opened.session->accuracy().reference() != nullptr; }));
  CHECK(opened.session->accuracy().is_true());
  Opened::write(0.125, "other.json");
  opened.session->references().open_dropped(fs::absolute("other.json"));
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK_FALSE(opened.session->accuracy().is_true());
}

TEST_CASE("the chart is exported, numbered; a folder that is gone is said") {
  Opened opened("export");
  opened.session->export_chart();
  CHECK(opened.session->messages().current().text == "there is no curve yet");
  REQUIRE(opened.finishes());
  opened.session->shown(Half::current, opened.session->renderers().latest(Half::current));
  opened.session->export_chart();
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return fs::exists("scene-chart-002.svg"); }));
  CHECK(fs::exists("scene-chart-001.csv"));
  const fs::path folder = fs::current_path();
  fs::remove_all(folder);
  opened.session->export_chart();
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  CHECK(opened.session->messages().current().text.find("scene-chart-003.csv: cannot write") != std::string::npos);
  opened.session->messages().dismiss();
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return opened.session->messages().current().error; }));
  fs::create_directories(folder);
}

TEST_CASE("a split view keeps the settings on its left, and follows edits of the scene with both") {
  Opened opened("split");
  REQUIRE(opened.finishes());
  Session& session = *opened.session;
  CHECK_FALSE(session.renderers().latest(Half::kept));
  session.set_split(true);
  session.set_split(false);
  session.set_split(true);
  Scene scene = session.editor().scene();
  scene.render.fresnel = FresnelKind::schlick;
  scene.render.sampler = SamplerKind::sobol;
  session.editor().edit(scene, 0);
  const auto both_finish = [&] {
    return opened.finishes() && opened.comes_true([&] {
      const auto kept = session.renderers().latest(Half::kept);
      return kept && kept->finished;
    });
  };
  REQUIRE(both_finish());
  CHECK(session.method(Half::kept) == "path · random");
  CHECK(session.method(Half::current) == "path · sobol · schlick");
  session.shown(Half::kept, session.renderers().latest(Half::kept));
  session.shown(Half::current, session.renderers().latest(Half::current));
  REQUIRE(opened.comes_true([&] { return session.accuracy().pair().flip.has_value(); }));
  const auto before = session.renderers().latest(Half::kept);
  opened.set_fuzz(1);
  REQUIRE(opened.finishes());
  REQUIRE(opened.comes_true([&] {
    return session.renderers().latest(Half::kept) != before && session.renderers().latest(Half::kept)->finished;
  }));
  CHECK(session.renderers().latest(Half::kept)->rgba != before->rgba);
  Opened::write(0.125, "other.json");
  session.editor().open(fs::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK_FALSE(session.renderers().split());
}

TEST_CASE("two scenes give the same picture if they differ in name and display only") {
  Scene a, b;
  b.name = "b";
  b.display.exposure = 1;
  CHECK(same_picture(a, b));
  b.camera.vfov = 50;
  CHECK_FALSE(same_picture(a, b));
}
