#include "app/window/overlays.h"
#include "tests/app/window/scenes.h"

#include <limits>

namespace tyndall::test::status_test {

namespace {

/// A scene with light, and what a drawing of it goes by.
struct Shown : Context {
  Frame picture;
  Scene scene;

  Shown() {
    auto from = std::make_shared<Origin>();
    from->title = "showroom.json";
    origin = from;
    scene.background = Vec3d{1, 1, 1};
  }
  std::vector<StatusCell> cells() {
    frame = std::make_shared<const Frame>(picture);
    return status_cells(*this, scene);
  }
  std::string text() {
    std::string text;
    for (const StatusCell& cell : cells()) text += cell.key + "=" + cell.value + ";";
    return text;
  }
  /// Whether the line has all of these cells; they are divided by bars.
  void has(const std::string& expected) {
    std::istringstream parts(expected);
    for (std::string part; std::getline(parts, part, '|');) CHECK_MESSAGE(text().find(part) != std::string::npos, part);
  }
  void lacks(const std::string& words) { CHECK_MESSAGE(text().find(words) == std::string::npos, words); }
};

ErrorCurve run(double rel_mse, std::uint64_t edit = 3) { return {"", {{10, rel_mse}}, edit}; }

}  // namespace

TEST_CASE("the status line tells what is on the screen, and leaves out what is not known yet") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.spp = 1024;
  frame.relative_error = 0.0111;
  frame.seconds = 10;
  frame.mrays_per_s = 148;
  frame.isa = "avx512";
  frame.lanes = 32;
  frame.threads = 2;
  frame.film_bytes = 103'000'000;
  const ErrorCurve curve = run(1.23e-4, 0);
  shown.run = &curve;
  shown.has("=rendering;|spp=1,024;|error=1.1 %;|to 1 %=2.3 s;|=148 Mrays/s;|avx512 x32=2 threads;|film=103 MB;");
  shown.has("rejected=0;|=mis · sobol;|showroom.json=;");
  Shown begun;
  begun.picture.step = 8;
  begun.picture.relative_error = std::numeric_limits<double>::infinity();
  begun.wanted.paused = true;
  begun.has("=paused;|spp=1/64;|error=?;|to 1 %=?;");
  CHECK(status_cells(Context{}, Scene{}).front().value == "starting");
}

TEST_CASE("the status line tells the errors of both pictures, the true ones, and what is only estimated") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.edit = 3;
  frame.spp = 20;
  frame.relative_error = 0.041;
  const ErrorCurve raw = run(1.6e-3), filtered = run(1e-4);
  shown.is_true = true, shown.run = &raw;
  shown.has("true error=4 %;estimated=4.1 %;");
  frame.edit = 4;  // this edit's error has not been measured yet
  shown.has("true error=?;estimated=4.1 %;");
  frame.edit = 3;
  shown.split = true;
  CHECK(shown.text().starts_with("B=rendering;"));
  shown.split = shown.is_true = false;
  auto clean = std::make_shared<CleanFrame>();
  clean->relative_error = 0.009;
  clean->spp = 16;
  frame.clean = clean;
  shown.has("clean=0.9 %;|raw=4.1 %;");
  shown.lacks("rough");
  clean->spp = 8;
  shown.has("=rough below 16 spp;");
  shown.is_true = true, shown.clean_run = &filtered;
  shown.has("true clean=1 %;|true raw=4 %;|estimated=4.1 %;");
}

TEST_CASE("rejected samples and approximations are warnings, edits are shown") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.finished = true;
  frame.rejected = 3;
  shown.edited = true;
  shown.scene.render.fresnel = FresnelKind::schlick;
  const std::vector<StatusCell> cells = shown.cells();
  CHECK(std::count_if(cells.begin(), cells.end(), [](const StatusCell& cell) { return cell.warning; }) == 2);
  CHECK(cells.front().value == "finished");
  CHECK(cells.back().value == "edited");
  frame.cut_throughput = 0.02;
  shown.has("cut off=2 %;");
  frame.cut_throughput = 1e-5;
  shown.lacks("cut off");
}

TEST_CASE("without room the least important cells go first, and the state always stays") {
  const std::vector<StatusCell> cells{{"", "state", 0}, {"", "a", 3}, {"", "b", 5}, {"", "c", 3}};
  const std::vector<float> widths{50, 50, 50, 50};
  CHECK(fitting_cells(cells, widths, 200) == std::vector<std::size_t>{0, 1, 2, 3});
  CHECK(fitting_cells(cells, widths, 199) == std::vector<std::size_t>{0, 1, 3});
  CHECK(fitting_cells(cells, widths, 60).front() == 0);
  CHECK(fitting_cells(cells, widths, 0) == std::vector<std::size_t>{0});
}

TEST_CASE("a scene without light says what it lacks, and not that its error is 0 %") {
  Shown shown;
  shown.picture.spp = 4;
  shown.scene.background = Vec3d{0, 0, 0};
  shown.has("=empty scene: add an object and a lamp;");
  shown.lacks("error");
  shown.scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  shown.scene.objects = {ball("", {0, 0, -2})};
  shown.has("=no light in this scene: add a lamp;");
  shown.scene.materials[0].kind = Light<>{};
  shown.has("error=");
}

TEST_CASE("the status line of a picture that a program writes tells how much is there, and nothing of rendering") {
  Shown shown;
  shown.picture.edit = 3;
  shown.picture.width = 40, shown.picture.height = 30;
  shown.arrived = "row 7 of 30";
  CHECK(shown.text() == "=row 7 of 30;=40 x 30 pixels;showroom.json=;");
  const ErrorCurve curve = run(1e-4);
  shown.is_true = true, shown.run = &curve;
  shown.has("true error=1 %;");
}

}  // namespace tyndall::test::status_test
