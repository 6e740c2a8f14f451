#include "app/window/panels/panels.h"
#include "core/image/image_io.h"
#include "tests/app/window/opened_session.h"

#include <chrono>
#include <thread>

namespace tyndall::test::session_accuracy_test {
namespace fs = std::filesystem;

namespace {

LinearImage grey(int width, int height, float value = 1) {
  return {width, height, std::vector<float>(static_cast<std::size_t>(3 * width * height), value)};
}

/// A session whose first picture is finished.
struct Measured : OpenedSession {
  explicit Measured(const std::string& name) : OpenedSession(name) { REQUIRE(finishes()); }
  const LiveAccuracy& accuracy() const { return session->accuracy; }
  bool has_reference() {
    return comes_true([&] { return session->accuracy.is_true(); });
  }
  bool knows_flip() {
    return comes_true([&] { return session->accuracy.pair().flip.has_value(); });
  }
};

}  // namespace

TEST_CASE("a reference is rendered with another seed; it is of other scenes after an edit, until undo") {
  Measured opened("reference");
  Session& session = *opened.session;
  const auto fit = [&] {
    REQUIRE(opened.finishes());
    return opened.accuracy().fit(Half::current);
  };
  CHECK_FALSE(session.can_show_errors());
  session.render_reference();
  CHECK_FALSE(opened.accuracy().is_true());  // nothing is called true before it is there
  REQUIRE(opened.has_reference());
  CHECK(fit() == ReferenceFit::fits);
  CHECK(opened.accuracy().reference()->about == "this scene at 64 spp, seed 1");
  CHECK(session.can_show_errors());
  opened.set_fuzz(0.5);
  CHECK(fit() == ReferenceFit::other_scene);
  CHECK_FALSE(opened.accuracy().is_true());
  opened.editor().undo();
  opened.edit([](Scene& scene) { scene.render.seed = 1; });
  CHECK(fit() == ReferenceFit::same_samples);
  CHECK(accuracy_lines(opened.accuracy())[0].text.starts_with("same random numbers, noise looks too small: "));
  opened.editor().undo();
  REQUIRE(opened.finishes());
  opened.show();
  REQUIRE(opened.knows_flip());
  session.references.drop();
  CHECK_FALSE(session.can_show_errors());
}

TEST_CASE("dropped images are references, or are asked about: an HDR as sky is the background, which can be undone") {
  Measured opened("dropped");
  write_pfm("good.pfm", grey(8, 8));
  write_hdr("sky.hdr", grey(8, 8));
  Session& session = *opened.session;
  session.references.open_dropped(fs::absolute("good.pfm"));
  REQUIRE(opened.has_reference());
  OpenedSession::write(0.125, "other.json");
  session.references.open_dropped(fs::absolute("other.json"));
  REQUIRE(opened.becomes(0.125));
  CHECK_FALSE(opened.accuracy().is_true());
  session.references.drop();
  session.references.open_dropped(fs::absolute("sky.hdr"));
  fs::path asked;
  REQUIRE(opened.comes_true([&] { return !(asked = session.references.take_doubtful()).empty(); }));
  CHECK(asked == fs::absolute("sky.hdr"));
  CHECK(session.references.take_doubtful().empty());
  CHECK_FALSE(opened.accuracy().reference());
  const Background before = opened.scene().background;
  session.editor.set_sky(asked);
  const auto sky = [&] { return std::get_if<SkyPicture>(&opened.scene().background); };
  REQUIRE(opened.comes_true([&] { return sky() != nullptr; }));
  CHECK(sky()->file == "sky.hdr");
  CHECK(sky()->pixels->width == 8);
  session.editor.undo();
  CHECK(opened.scene().background == before);
  session.references.open(asked);
  REQUIRE(opened.has_reference());
  write_pfm("wrong.pfm", grey(8, 8, -1));
  session.editor.set_sky("wrong.pfm");
  REQUIRE(opened.complains());
  CHECK(opened.message().find("found -1 in pixel (0, 0)") != std::string::npos);
}

TEST_CASE("a split view keeps the settings on its left, and follows edits of the scene with both") {
  Measured opened("split");
  Session& session = *opened.session;
  const auto kept_finishes = [&](const std::shared_ptr<const Frame>& other_than) {
    return opened.finishes() && opened.comes_true([&] {
      const auto kept = opened.frame(Half::kept);
      return kept && kept != other_than && kept->finished;
    });
  };
  CHECK_FALSE(opened.frame(Half::kept));
  const auto restarts = session.wanted.restarts;
  session.set_split(true);
  CHECK(session.wanted.restarts == restarts + 1);  // both halves begin together
  session.set_split(false);
  session.set_split(true);
  opened.edit([](Scene& scene) {
    scene.render.fresnel = FresnelKind::schlick;
    scene.render.sampler = SamplerKind::sobol;
  });
  REQUIRE(kept_finishes(nullptr));
  CHECK(session.method(Half::kept) == "path · random");
  CHECK(session.method(Half::current) == "path · sobol · schlick");
  opened.show(Half::kept);
  opened.show();
  REQUIRE(opened.knows_flip());
  const auto before = opened.frame(Half::kept);
  opened.set_fuzz(1);
  REQUIRE(kept_finishes(before));
  CHECK(opened.frame(Half::kept)->rgba != before->rgba);
  OpenedSession::write(0.125, "other.json");
  REQUIRE(opened.opens("other.json", 0.125));
  CHECK_FALSE(session.split());
}

TEST_CASE("a reference that is being rendered is given up when the scene changes, or for another one") {
  Measured opened("reference_again");
  Session& session = *opened.session;
  LoadedScene other = load_scene("scene.json");
  other.scene.render.spp = 50'000'000;
  const auto begins = [&] {
    session.render_reference(other);
    return opened.comes_true([&] { return opened.message().find(',') < opened.message().find(" of 50,000,000 spp"); });
  };
  REQUIRE(begins());
  session.render_reference();
  const std::string most = "rendering a reference with another seed: 64 of 64 spp";
  while (session.references.busy()) {
    session.collect();
    if (opened.message().ends_with(" of 64 spp")) CHECK(opened.message().size() <= most.size());
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  CHECK(opened.accuracy().is_true());
  session.references.drop();
  opened.edit([](Scene& scene) { scene.render.spp = 50'000'000; });
  session.render_reference();
  opened.set_fuzz(0.5);
  REQUIRE(opened.comes_true([&] { return opened.message() == "no reference: the scene was changed"; }));
  REQUIRE(opened.comes_true([&] { return !session.references.busy(); }));
  CHECK_FALSE(opened.accuracy().reference());
}

TEST_CASE("where the window gives the picture its size, references are of that size") {
  Measured opened("reference_of_window");
  Session& session = *opened.session;
  session.set_picture_size(PictureSize{16, 12});
  REQUIRE(opened.finishes());
  session.render_reference();
  REQUIRE(opened.comes_true([&] { return !session.references.busy(); }));
  CHECK(opened.message() == "reference: this scene at 64 spp, seed 1");
  CHECK(opened.accuracy().is_true());
  session.references.drop();
  write_pfm("window.pfm", grey(16, 12));
  session.references.open("window.pfm");
  REQUIRE(opened.has_reference());
  write_pfm("file.pfm", grey(8, 8));
  session.references.open_dropped("file.pfm");
  REQUIRE(opened.complains());
  CHECK(opened.message() == "file.pfm: found 8x8 pixels, expected 16x12 as the picture has");
}

}  // namespace tyndall::test::session_accuracy_test
