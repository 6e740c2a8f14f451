#include "core/accuracy/noise_test.h"

#include <doctest/doctest.h>

#include <functional>
#include <random>

namespace tyndall::test::noise_scores_test {

namespace {

constexpr int width = 96, height = 64;

using Random = std::mt19937;
/// The mean of a half of a pixel's samples.
using Half = std::function<float(Random& random, int x, int y)>;

NoisyImage picture(unsigned seed, const Half& half, double spp = 64, Region region = {0, 0, width, height}) {
  NoisyImage image{region, {}, {}, true, false, spp};
  Random random(seed);
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) {
      const float a = half(random, x, y), b = half(random, x, y);
      image.mean.insert(image.mean.end(), 3, (a + b) / 2);
      image.deviation.insert(image.deviation.end(), 3, (a - b) / 2);
    }
  return image;
}

/// Normal noise of a tenth around 1, times `factor` where `changed` says so.
Half normal(
    float factor = 1, std::function<bool(int, int)> changed = [](int, int) { return true; }) {
  return [factor, changed](Random& random, int x, int y) {
    const float level = changed(x, y) ? factor : 1;
    return std::normal_distribution<float>(level, 0.1f)(random);
  };
}

/// In one of `rarity` halves a sample that is as bright as all of them together, beside an even light.
Half rare(double rarity, float even) {
  return [rarity, even](Random& random, int, int) {
    const bool met = std::uniform_real_distribution<double>()(random) * rarity < 1;
    return even + (met ? static_cast<float>(rarity) : 0.0f);
  };
}

int alarms(const Half& half, int pairs, double limit, double spp_of_second = 64) {
  int count = 0;
  for (unsigned i = 0; i < static_cast<unsigned>(pairs); ++i)
    count += noise_scores(picture(2 * i, half), picture(2 * i + 1, half, spp_of_second)).z > limit;
  return count;
}

}  // namespace

TEST_CASE("noise: pictures of the same level differ by more than z as seldom as a normal number, or less") {
  // 2 Q(2) = 0.0455, of which Hoeffding's bound leaves less.
  CHECK(alarms(normal(), 300, 2) <= 24);
  CHECK(alarms(normal(), 300, 2) > 0);
  CHECK(alarms(normal(), 300, 4) == 0);
}

TEST_CASE("noise: rare bright samples, alone or over an even light, are no change") {
  for (const double rarity : {20.0, 300.0, 5000.0})
    for (const float even : {0.0f, 1.0f, 100.0f}) {
      CAPTURE(rarity);
      CAPTURE(even);
      CHECK(alarms(rare(rarity, even), 60, 3) <= 1);
    }
}

TEST_CASE("noise: what is black in both pictures is no evidence") {
  // A dark picture with a few samples of a light in one block, three times as bright in the other picture.
  const auto lit = [](float light) {
    return [light](Random& random, int x, int y) {
      const bool met = x < 16 && y < 16 && std::uniform_real_distribution<double>()(random) < 0.01;
      return met ? light : 0.0f;
    };
  };
  const NoiseScores few = noise_scores(picture(1, lit(1)), picture(2, lit(3)));
  CHECK(few.z < 4);
  CHECK(few.lit_blocks == 1);
  CHECK(few.unclear_blocks == 1);
  CHECK_FALSE(few.tells());
  CHECK(few.enough_spp > 64);
  CHECK(few.enough_spp < 6400);
  const NoiseScores dark = noise_scores(picture(1, lit(0)), picture(2, lit(0)));
  CHECK(dark.lit_blocks == 0);
  CHECK(dark.tells());
  // Light in one channel alone: the other two, which are black, tell nothing.
  NoisyImage red = picture(1, lit(1)), other = picture(2, lit(3));
  for (NoisyImage* image : {&red, &other})
    for (std::size_t at = 0; at < image->mean.size(); ++at)
      if (at % 3 != 0) image->mean[at] = image->deviation[at] = 0;
  CHECK_FALSE(noise_scores(red, other).tells());
  // As much light as noise: a mean that only noise has lifted above zero is none.
  const auto noise = [](Random& random, int, int) { return std::normal_distribution<float>(0, 0.1f)(random); };
  CHECK(noise_scores(picture(1, noise), picture(2, noise)).lit_blocks < 24);
}

TEST_CASE("noise: of blocks with few effective samples nothing is told") {
  const NoiseScores few = noise_scores(picture(1, rare(100, 0)), picture(2, rare(100, 0)));
  CHECK(few.blocks == 24);
  CHECK(few.unclear_blocks == 24);  // some 10 samples in each
  CHECK_FALSE(few.tells());         // some 250 in the whole are no evidence of any place
  CHECK(few.enough_spp > 64);
  const Region small{0, 0, 16, 16};
  CHECK_FALSE(noise_scores(picture(1, rare(100, 0), 64, small), picture(2, rare(100, 0), 64, small)).tells());
  CHECK(noise_scores(picture(1, rare(10, 0)), picture(2, rare(10, 0))).unclear_blocks == 0);  // some 100 in each block
  const NoiseScores lit = noise_scores(picture(1, rare(300, 0)), picture(2, normal()));
  CHECK(lit.block_z > 4);
}

TEST_CASE("noise: the errors of blocks know that pixels four apart are correlated") {
  // All pixels of a group of 4 x 2 have the same noise, as far as second vertices are reused.
  const auto correlated = [](Random&, int x, int y, unsigned seed) {
    const int group = ((y / 8 * 4 + y % 4) * 64 + x / 16 * 4) + x % 4;
    std::minstd_rand own(seed * 7919u + static_cast<unsigned>(group) + 1);  // quick to seed
    own.discard(4);
    return std::normal_distribution<float>(1, 0.1f)(own);
  };
  int count = 0;
  for (unsigned i = 0; i < 100; ++i) {
    unsigned half = 0;
    const auto of = [&](unsigned seed) {
      return picture(
          seed, [&, seed](Random& random, int x, int y) { return correlated(random, x, y, 2 * seed + half++ % 2); });
    };
    count += noise_scores(of(2 * i), of(2 * i + 1)).z > 3;
  }
  CHECK(count <= 2);
}

TEST_CASE("noise: a change of the mean, of a block, of an edge and of a small object is found") {
  // The mean of 6144 pixels has an error of 0.1 / sqrt(2) / sqrt(6144) = 0.0009, the difference 0.0013.
  const NoiseScores mean = noise_scores(picture(1, normal()), picture(2, normal(1.012f)));
  CHECK(mean.mean_z[0] > 4);
  CHECK(mean.difference[0] == doctest::Approx(-0.012).epsilon(0.4));
  CHECK(mean.error[0] == doctest::Approx(0.00128).epsilon(0.1));
  const auto in_block = [](int x, int y) { return x >= 32 && x < 48 && y >= 16 && y < 32; };
  const NoiseScores block = noise_scores(picture(1, normal()), picture(2, normal(1.06f, in_block)));
  CHECK(block.block_z > 4);
  CHECK(block.worst_block == Region{32, 16, 48, 32});
  CHECK(block.blocks_above(4) == 1);
  const auto object = [](int x, int y) { return x >= 34 && x < 37 && y >= 18 && y < 21; };
  CHECK(noise_scores(picture(1, normal()), picture(2, normal(4, object))).block_z > 4);
  const auto edge = [](int x, int y) { return (x + y) % 48 == 5; };
  const NoiseScores lines = noise_scores(picture(1, normal()), picture(2, normal(3, edge)));
  CHECK(lines.outlier_z > 4);
  CHECK(lines.outliers > lines.explained_outliers + 50);
}

TEST_CASE("noise: with other numbers of samples, the better picture says how noisy the other one may be") {
  const auto better = [](Random& random, int x, int y) {
    float sum = 0;
    for (int i = 0; i < 16; ++i) sum += rare(20, 0)(random, x, y);
    return sum / 16;
  };
  int count = 0;
  for (unsigned i = 0; i < 60; ++i) {
    const NoiseScores scores = noise_scores(picture(i, rare(20, 0), 4), picture(i + 1000, better, 64));
    count += scores.z > 3;
    CHECK_FALSE(scores.compares_outliers);
  }
  CHECK(count <= 1);
  CHECK(noise_scores(picture(1, normal(), 4), picture(2, normal(1.06f), 64)).z > 4);
}

TEST_CASE("noise: equal pictures and rounding are no difference; without noise any other one is") {
  const auto flat = [](float level) { return [level](Random&, int, int) { return level; }; };
  const NoisyImage one = picture(1, normal());
  CHECK(noise_scores(one, one).z == 0);
  CHECK(noise_scores(picture(1, flat(1)), picture(2, flat(1.000002f))).z == 0);
  CHECK(noise_scores(picture(1, flat(1)), picture(2, flat(1.0001f))).z > 4);
  CHECK(noise_scores(picture(1, flat(0)), picture(2, flat(0))).tells());
}

TEST_CASE("noise: pictures are compared by position, also where blocks are cut and positions negative") {
  const auto ramp = [](Random& random, int x, int y) {
    return static_cast<float>(200 + x + 3 * y) + std::normal_distribution<float>(0, 0.1f)(random);
  };
  const NoiseScores scores =
      noise_scores(picture(1, ramp, 64, {-20, -5, 30, 40}), picture(2, ramp, 64, {-7, -30, 60, 21}));
  CHECK(scores.z < 4);
  CHECK(scores.blocks == 9);  // -7 to 30 and -5 to 21, cut at multiples of 16
}

TEST_CASE("noise: standard errors without halves; of correlated pixels they add up") {
  NoisyImage a = picture(1, normal()), b = picture(2, normal(1.01f));
  for (NoisyImage* image : {&a, &b}) {
    image->halves = false;
    for (float& error : image->deviation) error = 0.1f / std::sqrt(2.0f);
  }
  CHECK(noise_scores(a, b).z > 4);
  CHECK(noise_scores(a, b).error[1] == doctest::Approx(0.1 / std::sqrt(double(width * height))));
  a.correlated = b.correlated = true;
  CHECK(noise_scores(a, b).error[1] == doctest::Approx(0.1 / std::sqrt(double(width * height) / 8)));
  CHECK(noise_scores(a, b).z < 4);
}

TEST_CASE("noise: a film has it from 2 samples a pixel on") {
  Film film = make_film(2, 1, {0, 0, 2, 1}, 0, 64);
  CHECK_FALSE(noisy_image(film));
  for (FilmPixel& pixel : film.pixels)
    for (std::uint32_t s = 0; s < 2; ++s) {
      const float v = s == 0 ? 3.0f : 1.0f;
      add_sample(pixel, s, {v, v, v}, 1 / film.quantum), ++pixel.taken;
    }
  const auto image = noisy_image(film);
  REQUIRE(image);
  CHECK(image->mean == std::vector<float>(6, 2.0f));
  CHECK(image->deviation == std::vector<float>(6, 1.0f));
  CHECK(image->spp == 2);
}

}  // namespace tyndall::test::noise_scores_test
