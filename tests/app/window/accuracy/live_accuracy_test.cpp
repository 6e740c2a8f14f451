#include "app/window/accuracy/live_accuracy.h"

#include "app/window/panels/panels.h"
#include "tests/support/news.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tyndall::test::live_accuracy_test {

namespace {

constexpr int columns = 16, rows = 12;

Scene scene_with(double vfov, std::uint32_t seed = 0) {
  Scene scene;
  scene.width = columns, scene.height = rows;
  scene.camera.vfov = vfov;
  scene.render.seed = seed;
  return scene;
}

/// A grey picture; estimated error 20 %.
std::shared_ptr<Frame> picture(float grey, std::uint64_t edit, double seconds) {
  auto frame = std::make_shared<Frame>();
  frame->width = columns, frame->height = rows;
  frame->edit = edit;
  frame->spp = static_cast<std::uint32_t>(100 * seconds);
  frame->pass = frame->spp;
  frame->seconds = seconds;
  frame->relative_error = 0.2 / std::sqrt(seconds);
  for (int i = 0; i < columns * rows; ++i) frame->rgba.insert(frame->rgba.end(), {grey, grey, grey, 1.0f});
  return frame;
}

std::shared_ptr<const Reference> reference(float grey, const Scene& scene) {
  return std::make_shared<const Reference>(Reference{{columns, rows, std::vector<float>(3 * columns * rows, grey)},
                                                     0,
                                                     grey < 1 ? "dark.exr" : "light.exr",
                                                     scene,
                                                     true});
}

struct Watched {
  test::News news;
  double now = 0;  ///< seconds; they do not pass by themselves
  LiveAccuracy accuracy{[this] { news.tell(); }, [this] { return now; }};

  Watched() { accuracy.set_scene(Half::current, std::make_shared<const Scene>(scene_with(40))); }
  void show(const std::shared_ptr<Frame>& frame, Half half = Half::current, bool resting = true) {
    accuracy.set_resting(resting);
    accuracy.shown(half, frame, "mis", true);
  }
  template <class Condition>
  bool comes_true(const Condition& condition) {
    return news.wait_until([&] {
      accuracy.collect();
      return condition();
    });
  }
  const std::vector<ErrorPoint>& points(Half half = Half::current) { return accuracy.curves(half).current().points; }
  std::string lines() {
    std::string text;
    for (const AccuracyLine& line : accuracy_lines(accuracy)) text += (line.warning ? "! " : "") + line.text + "\n";
    return text;
  }
};

}  // namespace

TEST_CASE("without a reference the curve shows the estimated error") {
  Watched w;
  w.show(picture(1, 1, 1));
  w.show(picture(1, 1, 4));
  CHECK_FALSE(w.accuracy.is_true());
  REQUIRE(w.points().size() == 2);
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.04));
  CHECK(w.points()[1].noise == doctest::Approx(0.01));
  CHECK(w.lines().empty());
}

TEST_CASE("with a reference the curve shows the true error, and without it the estimated one again") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  CHECK(w.accuracy.is_true());
  CHECK(w.lines() == "against light.exr\n");
  w.show(picture(1.1f, 1, 1));
  REQUIRE(w.comes_true([&] { return w.points().size() == 1 && w.accuracy.pair().flip; }));
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.01 / 1.01).epsilon(1e-4).scale(0));
  CHECK(w.points()[0].noise == doctest::Approx(0.04));
  CHECK(w.lines().find("against light.exr · FLIP 0") == 0);
  CHECK(w.lines().find(" at 100 spp\n") != std::string::npos);
  w.accuracy.set_reference(nullptr);
  REQUIRE(w.points().size() == 1);
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.04));
}

TEST_CASE("a reference of another scene stays but is not compared with; of the same scene by another method it is") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  w.accuracy.set_scene(Half::current, std::make_shared<const Scene>(scene_with(50)));
  CHECK_FALSE(w.accuracy.is_true());
  CHECK(w.lines() == "! reference of another scene: light.exr\n");
  w.show(picture(1.1f, 2, 1));
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.04));
  Scene other = scene_with(40);
  other.render.fresnel = FresnelKind::schlick;
  w.accuracy.set_scene(Half::current, std::make_shared<const Scene>(other));
  CHECK(w.accuracy.is_true());
  w.accuracy.set_scene(Half::current, std::make_shared<const Scene>(scene_with(40, 9)));
  CHECK(w.lines() == "! same random numbers, noise looks too small: light.exr\n");
}

TEST_CASE("a picture of the scene before is not measured against the reference of this one") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  w.accuracy.shown(Half::current, picture(1.5f, 1, 1), "mis", false);
  CHECK_FALSE(w.accuracy.busy());
  CHECK_FALSE(w.accuracy.pair().flip);
  CHECK(w.points().empty());
  w.show(picture(1.1f, 2, 1));
  REQUIRE(w.comes_true([&] { return w.accuracy.pair().flip && !w.points().empty(); }));
  CHECK(w.accuracy.curves(Half::current).earlier().empty());
  REQUIRE(w.points().size() == 1);
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.01 / 1.01).epsilon(1e-4).scale(0));
}

TEST_CASE("what was measured against the former reference is dropped") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  w.show(picture(1.1f, 1, 1));  // is being measured
  w.accuracy.set_reference(reference(0.5f, scene_with(40, 9)));
  REQUIRE(w.comes_true([&] { return w.accuracy.pair().flip && !w.points().empty(); }));
  REQUIRE(w.points().size() == 1);
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.36 / 0.26).epsilon(1e-4).scale(0));
}

TEST_CASE("maps come for the view that is on, and follow the pictures") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  w.show(picture(1.1f, 1, 1));
  CHECK_FALSE(w.accuracy.map());
  w.accuracy.set_view(ErrorView::error);
  REQUIRE(w.comes_true([&] { return w.accuracy.map() != nullptr; }));
  CHECK(w.accuracy.map()->width == columns);
  CHECK(w.accuracy.map()->rgba[0] == doctest::Approx(std::sqrt(0.01 / 1.01)).epsilon(1e-4).scale(0));
  w.show(picture(1.2f, 1, 2));
  REQUIRE(w.comes_true([&] { return w.accuracy.map()->rgba[0] > 0.15f; }));
  w.accuracy.set_view(ErrorView::flip);
  CHECK_FALSE(w.accuracy.map());
  REQUIRE(w.comes_true([&] { return w.accuracy.map() != nullptr; }));
  CHECK(w.accuracy.map()->view == ErrorView::flip);
  w.accuracy.set_view(ErrorView::none);
  CHECK_FALSE(w.accuracy.map());
}

TEST_CASE("halves are measured against each other, and each against the reference") {
  Watched w;
  w.accuracy.set_split(true);
  w.accuracy.set_scene(Half::kept, std::make_shared<const Scene>(scene_with(40)));
  w.show(picture(1, 1, 1), Half::kept);
  w.show(picture(1.2f, 1, 1));
  REQUIRE(w.comes_true([&] { return w.accuracy.pair().rel_mse && w.accuracy.pair().flip; }));
  CHECK(*w.accuracy.pair().rel_mse == doctest::Approx(0.04 / 1.01).epsilon(1e-4).scale(0));
  CHECK(w.lines().find("B against A: relMSE 0.04 · FLIP 0") == 0);
  w.accuracy.set_reference(reference(1.1f, scene_with(40, 9)));
  REQUIRE(w.comes_true([&] { return !w.points().empty() && !w.points(Half::kept).empty(); }));
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.01 / 1.22).epsilon(1e-3).scale(0));
  CHECK(w.points(Half::kept)[0].rel_mse == doctest::Approx(0.01 / 1.22).epsilon(1e-3).scale(0));
  w.show(picture(1, 1, 2), Half::kept);  // the other half shows nothing new
  w.show(picture(1.5f, 1, 2));
  REQUIRE(w.comes_true([&] { return w.accuracy.pair().rel_mse && *w.accuracy.pair().rel_mse > 0.2; }));
  w.accuracy.set_split(false);
  CHECK(w.points(Half::kept).empty());
  CHECK(w.lines().find("B against A") == std::string::npos);
}

TEST_CASE("while it renders, a new picture is not always measured at once") {
  Watched w;
  w.accuracy.set_reference(reference(1, scene_with(40, 9)));
  const auto show_and_measure = [&](double seconds) {
    w.show(picture(1.1f + 0.1f * static_cast<float>(seconds), 1, seconds), Half::current, false);
    REQUIRE(w.comes_true([&] { return !w.accuracy.busy(); }));
    return w.points().size();
  };
  CHECK(show_and_measure(1) == 1);
  for (int k = 1; k < 250; ++k)
    CHECK(show_and_measure(1 + 0.001 * k) == 1);  // measuring has used up its fraction of time
  CHECK(show_and_measure(1.3) == 2);  // a curve gets its first points early, whenever its time has grown by a quarter
  w.now += 1000;
  CHECK(show_and_measure(1.6) == 3);
  CHECK(show_and_measure(1.61) == 3);
}

}  // namespace tyndall::test::live_accuracy_test
