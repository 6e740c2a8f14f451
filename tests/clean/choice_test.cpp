#include "core/accuracy/error.h"
#include "core/film/groups.h"
#include "tests/support/first_seen.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

/// What the clean view chooses where the regression cannot be right: pictures whose truth is known, with something in
/// them that no feature tells.
namespace tyndall::test::choice_test {

namespace {

constexpr int width = 64, height = 48;

struct Picture {
  CleanInput input;
  std::vector<float> truth;  ///< 3 floats a pixel

  float& half(int half, int channel, int x, int y) {
    return input.halves.plane(3 * half + channel)[y * input.halves.stride() + x];
  }
};

/// truth(x, y): the radiance; seen(x, y): what is seen there; noise(x, y): relative standard deviation of each half.
template <class Truth, class Seen, class Noise>
Picture picture(const Truth& truth, const Seen& seen, const Noise& noise) {
  Picture p;
  p.input.width = width, p.input.height = height;
  p.input.halves.resize(width, height, 6);
  see_first(seen, width, height, p.input);
  std::mt19937 engine(1);
  std::normal_distribution<float> normal;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec3f value = truth(x, y);
      p.truth.insert(p.truth.end(), {value.x, value.y, value.z});
      for (int half = 0; half < 2; ++half) {
        const float factor = 1 + noise(x, y) * normal(engine);
        p.half(half, 0, x, y) = factor * value.x, p.half(half, 1, x, y) = factor * value.y;
        p.half(half, 2, x, y) = factor * value.z;
      }
    }
  return p;
}

CleanPicture clean(const Picture& p) {
  ThreadPool thread_pool(1);
  CleanPicture picture;
  REQUIRE(Cleaner(Target::scalar).run(p.input, thread_pool, false, picture));
  return picture;
}

/// The squared relative error of a pixel of the clean view.
double error_at(const CleanPicture& picture, const Picture& p, int x, int y) {
  const std::ptrdiff_t i = 3 * (y * width + x);
  const auto pixel = [i](const std::vector<float>& rgb) {
    return std::vector<float>(rgb.begin() + i, rgb.begin() + i + 3);
  };
  return relative_mse(pixel(picture.rgb), pixel(p.truth));
}

/// Sum of the errors of the pixels at(x, y) that are meant.
double errors_where(const CleanPicture& picture, const Picture& p, const auto& at) {
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (at(x, y)) sum += error_at(picture, p, x, y);
  return sum;
}

/// Calls f(x, y) for the pixels of a group of the block at (bx, by).
void each_of_group(int bx, int by, int group, const auto& f) {
  for (int member = 0; member < group_size; ++member)
    f(bx + group % group_spacing + member % group_columns * group_spacing,
      by + group / group_spacing + member / group_columns * group_spacing);
}

Vec3f grey(float value) { return {value, value, value}; }

FirstSeen grey_floor(int, int) { return {{0.5f, 0.5f, 0.5f}, {0, 1, 0}, 0.5f}; }

FirstSeen grey_glass(int x, int y) {
  FirstSeen seen = grey_floor(x, y);
  seen.sharp = false;
  return seen;
}

}  // namespace

TEST_CASE("choice: errors in dark channels count as much as those in bright ones") {
  // Red beside white. The column between is half of each, without noise, and seen as white.
  const auto truth = [](int x, int) {
    return x < 32 ? Vec3f{0.9f, 0.05f, 0.05f} : x > 32 ? Vec3f{1, 1, 1} : Vec3f{0.92f, 0.24f, 0.24f};
  };
  const auto seen = [](int x, int) {
    return FirstSeen{x < 32 ? Vec3f{0.9f, 0.05f, 0.05f} : Vec3f{1, 1, 1}, {0, 0, 1}, 0.5f};
  };
  const Picture p = picture(truth, seen, [](int x, int) { return x == 32 ? 0.0f : 0.3f; });
  CHECK(errors_where(clean(p), p, [](int x, int y) { return x == 32 && y >= 8 && y < 40; }) < 0.3 * 32);
}

TEST_CASE("choice: a rare bright path does not decide for the pixels around it") {
  const auto truth = [](int x, int) { return grey(x < 32 ? 0.02f : 0.8f); };
  Picture p = picture(truth, grey_floor, [](int, int) { return 0.1f; });
  for (int c = 0; c < 3; ++c) p.half(0, c, 24, 24) = 200;
  const auto around = [](int x, int y) {
    const int away = std::max(std::abs(x - 24), std::abs(y - 24));
    return away > 2 && away <= 6;
  };
  CHECK(errors_where(clean(p), p, around) < 13 * 13 - 5 * 5);
}

TEST_CASE("choice: a tiny lamp behind glass hardly shines on the dark pixels beside it") {
  const auto truth = [](int x, int y) {
    const float ripple =
        0.03f + 0.02f * std::sin(0.6f * static_cast<float>(x)) * std::sin(0.6f * static_cast<float>(y));
    return grey(x == 32 && y == 24 ? 400.0f : ripple);
  };
  Picture p = picture(truth, grey_glass, [](int, int) { return 0.3f; });
  p.input.emission.resize(width, height, 6);
  for (int k = 0; k < 6; ++k) {
    p.half(k / 3, k % 3, 32, 24) = k < 3 ? 300.0f : 500.0f;
    p.input.emission.plane(k)[24 * p.input.emission.stride() + 32] = k < 3 ? 300.0f : 500.0f;
  }
  const CleanPicture picture = clean(p);
  double beside = 0;
  for (int y = 22; y <= 26; ++y)
    for (int x = 30; x <= 34; ++x)
      if (x != 32 || y != 24) beside = std::max(beside, error_at(picture, p, x, y));
  CHECK(beside < 0.12);
}

TEST_CASE("choice: a dark line in glass counts for its own darkness where there are samples enough") {
  const auto truth = [](int x, int) { return grey(x == 32 ? 0.25f : 0.9f); };
  Picture p = picture(truth, grey_glass, [](int, int) { return 0.2f; });
  p.input.spp = 4;
  const double few = clean(p).relative_error;
  p.input.spp = 16;
  const CleanPicture many = clean(p);
  CHECK(many.relative_error * many.relative_error ==
        doctest::Approx(relative_mse(many.rgb, p.truth)).epsilon(0.5).scale(0));
  CHECK(few < 0.9 * many.relative_error);
}

TEST_CASE("choice: a bright spot does not glow into the dark beside it, which the halves agree about") {
  const auto lit = [](int x, int y) { return std::abs(x - 32) <= 5 && std::abs(y - 24) <= 5; };
  const auto truth = [&](int x, int y) { return grey(lit(x, y) ? 2 : 0.03f); };
  Picture p = picture(truth, grey_floor, [&](int x, int y) { return lit(x, y) ? 0.3f : 0.2f; });
  p.input.spp = 64;
  CHECK(errors_where(clean(p), p, [&](int x, int y) { return !lit(x, y); }) < 5);
}

TEST_CASE("choice: a rare bright path does not glow along a dark row that many samples agree about") {
  const auto truth = [](int, int y) { return grey(y == 24 ? 0.003f : 0.06f); };
  const auto seen = [](int x, int y) {
    FirstSeen pixel = grey_floor(x, y);
    if (y == 24) pixel.albedo = {0.8f, 0.8f, 0.8f};
    return pixel;
  };
  Picture p = picture(truth, seen, [](int, int) { return 0.03f; });
  for (int c = 0; c < 3; ++c) p.half(0, c, 30, 24) = 3;
  p.input.spp = 1024;
  CHECK(errors_where(clean(p), p, [](int x, int y) { return x != 30 && y == 24; }) < 0.1);
}

TEST_CASE("choice: pixels of a floor that are dark by chance do not make the error seem larger") {
  const auto truth = [](int, int) { return grey(0.9f); };
  Picture p = picture(truth, grey_floor, [](int, int) { return 0.4f; });
  p.input.spp = 16;
  const CleanPicture picture = clean(p);
  CHECK(picture.relative_error * picture.relative_error ==
        doctest::Approx(relative_mse(picture.rgb, p.truth)).epsilon(0.5).scale(0));
}

TEST_CASE("choice: the error is known where groups of pixels share their noise") {
  // A bright floor with texture that no feature tells; a group's pixels, every fourth of a block, all have one noise.
  const auto truth = [](int x, int y) {
    return grey(1 + 0.3f * std::sin(0.7f * static_cast<float>(x)) * std::cos(0.5f * static_cast<float>(y)));
  };
  double estimated = 0, real = 0;
  std::mt19937 engine(3);
  std::normal_distribution<float> normal;
  for (int trial = 0; trial < 40; ++trial) {
    Picture p = picture(truth, grey_floor, [](int, int) { return 0.0f; });
    p.input.grouped = true;
    for (int half = 0; half < 2; ++half)
      for (int by = 0; by < height; by += block_height)
        for (int bx = 0; bx < width; bx += block_width)
          for (int group = 0; group < group_spacing * group_spacing; ++group) {
            const float noise = 0.2f * normal(engine);
            each_of_group(bx, by, group, [&](int x, int y) {
              for (int channel = 0; channel < 3; ++channel) p.half(half, channel, x, y) *= 1 + noise;
            });
          }
    const CleanPicture picture = clean(p);
    estimated += picture.relative_error * picture.relative_error;
    real += relative_mse(picture.rgb, p.truth);
  }
  const double ratio = estimated / real;
  CHECK(ratio > 0.9);
  CHECK(ratio < 1.15);
}

TEST_CASE("choice: a group of pixels that met one bright path does not show as a grid of dots") {
  // The second group of a block in the middle is six times as bright as the floor in half A; the floor is quiet.
  const auto truth = [](int, int) { return grey(0.5f); };
  Picture p = picture(truth, grey_floor, [](int, int) { return 0.05f; });
  p.input.grouped = true;
  double added = 0, shown = 0;
  const auto each_of_second = [](const auto& f) {
    each_of_group(2 * block_width, 3 * block_height, 1 + group_spacing, f);
  };
  each_of_second([&](int x, int y) {
    for (int channel = 0; channel < 3; ++channel) p.half(0, channel, x, y) = 3;
    added += 0.5 * (3 - 0.5);  // the picture is the mean of both halves
  });
  const CleanPicture picture = clean(p);
  const auto red = [&](int x, int y) {
    return static_cast<double>(picture.rgb[3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x))]);
  };
  each_of_second([&](int x, int y) {
    shown += red(x, y) - 0.25 * (red(x - 2, y) + red(x + 2, y) + red(x, y - 2) + red(x, y + 2));
  });
  CHECK(shown < 0.15 * added);
}

}  // namespace tyndall::test::choice_test
