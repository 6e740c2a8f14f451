#include "app/window/overlays.h"

#include <doctest/doctest.h>

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
  std::string text();
};

std::string text_of(const std::vector<StatusCell>& cells) {
  std::string text;
  for (const StatusCell& cell : cells) text += cell.key + "=" + cell.value + ";";
  return text;
}

std::string Shown::text() { return text_of(cells()); }

}  // namespace

TEST_CASE("the status line tells what is on the screen") {
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
  const ErrorCurve run{"", {{10, 1.23e-4}}, 0};
  shown.run = &run;
  const std::string text = shown.text();
  for (const char* part : {"=rendering;", "spp=1,024;", "error=1.1 %;", "to 1 %=2.3 s;", "=148 Mrays/s;",
                           "avx512 x32=2 threads;", "film=103 MB;", "rejected=0;", "=mis · sobol;", "showroom.json=;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << " in " << text);
}

TEST_CASE("the status line tells the errors of the clean view and of the raw picture") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.edit = 3;
  frame.spp = 20;
  frame.relative_error = 0.041;
  auto clean = std::make_shared<CleanFrame>();
  clean->relative_error = 0.009;
  clean->spp = 16;
  frame.clean = clean;
  std::string text = shown.text();
  for (const char* part : {"clean=0.9 %;", "raw=4.1 %;"}) CHECK_MESSAGE(text.find(part) != std::string::npos, text);
  CHECK(text.find("rough") == std::string::npos);
  clean->spp = 8;
  text = shown.text();
  CHECK_MESSAGE(text.find("=rough below 16 spp;") != std::string::npos, text);
  const ErrorCurve raw{"", {{10, 1.6e-3}}, 3}, filtered{"", {{10, 1e-4}}, 3};
  shown.is_true = true, shown.run = &raw, shown.clean_run = &filtered;
  text = shown.text();
  for (const char* part : {"true clean=1 %;", "true raw=4 %;", "estimated=4.1 %;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

TEST_CASE("the status line leaves out what is not known yet") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.step = 8;
  frame.relative_error = std::numeric_limits<double>::infinity();
  shown.wanted.paused = true;
  const std::string text = shown.text();
  for (const char* part : {"=paused;", "spp=1/64;", "error=?;", "to 1 %=?;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << " in " << text);
  CHECK(text_of(status_cells(Context{}, Scene{})).find("=starting;") == 0);
}

TEST_CASE("rejected samples and approximations are warnings, edits are shown") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.finished = true;
  frame.rejected = 3;
  shown.edited = true;
  shown.scene.render.fresnel = FresnelKind::schlick;
  int warnings = 0;
  const std::vector<StatusCell> cells = shown.cells();
  for (const StatusCell& cell : cells) warnings += cell.warning;
  CHECK(warnings == 2);
  frame.cut_throughput = 0.02;
  CHECK(shown.text().find("cut off=2 %;") != std::string::npos);
  frame.cut_throughput = 1e-5;
  CHECK(shown.text().find("cut off") == std::string::npos);
  CHECK(cells.front().value == "finished");
  CHECK(cells.back().value == "edited");
}

TEST_CASE("against a reference the true error is told, and what is only estimated") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.edit = 3;
  frame.spp = 64;
  frame.relative_error = 0.011;
  const ErrorCurve run{"", {{1, 4e-4}}, 3};
  shown.is_true = true, shown.run = &run;
  std::string text = shown.text();
  CHECK(text.find("true error=2 %;estimated=1.1 %;") != std::string::npos);
  frame.edit = 4;  // this edit's error has not been measured yet
  text = shown.text();
  CHECK(text.find("true error=?;estimated=1.1 %;") != std::string::npos);
  shown.split = true;
  CHECK(shown.text().find("B=rendering;") == 0);
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
  Frame& frame = shown.picture;
  frame.spp = 4;
  shown.scene.background = Vec3d{0, 0, 0};
  std::string text = shown.text();
  CHECK_MESSAGE(text.find("=empty scene: add an object and a lamp;") != std::string::npos, text);
  CHECK(text.find("error") == std::string::npos);
  shown.scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  shown.scene.objects = {Object{"", Solid3d{Sphere<>{{0, 0, -2}, 1, {}}, 0}, {}}};
  text = shown.text();
  CHECK_MESSAGE(text.find("=no light in this scene: add a lamp;") != std::string::npos, text);
  shown.scene.materials[0].kind = Light<>{};
  CHECK(shown.text().find("error=") != std::string::npos);
}

TEST_CASE("the status line of a picture that a program writes tells how much is there, and nothing of rendering") {
  Shown shown;
  Frame& frame = shown.picture;
  frame.edit = 3;
  frame.width = 40, frame.height = 30;
  shown.arrived = "row 7 of 30";
  const std::string text = shown.text();
  CHECK(text == "=row 7 of 30;=40 x 30 pixels;showroom.json=;");
  const ErrorCurve run{"", {{1, 1e-4}}, 3};
  shown.is_true = true, shown.run = &run;
  const std::string compared = shown.text();
  CHECK(compared.find("true error=1 %;") != std::string::npos);
}

}  // namespace tyndall::test::status_test
