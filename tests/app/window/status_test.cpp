#include "app/window/overlays.h"

#include <doctest/doctest.h>

#include <limits>

namespace tyndall::test::status_test {

namespace {

Document document() {
  auto origin = std::make_shared<Origin>();
  origin->title = "showroom.json";
  origin->saved.background = Vec3d{1, 1, 1};
  return {origin->saved, origin};
}

std::string text_of(const std::vector<StatusCell>& cells) {
  std::string text;
  for (const StatusCell& cell : cells) text += cell.key + "=" + cell.value + ";";
  return text;
}

}  // namespace

TEST_CASE("the status line tells what is on the screen") {
  Frame frame;
  frame.spp = 1024;
  frame.relative_error = 0.0111;
  frame.seconds = 10;
  frame.mrays_per_s = 148;
  frame.isa = "avx512";
  frame.lanes = 32;
  frame.threads = 2;
  frame.film_bytes = 103'000'000;
  const std::string text = text_of(status_cells(&frame, {"", {{10, 1.23e-4}}, 0}, document(), {}));
  for (const char* part : {"=rendering;", "spp=1,024;", "error=1.1 %;", "to 1 %=2.3 s;", "=148 Mrays/s;",
                           "avx512 x32=2 threads;", "film=103 MB;", "rejected=0;", "=mis · sobol;", "showroom.json=;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << " in " << text);
}

TEST_CASE("the status line tells the errors of the clean view and of the raw picture") {
  Frame frame;
  frame.edit = 3;
  frame.spp = 20;
  frame.relative_error = 0.041;
  auto clean = std::make_shared<CleanFrame>();
  clean->relative_error = 0.009;
  clean->spp = 16;
  frame.clean = clean;
  std::string text = text_of(status_cells(&frame, {}, document(), {}));
  for (const char* part : {"clean=0.9 %;", "raw=4.1 %;"}) CHECK_MESSAGE(text.find(part) != std::string::npos, text);
  CHECK(text.find("rough") == std::string::npos);
  clean->spp = 8;
  text = text_of(status_cells(&frame, {}, document(), {}));
  CHECK_MESSAGE(text.find("=rough below 16 spp;") != std::string::npos, text);
  const ErrorCurve raw{"", {{10, 1.6e-3}}, 3}, filtered{"", {{10, 1e-4}}, 3};
  text = text_of(status_cells(&frame, raw, document(), {.is_true = true, .clean_run = &filtered}));
  for (const char* part : {"true clean=1 %;", "true raw=4 %;", "estimated=4.1 %;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, text);
}

TEST_CASE("the status line leaves out what is not known yet") {
  Frame frame;
  frame.step = 8;
  frame.relative_error = std::numeric_limits<double>::infinity();
  const std::string text = text_of(status_cells(&frame, {}, document(), {true}));
  for (const char* part : {"=paused;", "spp=1/64;", "error=?;", "to 1 %=?;"})
    CHECK_MESSAGE(text.find(part) != std::string::npos, part << " in " << text);
  CHECK(text_of(status_cells(nullptr, {}, document(), {})).find("=starting;") == 0);
}

TEST_CASE("rejected samples and approximations are warnings, edits are shown") {
  Frame frame;
  frame.finished = true;
  frame.rejected = 3;
  Document edited_document = document();
  edited_document.scene.render.fresnel = FresnelKind::schlick;
  int warnings = 0;
  const std::vector<StatusCell> cells = status_cells(&frame, {}, edited_document, {.edited = true});
  for (const StatusCell& cell : cells) warnings += cell.warning;
  CHECK(warnings == 2);
  frame.cut_throughput = 0.02;
  CHECK(text_of(status_cells(&frame, {}, edited_document, {})).find("cut off=2 %;") != std::string::npos);
  frame.cut_throughput = 1e-5;
  CHECK(text_of(status_cells(&frame, {}, edited_document, {})).find("cut off") == std::string::npos);
  CHECK(cells.front().value == "finished");
  CHECK(cells.back().value == "edited");
}

TEST_CASE("against a reference the true error is told, and what is only estimated") {
  Frame frame;
  frame.edit = 3;
  frame.spp = 64;
  frame.relative_error = 0.011;
  const ErrorCurve run{"", {{1, 4e-4}}, 3};
  std::string text = text_of(status_cells(&frame, run, document(), {false, true}));
  CHECK(text.find("true error=2 %;estimated=1.1 %;") != std::string::npos);
  frame.edit = 4;  // this edit's error has not been measured yet
  text = text_of(status_cells(&frame, run, document(), {false, true}));
  CHECK(text.find("true error=?;estimated=1.1 %;") != std::string::npos);
  CHECK(text_of(status_cells(&frame, run, document(), {false, false, true})).find("B=rendering;") == 0);
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
  Frame frame;
  frame.spp = 4;
  Document dark = document();
  dark.scene.background = Vec3d{0, 0, 0};
  std::string text = text_of(status_cells(&frame, {}, dark, {}));
  CHECK_MESSAGE(text.find("=empty scene: add an object and a lamp;") != std::string::npos, text);
  CHECK(text.find("error") == std::string::npos);
  dark.scene.materials = {{"grey", Vec3d{0.5, 0.5, 0.5}, Lambertian<>{}}};
  dark.scene.objects = {Object{"", Solid3d{Sphere<>{{0, 0, -2}, 1, {}}, 0}, {}}};
  text = text_of(status_cells(&frame, {}, dark, {}));
  CHECK_MESSAGE(text.find("=no light in this scene: add a lamp;") != std::string::npos, text);
  dark.scene.materials[0].kind = Light<>{};
  CHECK(text_of(status_cells(&frame, {}, dark, {})).find("error=") != std::string::npos);
}

TEST_CASE("the status line of a picture that a program writes tells how much is there, and nothing of rendering") {
  Frame frame;
  frame.edit = 3;
  frame.width = 40, frame.height = 30;
  const std::string text = text_of(status_cells(&frame, {}, document(), {.arrived = "row 7 of 30"}));
  CHECK(text == "=row 7 of 30;=40 x 30 pixels;showroom.json=;");
  const ErrorCurve run{"", {{1, 1e-4}}, 3};
  const std::string compared =
      text_of(status_cells(&frame, run, document(), {.is_true = true, .arrived = "all 30 rows"}));
  CHECK(compared.find("true error=1 %;") != std::string::npos);
}

}  // namespace tyndall::test::status_test
