#include "core/image/image_io.h"
#include "tests/app/window/opened_session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <thread>

namespace tyndall::test::session_accuracy_test {
using test::OpenedSession;
namespace fs = std::filesystem;

TEST_CASE(
    "a reference is rendered with another seed; it is of other scenes after an edit, the old one again after undo") {
  OpenedSession opened("reference");
  REQUIRE(opened.finishes());
  const LiveAccuracy& accuracy = opened.session->accuracy;
  CHECK_FALSE(opened.session->can_show_errors());
  opened.session->render_reference();
  CHECK_FALSE(accuracy.is_true());  // nothing is called true before it is there
  REQUIRE(opened.comes_true([&] { return accuracy.is_true(); }));
  CHECK(accuracy.fit(Half::current) == ReferenceFit::fits);
  CHECK(accuracy.reference()->about == "this scene at 64 spp, seed 1");
  CHECK(opened.session->can_show_errors());
  opened.set_fuzz(0.5);
  REQUIRE(opened.finishes());
  CHECK(accuracy.fit(Half::current) == ReferenceFit::other_scene);
  opened.session->editor.undo();
  Scene scene = opened.session->editor.scene();
  scene.render.seed = 1;
  opened.session->editor.edit(scene, 0);
  REQUIRE(opened.finishes());
  CHECK(accuracy.fit(Half::current) == ReferenceFit::same_samples);
  opened.session->editor.undo();
  REQUIRE(opened.finishes());
  opened.session->shown(Half::current, opened.session->renderers.latest(Half::current));
  REQUIRE(opened.comes_true([&] { return accuracy.pair().flip.has_value(); }));
  opened.session->references.drop();
  CHECK_FALSE(opened.session->can_show_errors());
}

TEST_CASE("references from files: read in the background, refused with a reason, dropped images too") {
  OpenedSession opened("reference_file");
  REQUIRE(opened.finishes());
  write_pfm("good.pfm", {8, 8, std::vector<float>(192, 1.0f)});
  write_pfm("small.pfm", {4, 8, std::vector<float>(96, 1.0f)});
  opened.session->references.open("small.pfm");
  REQUIRE(opened.comes_true([&] { return opened.session->messages.current().error; }));
  CHECK(opened.session->messages.current().text == "small.pfm: found 4x8 pixels, expected 8x8 as the picture has");
  CHECK_FALSE(opened.session->accuracy.reference());
  opened.session->references.open_dropped(fs::absolute("good.pfm"));
  REQUIRE(opened.comes_true([&] { return opened.session->accuracy.reference() != nullptr; }));
  CHECK(opened.session->accuracy.is_true());
  OpenedSession::write(0.125, "other.json");
  opened.session->references.open_dropped(fs::absolute("other.json"));
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK_FALSE(opened.session->accuracy.is_true());
}

TEST_CASE("a dropped HDR is asked about once: as sky it is the background, which can be undone, or a reference") {
  OpenedSession opened("dropped_sky");
  REQUIRE(opened.finishes());
  write_hdr("sky.hdr", {8, 8, std::vector<float>(192, 1.0f)});
  Session& session = *opened.session;
  session.references.open_dropped(fs::absolute("sky.hdr"));
  fs::path asked;
  REQUIRE(opened.comes_true([&] { return !(asked = session.references.take_doubtful()).empty(); }));
  CHECK(asked == fs::absolute("sky.hdr"));
  CHECK(session.references.take_doubtful().empty());
  CHECK_FALSE(session.accuracy.reference());
  const Background before = session.editor.scene().background;
  session.editor.set_sky(asked);
  const auto sky = [&] { return std::get_if<SkyPicture>(&session.editor.scene().background); };
  REQUIRE(opened.comes_true([&] { return sky() != nullptr; }));
  CHECK(sky()->file == "sky.hdr");
  CHECK(sky()->pixels->width == 8);
  session.editor.undo();
  CHECK(session.editor.scene().background == before);
  session.references.open(asked);
  REQUIRE(opened.comes_true([&] { return session.accuracy.reference() != nullptr; }));
  write_pfm("wrong.pfm", {8, 8, std::vector<float>(192, -1.0f)});
  session.editor.set_sky("wrong.pfm");
  REQUIRE(opened.comes_true([&] { return session.messages.current().error; }));
  CHECK(session.messages.current().text.find("found -1 in pixel (0, 0)") != std::string::npos);
}

TEST_CASE("a split view keeps the settings on its left, and follows edits of the scene with both") {
  OpenedSession opened("split");
  REQUIRE(opened.finishes());
  Session& session = *opened.session;
  CHECK_FALSE(session.renderers.latest(Half::kept));
  const auto restarts = session.wanted.restarts;
  session.set_split(true);
  CHECK(session.wanted.restarts == restarts + 1);  // both halves begin together
  session.set_split(false);
  session.set_split(true);
  Scene scene = session.editor.scene();
  scene.render.fresnel = FresnelKind::schlick;
  scene.render.sampler = SamplerKind::sobol;
  session.editor.edit(scene, 0);
  const auto both_finish = [&] {
    return opened.finishes() && opened.comes_true([&] {
      const auto kept = session.renderers.latest(Half::kept);
      return kept && kept->finished;
    });
  };
  REQUIRE(both_finish());
  CHECK(session.method(Half::kept) == "path · random");
  CHECK(session.method(Half::current) == "path · sobol · schlick");
  session.shown(Half::kept, session.renderers.latest(Half::kept));
  session.shown(Half::current, session.renderers.latest(Half::current));
  REQUIRE(opened.comes_true([&] { return session.accuracy.pair().flip.has_value(); }));
  const auto before = session.renderers.latest(Half::kept);
  opened.set_fuzz(1);
  REQUIRE(opened.finishes());
  REQUIRE(opened.comes_true([&] {
    return session.renderers.latest(Half::kept) != before && session.renderers.latest(Half::kept)->finished;
  }));
  CHECK(session.renderers.latest(Half::kept)->rgba != before->rgba);
  OpenedSession::write(0.125, "other.json");
  session.editor.open(fs::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return opened.fuzz() == 0.125; }));
  CHECK_FALSE(session.split());
}

TEST_CASE("a reference that is being rendered is given up when the scene changes") {
  OpenedSession opened("reference_stops");
  REQUIRE(opened.finishes());
  Scene scene = opened.session->editor.scene();
  scene.width = scene.height = 512;
  scene.render.spp = 1;
  opened.session->editor.edit(scene, 0);
  REQUIRE(opened.finishes());
  opened.session->render_reference();
  opened.set_fuzz(0.5);
  REQUIRE(opened.comes_true(
      [&] { return opened.session->messages.current().text == "no reference: the scene was changed"; }));
  REQUIRE(opened.comes_true([&] { return !opened.session->references.busy(); }));
  CHECK_FALSE(opened.session->accuracy.reference());
}

TEST_CASE("where the window gives the picture its size, references are of that size") {
  OpenedSession opened("reference_of_window");
  Session& session = *opened.session;
  session.set_picture_size(PictureSize{16, 12});
  REQUIRE(opened.finishes());
  session.render_reference();
  REQUIRE(opened.comes_true([&] { return !session.references.busy(); }));
  CHECK(session.messages.current().text == "reference: this scene at 64 spp, seed 1");
  CHECK(session.accuracy.is_true());
  session.references.drop();
  write_pfm("window.pfm", {16, 12, std::vector<float>(3 * 16 * 12, 1.0f)});
  session.references.open("window.pfm");
  REQUIRE(opened.comes_true([&] { return session.accuracy.is_true(); }));
  write_pfm("file.pfm", {8, 8, std::vector<float>(192, 1.0f)});
  session.references.open_dropped("file.pfm");
  REQUIRE(opened.comes_true([&] { return session.messages.current().error; }));
  CHECK(session.messages.current().text == "file.pfm: found 8x8 pixels, expected 16x12 as the picture has");
}

TEST_CASE("a reference in place of one that is being rendered counts its own samples") {
  OpenedSession opened("reference_again");
  REQUIRE(opened.finishes());
  Session& session = *opened.session;
  LoadedScene other = load_scene("scene.json");
  other.scene.render.spp = 50'000'000;
  session.render_reference(other);
  const auto text = [&] { return session.messages.current().text; };
  REQUIRE(opened.comes_true([&] { return text().find(',') < text().find(" of 50,000,000 spp"); }));
  session.render_reference();
  const std::string most = "rendering a reference with another seed: 64 of 64 spp";
  while (session.references.busy()) {
    session.collect();
    if (text().ends_with(" of 64 spp")) CHECK_MESSAGE(text().size() <= most.size(), text());
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  CHECK(session.accuracy.is_true());
}

}  // namespace tyndall::test::session_accuracy_test
