#include "tests/app/window/opened_session.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <array>

namespace tyndall::test::session_picture_test {
using test::OpenedSession;

namespace {

/// A session over a picture of 2 x 2 pixels that comes by a pipe.
struct PictureSession : OpenedSession {
  std::array<int, 2> ends{-1, -1};

  explicit PictureSession(const std::string& name) : OpenedSession(name) {
    REQUIRE(pipe(ends.data()) == 0);
    write_rows("P3 2 2 255 ");
    session.reset();
    WindowOptions options;
    options.picture =
        std::make_shared<ArrivingPicture>(ends[0], beginning_of(ends[0]).bytes, "standard input", PpmCurve::srgb);
    options.scene.name = "standard input";
    options.scene.is_picture = true;
    options.scene.scene.width = options.scene.scene.height = 2;
    options.scene.scene.render.spp = 1;
    options.threads = 1;
    session = std::make_unique<Session>(
        options, [this] { news.tell(); }, [this] { news.tell(); }, nullptr);
  }
  ~PictureSession() {
    session.reset();
    close_writer();
    close(ends[0]);
  }
  void write_rows(const std::string& text) const {
    REQUIRE(::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size()));
  }
  void close_writer() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
  /// Whether so much of the picture has come; pixels are shown as soon as they are there, which is told of later.
  bool says(const std::string& arrived) {
    return comes_true([&] { return session->arrived() == arrived; });
  }
  /// Whether the frame of the newest request has these values of red.
  bool shows(const std::array<float, 4>& red) {
    return comes_true([&] {
      const auto frame = session->renderers.latest(Half::current);
      if (!frame || !frame->finished || frame->rgba.size() != 16) return false;
      for (std::size_t i = 0; i < 4; ++i)
        if (frame->rgba[4 * i] != red[i]) return false;
      return true;
    });
  }
};

}  // namespace

TEST_CASE("a picture that is being written is shown row by row, and stays where it ends") {
  PictureSession opened("picture");
  REQUIRE(opened.shows({0, 0, 0, 0}));
  CHECK(opened.session->shows_picture());
  CHECK(opened.session->arrived() == "row 0 of 2");
  CHECK_FALSE(opened.session->at_rest());
  opened.write_rows("255 0 0 255 0 0 ");
  REQUIRE(opened.shows({1, 1, 0, 0}));
  CHECK(opened.says("row 1 of 2"));
  opened.close_writer();
  REQUIRE(opened.comes_true([&] { return opened.session->at_rest(); }));
  CHECK(opened.session->arrived() == "ended at row 1 of 2");
  CHECK(opened.session->messages.current().text == "ended at row 1 of 2");
  CHECK(opened.shows({1, 1, 0, 0}));
}

TEST_CASE("how a picture is displayed is no edit that could be lost; a snapshot holds no scene") {
  PictureSession opened("picture_display");
  opened.write_rows("255 0 0 0 0 0 255 0 0 0 0 0\n");
  REQUIRE(opened.shows({1, 0, 1, 0}));
  CHECK(opened.says("all 2 rows"));
  Scene scene = opened.session->editor.scene();
  scene.display.exposure = 1;
  opened.session->editor.edit(scene, 0);
  CHECK(opened.session->unsaved() == nullptr);
  scene.display.exposure = 0;
  opened.session->editor.edit(scene, 0);
  opened.session->snapshot();
  REQUIRE(opened.comes_true([&] { return opened.session->saving.idle(); }));
  CHECK(std::filesystem::exists("image-001.png"));
  CHECK(read_image("image-001.png").rgb == std::vector<float>{1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
  CHECK_FALSE(read_embedded_scene("image-001.png"));
}

TEST_CASE("another scene takes a picture's place, and undo brings it back") {
  PictureSession opened("picture_scene");
  opened.write_rows("255 0 0 0 0 0 255 0 0 0 0 0\n");
  REQUIRE(opened.shows({1, 0, 1, 0}));
  OpenedSession::write(0.125, "other.json");
  opened.session->editor.open(std::filesystem::absolute("other.json").string());
  REQUIRE(opened.comes_true([&] { return !opened.session->shows_picture(); }));
  CHECK(opened.finishes());
  CHECK(opened.session->renderers.latest(Half::current)->width == 8);
  opened.session->editor.undo();
  CHECK(opened.session->shows_picture());
  CHECK(opened.shows({1, 0, 1, 0}));
}

}  // namespace tyndall::test::session_picture_test
