#include "app/window/accuracy/live_accuracy.h"
#include "app/window/panels/panels.h"
#include "tests/app/window/scenes.h"
#include "tests/support/news.h"

#include <cmath>

namespace tyndall::test::live_accuracy_test {

namespace {

constexpr int columns = 16, rows = 12;

std::shared_ptr<const Scene> scene_with(std::uint32_t seed) {
  auto scene = std::make_shared<Scene>();
  scene->width = columns, scene->height = rows;
  scene->render.seed = seed;
  return scene;
}

/// A grey picture; estimated error 20 %.
std::shared_ptr<Frame> picture(float grey, std::uint64_t edit, double seconds) {
  auto frame = std::make_shared<Frame>();
  frame->width = columns, frame->height = rows;
  frame->edit = edit;
  frame->pass = frame->spp = static_cast<std::uint32_t>(100 * seconds);
  frame->seconds = seconds;
  frame->relative_error = 0.2 / std::sqrt(seconds);
  for (int i = 0; i < columns * rows; ++i) frame->rgba.insert(frame->rgba.end(), {grey, grey, grey, 1.0f});
  return frame;
}

struct Watched {
  News news;
  double now = 0;  ///< seconds; they do not pass by themselves
  LiveAccuracy accuracy{[this] { news.tell(); }, [this] { return now; }};

  Watched() { accuracy.set_scene(Half::current, scene_with(0)); }
  void refer_to(float grey) {
    accuracy.set_reference(std::make_shared<const Reference>(
        Reference{{columns, rows, std::vector<float>(3 * columns * rows, grey)}, 0, "grey.exr", *scene_with(9), true}));
  }
  void show(float grey, std::uint64_t edit, double seconds, Half half = Half::current, bool resting = true) {
    accuracy.set_resting(resting);
    accuracy.shown(half, picture(grey, edit, seconds), "mis", true);
  }
  template <class Condition>
  bool comes_true(const Condition& condition) {
    return news.wait_until([&] {
      accuracy.collect();
      return condition();
    });
  }
  bool measures() {
    return comes_true([&] { return accuracy.pair().flip && !points().empty(); });
  }
  const std::vector<ErrorPoint>& points(Half half = Half::current) { return accuracy.curves(half).current().points; }
  /// The error of the only point of the curve.
  double error(Half half = Half::current) {
    REQUIRE(points(half).size() == 1);
    return points(half)[0].rel_mse;
  }
  std::string lines() {
    std::string text;
    for (const AccuracyLine& line : accuracy_lines(accuracy)) text += (line.warning ? "! " : "") + line.text + "\n";
    return text;
  }
};

}  // namespace

TEST_CASE("with a reference the curve shows the true error, and without one the estimated error") {
  Watched w;
  w.show(1, 1, 1);
  w.show(1, 1, 4);
  CHECK_FALSE(w.accuracy.is_true());
  REQUIRE(w.points().size() == 2);
  CHECK(w.points()[0].rel_mse == doctest::Approx(0.04));
  CHECK(w.points()[1].noise == doctest::Approx(0.01));
  CHECK(w.lines().empty());
  Watched measured;
  measured.refer_to(1);
  CHECK(measured.accuracy.is_true());
  CHECK(measured.lines() == "against grey.exr\n");
  measured.show(1.1f, 1, 1);
  REQUIRE(measured.measures());
  CHECK(measured.error() == about(0.01 / 1.01));
  CHECK(measured.points()[0].noise == doctest::Approx(0.04));
  CHECK(measured.lines().starts_with("against grey.exr · FLIP 0"));
  CHECK(measured.lines().ends_with(" at 100 spp\n"));
  measured.accuracy.set_reference(nullptr);
  CHECK(measured.error() == doctest::Approx(0.04));
}

TEST_CASE("pictures of the scene before are not measured, and results against the former reference are dropped") {
  Watched w;
  w.refer_to(1);
  w.accuracy.shown(Half::current, picture(1.5f, 1, 1), "mis", false);
  CHECK_FALSE(w.accuracy.busy());
  CHECK_FALSE(w.accuracy.pair().flip);
  CHECK(w.points().empty());
  w.show(1.1f, 2, 1);
  REQUIRE(w.measures());
  CHECK(w.accuracy.curves(Half::current).earlier().empty());
  CHECK(w.error() == about(0.01 / 1.01));
  Watched other;
  other.refer_to(1);
  other.show(1.1f, 1, 1);  // is being measured
  other.refer_to(0.5f);
  REQUIRE(other.measures());
  CHECK(other.error() == about(0.36 / 0.26));
}

TEST_CASE("maps come for the view that is on, and follow the pictures") {
  Watched w;
  const auto map = [&] { return w.accuracy.map(); };
  w.refer_to(1);
  w.show(1.1f, 1, 1);
  CHECK_FALSE(map());
  w.accuracy.set_view(ErrorView::error);
  REQUIRE(w.comes_true([&] { return map() != nullptr; }));
  CHECK(map()->width == columns);
  CHECK(map()->rgba[0] == about(std::sqrt(0.01 / 1.01)));
  w.show(1.2f, 1, 2);
  REQUIRE(w.comes_true([&] { return map()->rgba[0] > 0.15f; }));
  w.accuracy.set_view(ErrorView::flip);
  CHECK_FALSE(map());
  REQUIRE(w.comes_true([&] { return map() != nullptr; }));
  CHECK(map()->view == ErrorView::flip);
  w.accuracy.set_view(ErrorView::none);
  CHECK_FALSE(map());
}

TEST_CASE("halves are measured against each other, and each against the reference") {
  Watched w;
  const auto difference = [&] { return w.accuracy.pair().rel_mse; };
  w.accuracy.set_split(true);
  w.accuracy.set_scene(Half::kept, scene_with(0));
  w.show(1, 1, 1, Half::kept);
  w.show(1.2f, 1, 1);
  REQUIRE(w.comes_true([&] { return difference() && w.accuracy.pair().flip; }));
  CHECK(*difference() == about(0.04 / 1.01));
  CHECK(w.lines().starts_with("B against A: relMSE 0.04 · FLIP 0"));
  w.refer_to(1.1f);
  REQUIRE(w.comes_true([&] { return !w.points().empty() && !w.points(Half::kept).empty(); }));
  CHECK(w.error() == about(0.01 / 1.22, 1e-3));
  CHECK(w.error(Half::kept) == about(0.01 / 1.22, 1e-3));
  w.show(1, 1, 2, Half::kept);  // the other half shows nothing new
  w.show(1.5f, 1, 2);
  REQUIRE(w.comes_true([&] { return difference() && *difference() > 0.2; }));
  w.accuracy.set_split(false);
  CHECK(w.points(Half::kept).empty());
  CHECK(w.lines().find("B against A") == std::string::npos);
}

TEST_CASE("while it renders, a new picture is not always measured at once") {
  Watched w;
  w.refer_to(1);
  const auto points_after = [&](double seconds) {
    w.show(1.1f + 0.1f * static_cast<float>(seconds), 1, seconds, Half::current, false);
    REQUIRE(w.comes_true([&] { return !w.accuracy.busy(); }));
    return w.points().size();
  };
  for (int k = 0; k < 250; ++k) CHECK(points_after(1 + 0.001 * k) == 1);  // the first has used up its fraction of time
  CHECK(points_after(1.3) == 2);  // a curve gets its first points early, whenever its time has grown by a quarter
  w.now += 1000;
  CHECK(points_after(1.6) == 3);
  CHECK(points_after(1.61) == 3);
}

}  // namespace tyndall::test::live_accuracy_test
