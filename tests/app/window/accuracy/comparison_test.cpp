#include "app/window/accuracy/comparison.h"

#include "core/accuracy/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

namespace tyndall::test::comparison_test {

namespace {

constexpr int columns = 24, rows = 16;

std::shared_ptr<Frame> frame_of(float add, std::uint32_t spp = 4) {
  auto frame = std::make_shared<Frame>();
  frame->width = columns, frame->height = rows, frame->spp = spp;
  for (int i = 0; i < columns * rows; ++i) {
    const float value = 0.03f * static_cast<float>(i % 17) + add;
    frame->rgba.insert(frame->rgba.end(), {value, 0.5f * value, 0.25f, 1.0f});
  }
  return frame;
}

std::shared_ptr<Reference> reference_for(const Frame& frame, double noise = 0) {
  return std::make_shared<Reference>(Reference{{columns, rows, picture_of(frame)}, noise, "made up", {}, false});
}

}  // namespace

TEST_CASE("errors against a reference are those of the command compare, less the reference's noise") {
  const auto frame = frame_of(0.1f);
  const auto reference = reference_for(*frame_of(0), 1e-3);
  const std::vector<float> image = picture_of(*frame);
  const ComparisonResult quick = compare({frame, nullptr, reference});
  CHECK(quick.rel_mse == doctest::Approx(image_error(image, reference->image.rgb).rel_mse - 1e-3));
  CHECK(compare({frame, nullptr, reference, ErrorView::none, false, false, false}).rel_mse ==
        doctest::Approx(quick.rel_mse + 1e-3));
  CHECK_FALSE(quick.flip);
  CHECK(quick.map.empty());
  const ComparisonResult whole = compare({frame, nullptr, reference, ErrorView::none, true});
  const std::vector<float> flip = flip_map(image, reference->image.rgb, columns, rows);
  REQUIRE(whole.flip);
  CHECK(*whole.flip == doctest::Approx(std::accumulate(flip.begin(), flip.end(), 0.0) / (columns * rows)));
  CHECK(whole.cpu_seconds > 0);
}

TEST_CASE("the error map is grey, 1 is 100 % and more; that of FLIP is brighter where it is worse") {
  const auto frame = frame_of(0);
  const auto reference = reference_for(*frame);
  CHECK(compare({frame, nullptr, reference, ErrorView::error}).map[0] == 0);
  for (float& value : frame->rgba) value += 100;
  const std::vector<float> map = compare({frame, nullptr, reference, ErrorView::error}).map;
  REQUIRE(map.size() == frame->rgba.size());
  for (std::size_t i = 0; i < 8; ++i) CHECK(map[i] == 1);
  const std::vector<float> flip = compare({frame, nullptr, reference, ErrorView::flip}).map;
  REQUIRE(flip.size() == frame->rgba.size());
  CHECK(flip[0] > 0.5f);
  CHECK(flip[3] == 1);
}

TEST_CASE("the halves of a split view are compared with each other") {
  const auto b = frame_of(0.2f), a = frame_of(0);
  const ComparisonResult result = compare({b, a, nullptr});
  CHECK(result.rel_mse == doctest::Approx(relative_mse(picture_of(*b), picture_of(*a))));
  CHECK(result.rel_mse > 0.1);
}

TEST_CASE("pictures are compared only if both are whole and of one size") {
  const auto frame = frame_of(0), coarse = frame_of(0, 0), small = frame_of(0), view = frame_of(0);
  const auto reference = reference_for(*frame);
  small->width = columns / 2;
  view->view = View::noise;
  CHECK(can_compare({frame, nullptr, reference}));
  CHECK(can_compare({frame, frame, nullptr}));
  for (const auto& one : {coarse, small, view}) {
    CHECK_FALSE(can_compare({one, nullptr, reference}));
    CHECK_FALSE(can_compare({frame, one, nullptr}));
  }
  CHECK_FALSE(can_compare({frame, nullptr, nullptr}));
  CHECK_FALSE(can_compare({nullptr, nullptr, reference}));
  view->beauty = frame->rgba;
  CHECK(can_compare({view, nullptr, reference}));
  CHECK(compare({view, nullptr, reference}).rel_mse == 0);
}

TEST_CASE("work keeps to its share of the processors") {
  ProcessorBudget fraction{0.02};
  CHECK(fraction.due(0));
  double used = 0;
  for (double now = 0; now < 100; now += 0.01)
    if (fraction.due(now)) fraction.spent(now, 0.05, 4), used += 0.05;
  CHECK(used / (100 * 4) == doctest::Approx(0.02).epsilon(0.05).scale(0));
  fraction.renew();
  CHECK(fraction.due(0));
}

}  // namespace tyndall::test::comparison_test
