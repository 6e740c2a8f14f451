#include "core/clean/clean.h"

#include "core/accuracy/error.h"
#include "tests/support/first_seen.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <random>

namespace tyndall::test::clean_test {

namespace {

/// A picture whose truth is known: two materials with a straight edge between them, light that falls off smoothly.
struct Known {
  CleanInput input;
  std::vector<float> truth;  ///< 3 floats a pixel
};

Known known_picture(int width, int height, float noise, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::gamma_distribution<float> gamma(0.5f, 2.0f);  // skew, of mean 1 and variance 2, as path tracing's noise is
  Known k;
  k.input.width = width, k.input.height = height;
  k.input.halves.resize(width, height, 6);
  const auto seen = [width](int x, int y) {
    const bool left = 3 * x < width + y;
    return FirstSeen{left ? Vec3f{0.8f, 0.2f, 0.1f} : Vec3f{0.3f, 0.4f, 0.9f}, {0, left ? 1.0f : 0.0f, 0}, 0.5f};
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const FirstSeen s = seen(x, y);
      const float light = 0.5f + 0.4f * std::sin(0.05f * static_cast<float>(x + 2 * y));
      const float albedo[3] = {s.albedo.x, s.albedo.y, s.albedo.z};
      for (int c = 0; c < 3; ++c) k.truth.push_back(light * albedo[c]);
      for (int half = 0; half < 2; ++half) {
        const float factor = 1 + noise * (gamma(engine) - 1);
        for (int c = 0; c < 3; ++c)
          k.input.halves.plane(3 * half + c)[y * k.input.halves.stride() + x] = light * albedo[c] * factor;
      }
    }
  see_first(seen, width, height, k.input);
  return k;
}

std::vector<float> raw_picture(const CleanInput& input) {
  std::vector<float> rgb;
  for (int y = 0; y < input.height; ++y)
    for (int x = 0; x < input.width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb.push_back(0.5f * (input.halves.plane(c)[y * input.halves.stride() + x] +
                              input.halves.plane(3 + c)[y * input.halves.stride() + x]));
  return rgb;
}

CleanPicture clean(const CleanInput& input, int threads = 2, Target target = available_targets().back()) {
  ThreadPool thread_pool(threads);
  CleanPicture picture;
  REQUIRE(Cleaner(target).run(input, thread_pool, false, picture));
  return picture;
}

bool all_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

}  // namespace

TEST_CASE("clean: takes most of the noise away, and knows what is left") {
  for (const float noise : {0.15f, 0.3f, 0.6f}) {
    CAPTURE(noise);
    const Known k = known_picture(192, 128, noise);
    const CleanPicture picture = clean(k.input);
    const double before = relative_mse(raw_picture(k.input), k.truth), after = relative_mse(picture.rgb, k.truth);
    CHECK(after < before / 8);
    const double estimated = picture.relative_error * picture.relative_error;
    CHECK(estimated > 0.6 * after);
    CHECK(estimated < 1.5 * after);
  }
}

TEST_CASE("clean: without noise the picture stays as it is, also where nothing that is seen explains it") {
  Known k = known_picture(96, 64, 0);
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x)
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(3 * (96 * y + x) + c);
        k.truth[i] = uniform(engine);
        for (int half = 0; half < 2; ++half)
          k.input.halves.plane(3 * half + c)[y * k.input.halves.stride() + x] = k.truth[i];
      }
  const CleanPicture picture = clean(k.input);
  CHECK(relative_mse(picture.rgb, k.truth) < 1e-6);
  CHECK(picture.relative_error < 1e-2);
}

TEST_CASE("clean: nowhere negative, though the light beside bright specks is extrapolated below 0") {
  Known k = known_picture(96, 64, 0.3f);
  std::mt19937 engine(3);
  for (int speck = 0; speck < 40; ++speck) {
    const std::ptrdiff_t at =
        static_cast<int>(engine() % 64u) * k.input.halves.stride() + static_cast<int>(engine() % 96u);
    for (int c = 0; c < 3; ++c) k.input.halves.plane(3 * (speck % 2) + c)[at] = 300;
  }
  const CleanPicture picture = clean(k.input);
  CHECK(*std::min_element(picture.rgb.begin(), picture.rgb.end()) == 0);
}

TEST_CASE("clean: the same bits for any number of threads, and once more after another picture") {
  const Known k = known_picture(203, 77, 0.7f), other = known_picture(64, 64, 0.3f),
              lower = known_picture(203, 40, 0.3f);
  const CleanPicture one = clean(k.input, 1);
  CHECK(clean(k.input, 3).rgb == one.rgb);
  ThreadPool thread_pool(2);
  Cleaner cleaner(available_targets().back());
  CleanPicture picture;
  for (const CleanInput* input : {&k.input, &other.input, &lower.input, &k.input, &k.input})
    REQUIRE(cleaner.run(*input, thread_pool, false, picture));
  CHECK(picture.rgb == one.rgb);
  CHECK(picture.pixel_error == one.pixel_error);
  CHECK(picture.relative_error == one.relative_error);
}

TEST_CASE("clean: keeps no memory of a larger picture") {
  ThreadPool thread_pool(1);
  Cleaner cleaner(available_targets().back());
  CleanPicture picture;
  for (const int edge : {96, 96, 24, 24})
    REQUIRE(cleaner.run(known_picture(edge, edge, 0.5f).input, thread_pool, false, picture));
  CHECK(picture.rgb.capacity() == 3 * 24 * 24);
  CHECK(picture.pixel_error.capacity() == 24 * 24);
}

TEST_CASE(
    "clean: instruction sets differ by rounding only, and those with fused multiplication and addition by nothing") {
  const Known k = known_picture(130, 50, 0.7f);
  std::vector<CleanPicture> fused;
  const CleanPicture scalar = clean(k.input, 2, Target::scalar);
  for (const Target target : available_targets()) {
    CAPTURE(name_of(target));
    const CleanPicture picture = clean(k.input, 2, target);
    CHECK(relative_mse(picture.rgb, scalar.rgb) < 1e-8);
    if (target >= Target::avx2) fused.push_back(picture);
  }
  for (const CleanPicture& picture : fused) {
    CHECK(picture.rgb == fused.front().rgb);
    CHECK(picture.pixel_error == fused.front().pixel_error);
    CHECK(picture.relative_error == fused.front().relative_error);
  }
}

TEST_CASE("clean: pictures of any size, of nothing and of far too bright pixels") {
  constexpr int sizes[][2] = {{1, 1},  {2, 1}, {1, 2},   {1, 100}, {100, 1},
                              {17, 9}, {8, 8}, {255, 3}, {256, 3}, {257, 3}};
  for (const Target target : available_targets())
    for (const auto& size : sizes) {
      CAPTURE(name_of(target));
      CAPTURE(size[0]);
      CAPTURE(size[1]);
      Known k = known_picture(size[0], size[1], 0.5f);
      CleanPicture picture = clean(k.input, 2, target);
      CHECK(picture.rgb.size() == k.truth.size());
      CHECK(all_finite(picture.rgb));
      CHECK(all_finite(picture.pixel_error));
      CHECK(std::isfinite(picture.relative_error));
      k.input.halves.plane(1)[0] = std::numeric_limits<float>::max();
      picture = clean(k.input, 2, target);
      CHECK(all_finite(picture.rgb));
      CleanInput black;
      black.width = size[0], black.height = size[1];
      black.halves.resize(size[0], size[1], 6);
      see_first([](int, int) { return FirstSeen{}; }, size[0], size[1], black);
      picture = clean(black, 2, target);
      CHECK(std::all_of(picture.rgb.begin(), picture.rgb.end(), [](float v) { return v == 0; }));
      CHECK(picture.relative_error == 0);
    }
}

TEST_CASE("clean: a lone bright pixel stays where it is") {
  Known k = known_picture(128, 128, 0.3f);
  const CleanPicture before = clean(k.input);
  for (int c = 0; c < 3; ++c) k.input.halves.plane(c)[64 * k.input.halves.stride() + 64] = 1000;
  const CleanPicture after = clean(k.input);
  double far = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      if (std::abs(x - 64) < 32 && std::abs(y - 64) < 32) continue;
      const auto i = static_cast<std::size_t>(3 * (128 * y + x));
      far = std::max(far, static_cast<double>(std::abs(after.rgb[i] - before.rgb[i])));
    }
  CHECK(far == 0);
  std::vector<float> raw = raw_picture(k.input);
  CHECK(relative_mse(after.rgb, k.truth) < 1.005 * relative_mse(raw, k.truth));
  CHECK(after.relative_error > 10 * before.relative_error);
  CHECK(after.relative_error > 1);
  CHECK(after.rests_on_few_pixels);
  CHECK_FALSE(before.rests_on_few_pixels);
}

namespace {

/// Adds light that comes straight from a light to one pixel's half, as the film records it.
void add_emission(CleanInput& input, int half, int x, int y, float value) {
  for (int c = 0; c < 3; ++c) {
    input.halves.plane(3 * half + c)[y * input.halves.stride() + x] += value;
    input.emission.plane(3 * half + c)[y * input.emission.stride() + x] += value;
  }
}

}  // namespace

TEST_CASE("clean: what a lone bright pixel means for the error depends on its level, which can be asked for") {
  Known k = known_picture(96, 64, 0.2f);
  constexpr std::size_t speck = 30 * 96 + 40;
  for (int c = 0; c < 3; ++c) k.input.halves.plane(c)[30 * k.input.halves.stride() + 40] = 400;  // in one half alone
  ThreadPool thread_pool(2);
  std::vector<std::vector<std::size_t>> query;
  const auto with_level = [&](float level) {
    CleanPicture picture;
    const auto levels_of = [&](const std::vector<std::size_t>& pixels) {
      query.push_back(pixels);
      return std::vector<Vec3f>(pixels.size(), {level, level, level});
    };
    REQUIRE(Cleaner(available_targets().back()).run(k.input, thread_pool, false, picture, levels_of));
    return picture;
  };
  const CleanPicture alone = clean(k.input), path = with_level(0.5f), lamp = with_level(200);
  REQUIRE_FALSE(query.empty());
  CHECK(query.front() == std::vector<std::size_t>{speck});
  for (const CleanPicture& picture : {path, lamp}) {
    CHECK(picture.rgb == alone.rgb);
    const double off = static_cast<double>(picture.rgb[3 * speck] - k.truth[3 * speck]);
    CHECK(off == doctest::Approx(200).epsilon(0.05));
  }
  constexpr double pixels = 96 * 64;
  const double without = clean(known_picture(96, 64, 0.2f).input).relative_error;
  CHECK(path.relative_error == doctest::Approx(std::sqrt(200 * 200 / (0.25 + 0.01) / pixels)).epsilon(0.1));
  CHECK(lamp.relative_error == doctest::Approx(std::sqrt(1 / pixels + without * without)).epsilon(0.1));
  CHECK(path.pixel_error[speck] > 50 * lamp.pixel_error[speck]);
  CHECK(path.rests_on_few_pixels);
}

TEST_CASE("clean: lamps smaller than a pixel shine in their own pixels only, however few samples have met them") {
  Known k = known_picture(96, 64, 0.3f);
  k.input.emission.resize(96, 64, 6);
  std::mt19937 engine(3);
  const CleanPicture before = clean(k.input);
  std::vector<bool> lamp(96 * 64);
  for (int i = 0; i < 200; ++i) {
    const int x = static_cast<int>(engine() % 96), y = static_cast<int>(engine() % 64);
    lamp[static_cast<std::size_t>(96 * y + x)] = true;
    add_emission(k.input, i % 2, x, y, 40);
  }
  const CleanPicture after = clean(k.input);
  for (std::size_t i = 0; i < lamp.size(); ++i)
    if (!lamp[i])
      REQUIRE(after.rgb[3 * i] == doctest::Approx(before.rgb[3 * i]).epsilon(0.3).scale(0));
    else
      REQUIRE(after.rgb[3 * i] > 15);
}

TEST_CASE("clean: nothing glows into the dark where nothing is seen") {
  Known k = known_picture(96, 64, 0.6f);
  k.input.emission.resize(96, 64, 6);
  for (int y = 37; y < 64; ++y)
    for (int x = 0; x < 96; ++x)
      for (int plane = 0; plane < 6; ++plane) k.input.halves.plane(plane)[y * k.input.halves.stride() + x] = 0;
  const auto seen = [](int, int y) { return y < 37 ? FirstSeen{{0.5f, 0.5f, 0.5f}, {0, 0, 1}, 0.5f} : FirstSeen{}; };
  see_first(seen, 96, 64, k.input);
  const CleanPicture picture = clean(k.input);
  CHECK(std::all_of(picture.rgb.begin() + std::ptrdiff_t{3} * 96 * 37, picture.rgb.end(),
                    [](float v) { return v == 0; }));
}

namespace {

/// The filter's steps, which count the rows that they take, and set `give_up` when a chosen number of them is done.
struct CountedRows {
  filter::FilterSteps real = filter::filter_for<Target::scalar>();
  std::atomic<int> rows = 0, last = 0;
  std::atomic<bool> give_up = false;
};
CountedRows row_count;

template <auto step, class... Arguments>
void counted_step(const filter::FilterView& view, Arguments... arguments) {
  (row_count.real.*step)(view, arguments...);
  if (++row_count.rows == row_count.last) row_count.give_up = true;
}

constexpr filter::FilterSteps counted_steps{counted_step<&filter::FilterSteps::sum_cells, int>,
                                            counted_step<&filter::FilterSteps::fit_blocks, int>,
                                            counted_step<&filter::FilterSteps::predict, int>,
                                            counted_step<&filter::FilterSteps::compare, filter::Rival, int>,
                                            counted_step<&filter::FilterSteps::mix, filter::Rival, int>,
                                            counted_step<&filter::FilterSteps::judge, int>,
                                            counted_step<&filter::FilterSteps::tell, int, float*>};

}  // namespace

TEST_CASE("clean: given up, it ends with the row that it is at, and leaves what it was to fill alone") {
  const Known k = known_picture(64, 64, 0.3f);
  constexpr int rows = 8 + 9 + 8 + 6 * 64;  // of cells, of blocks, of cells, and six times of pixels
  for (const int threads : {1, 3}) {
    ThreadPool thread_pool(threads);
    Cleaner cleaner(counted_steps);
    for (int last : {1, 5, 8, 9, 20, 25, 26, 100, 200, rows - 1, rows}) {
      CAPTURE(threads);
      CAPTURE(last);
      row_count.rows = 0, row_count.last = last, row_count.give_up = false;
      CleanPicture picture;
      picture.rgb = {1, 2, 3};
      CHECK_FALSE(cleaner.run(k.input, thread_pool, row_count.give_up, picture));
      CHECK(row_count.rows - last <= threads - 1);  // those that other threads were at
      CHECK(picture.rgb == std::vector<float>{1, 2, 3});
    }
    row_count.rows = 0, row_count.last = 0, row_count.give_up = false;
    CleanPicture picture;
    CHECK(cleaner.run(k.input, thread_pool, row_count.give_up, picture));
    CHECK(row_count.rows == rows);
    CHECK(picture.rgb == clean(k.input, 1, Target::scalar).rgb);
  }
}

TEST_CASE("clean: reading gives up, too") {
  Film film = make_film(8, 8, {0, 0, 8, 8}, 0, 1);
  ThreadPool thread_pool(2);
  CleanInput input;
  CHECK_FALSE(read_film(film, thread_pool, true, input));
}

TEST_CASE("clean: reads a film's halves as they are, and fills an empty one from the other") {
  Film film = make_film(3, 1, {0, 0, 3, 1}, 0, 0x1p40);
  for (int x = 0; x < 3; ++x)
    for (std::uint32_t i = 0; i < 4; ++i) {
      add_sample(film.at(x, 0), i & 1u, {1e12f * static_cast<float>(i & 1u), 2e11f, 3}, 0x1p-40);
      ++film.at(x, 0).taken;
    }
  film.at(1, 0) = {};
  film.at(1, 0).taken = 1;
  add_sample(film.at(1, 0), 0, {4e11f, 5e11f, 6e11f}, 0x1p-40);
  film.at(2, 0) = {};
  ThreadPool thread_pool(1);
  CleanInput input;
  REQUIRE(read_film(film, thread_pool, false, input));
  CHECK(input.width == 3);
  CHECK(input.height == 1);
  CHECK(input.scale == 0x1p15f);
  const auto value = [&](int plane, int x) { return input.scale * input.halves.plane(plane)[x]; };
  CHECK(value(0, 0) == 0);
  CHECK(value(3, 0) == 1e12f);
  CHECK(value(1, 0) == 2e11f);
  CHECK(value(4, 0) == 2e11f);
  CHECK(value(0, 1) == 4e11f);
  CHECK(value(3, 1) == 4e11f);
  CHECK(value(5, 1) == 6e11f);
  CHECK(value(0, 2) == 0);
  CHECK(value(5, 2) == 0);
}

TEST_CASE("clean: rows without emission are known as dark, also after a picture in which they shone") {
  Film lit = make_film(3, 2, {0, 0, 3, 2}, 0, 1, true), dark = lit;
  lit.at(1, 1).taken = 2;
  lit.emission[4].sum[0][2] = std::int64_t{1} << 29;
  ThreadPool thread_pool(1);
  CleanInput input;
  const auto shine = [&] { return input.emission.plane(2)[input.emission.stride() + 1]; };
  REQUIRE(read_film(lit, thread_pool, false, input));
  CHECK(input.dark_rows == std::vector<std::uint8_t>{1, 0});
  CHECK(shine() == 1);
  REQUIRE(read_film(dark, thread_pool, false, input));
  CHECK(input.dark_rows == std::vector<std::uint8_t>{1, 1});
  CHECK(shine() == 0);
  REQUIRE(read_film(lit, thread_pool, false, input));
  CHECK(shine() == 1);
}

TEST_CASE("clean: emission is found in rows that are not known to be dark, and not looked for in the others") {
  Known k = known_picture(96, 64, 0.3f);
  k.input.emission.resize(96, 64, 6);
  for (int half = 0; half < 2; ++half) add_emission(k.input, half, 40, 20, 30);
  const CleanPicture unknown = clean(k.input);
  k.input.dark_rows.assign(64, 1);
  k.input.dark_rows[20] = 0;
  CHECK(clean(k.input).rgb == unknown.rgb);
  k.input.dark_rows[20] = 1;
  CHECK(clean(k.input).rgb != unknown.rgb);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // both end the program where memory runs out
TEST_CASE("clean view: planes that memory did not suffice for are asked for anew") {
  constexpr int huge = 1 << 22;
  Planes planes;
  REQUIRE(planes.resize(8, 8, 1));
  CHECK_THROWS_AS(planes.resize(huge, huge, 8), std::bad_alloc);
  CHECK_THROWS_AS(planes.resize(huge, huge, 8), std::bad_alloc);
  REQUIRE(planes.resize(8, 8, 1));
  CHECK(planes.plane(0)[7] == 0);
}
#endif

}  // namespace tyndall::test::clean_test
