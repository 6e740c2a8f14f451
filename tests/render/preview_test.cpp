#include "core/render/preview.h"

#include <doctest/doctest.h>

#include <initializer_list>

namespace tyndall::test::preview_test {

namespace {

constexpr std::int64_t full_hd = 1920 * 1080;

/// Speed at which a full HD picture within a second would sample every `step`-th pixel, exactly.
double speed_for(double step) { return static_cast<double>(full_hd) / (step * step); }

}  // namespace

TEST_CASE("preview: what moves is shown sooner than what changed once") {
  CHECK(picture_budget(false, 10) == doctest::Approx(0.075));
  CHECK(picture_budget(true, 10) == doctest::Approx(0.016));
  CHECK(picture_budget(false, 0.2) == doctest::Approx(0.033));
}

TEST_CASE("preview: the step that fits the time, coarse while nothing is known") {
  CHECK(preview_step(full_hd, 0, 0.1, 1) == 8);
  CHECK(preview_step(full_hd, -1, 0.1, 0) == 8);
  CHECK(preview_step(full_hd, 1e12, 0.016, 0) == 1);
  CHECK(preview_step(full_hd, 1, 0.016, 0) == 8);
  for (int step = 1; step <= 8; ++step) {
    CHECK(preview_step(full_hd, speed_for(0.99 * step), 1, 0) == step);
    CHECK(preview_step(full_hd, speed_for(step - 0.95), 1, 0) == step);
  }
  CHECK(preview_step(full_hd, speed_for(2) / 0.016, 0.026, 0) == 2);
  CHECK(preview_step(1, 1e3, 0.016, 0) == 1);
}

TEST_CASE("preview: a step that was chosen is kept until another one fits clearly better") {
  for (int step = 1; step <= 8; ++step) {
    CHECK(preview_step(full_hd, speed_for(1.09 * step), 1, step) == step);
    if (step > 1) CHECK(preview_step(full_hd, speed_for((step - 1) / 1.24), 1, step) == step);
    if (step < 8) CHECK(preview_step(full_hd, speed_for(1.11 * step), 1, step) > step);
    if (step > 1) CHECK(preview_step(full_hd, speed_for((step - 1) / 1.26), 1, step) == step - 1);
  }
  CHECK(preview_step(full_hd, speed_for(0.01), 1, 1) == 1);
  CHECK(preview_step(full_hd, speed_for(1000), 1, 8) == 8);
}

TEST_CASE(
    "preview: a coarse clean view is as fine as fits a tenth of a second, and none comes where a whole one does") {
  CHECK(coarse_clean_step(full_hd, 0, 1e-7) == 8);
  CHECK(coarse_clean_step(full_hd, 1e12, 1e-12) == 1);
  CHECK(coarse_clean_step(1000, 2e6, 1e-6) == 1);
  for (const double rate : {1e6, 4e6, 2e7, 1e8, 1e9}) {
    const auto seconds = [rate](int step) { return static_cast<double>(full_hd) / (step * step) * (2 / rate + 1e-7); };
    const int step = coarse_clean_step(full_hd, rate, 1e-7);
    REQUIRE(step >= 2);
    CHECK((step == 8 || seconds(step) <= 0.1));
    CHECK((step == 2 || seconds(step - 1) > 0.1));
  }
}

TEST_CASE("preview: no more pixels are sampled than are shown") {
  CHECK(step_of_shown(full_hd, 0) == 1);
  CHECK(step_of_shown(full_hd, full_hd) == 1);
  CHECK(step_of_shown(1600 * 1000, 908 * 568) == 2);
  CHECK(step_of_shown(full_hd, full_hd / 4) == 2);
  CHECK(step_of_shown(full_hd, full_hd / 4 - 1) == 3);
  CHECK(step_of_shown(full_hd, 1) == 8);
  FirstPictures pictures;
  pictures.note_pass(1e12);
  CHECK(pictures.step_for(full_hd, 0.016) == 1);
  CHECK(pictures.step_for(full_hd, 0.016, full_hd / 3) == 2);
}

TEST_CASE("preview: the next edit's step follows from the speed of the first pictures before it") {
  FirstPictures pictures;
  CHECK(pictures.step_for(full_hd, 0.016) == 8);  // nothing is known yet
  pictures.note_pass(full_hd / 0.016);
  CHECK(pictures.step_for(full_hd, 0.016) == 2);
  pictures.note_pass(full_hd / 0.016 * 4);
  CHECK(pictures.step_for(full_hd, 0.016) == 1);
  for (int k = 0; k < 40; ++k) pictures.note_pass(full_hd / 0.016);
  pictures.note_drawing(0.008);  // drawing leaves half of the time for samples
  CHECK(pictures.step_for(full_hd, 0.016) == 2);
  pictures.note_drawing(1);  // however long drawing takes, samples get a quarter of the time
  CHECK(pictures.step_for(full_hd, 0.016) == 2);
  pictures.note_drawing(0);
  pictures.note_pass(full_hd / 0.016 / 256);  // after a single slow pass the speed is the geometric mean of both
  CHECK(pictures.step_for(full_hd, 0.016) == 4);
}

TEST_CASE("preview: a slow screen makes first pictures coarser, a quick one does not") {
  FirstPictures pictures;
  pictures.note_pass(full_hd / 0.016 / 3.9);
  CHECK(pictures.step_for(full_hd, 0.016) == 2);
  pictures.note_showing(0.009);
  CHECK(pictures.step_for(full_hd, 0.016) == 2);
  for (int k = 0; k < 20; ++k) pictures.note_showing(0.020);
  CHECK(pictures.step_for(full_hd, 0.016) == 4);
}

}  // namespace tyndall::test::preview_test
