#include "core/image/tonemap.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

namespace tyndall::test::tonemap_test {

TEST_CASE("sRGB: values of the standard") {
  CHECK(srgb_encode(0) == 0);
  CHECK(srgb_encode(1) == doctest::Approx(1));
  CHECK(srgb_encode(0.5f) == doctest::Approx(0.735357));
  CHECK(srgb_encode(0.002f) == doctest::Approx(12.92 * 0.002));
  CHECK(srgb_decode(0.5f) == doctest::Approx(0.214041));
}

TEST_CASE("sRGB: decoding undoes encoding") {
  for (int i = 0; i <= 1000; ++i) {
    const float linear = static_cast<float>(i) / 1000;
    CHECK(std::abs(srgb_decode(srgb_encode(linear)) - linear) < 3e-7f);
  }
}

TEST_CASE("sRGB: all 256 bytes come back as they were") {
  std::vector<float> linear;
  for (int i = 0; i < 256; ++i) linear.insert(linear.end(), 3, srgb_decode(static_cast<float>(i) / 255));
  const std::vector<std::uint8_t> bytes = tone_map(linear, 0, ToneMap::srgb);
  for (std::size_t i = 0; i < bytes.size(); ++i) CHECK(bytes[i] == i / 3);
}

TEST_CASE("tone map: counts exposure in stops, clips to [0, 1], and makes what is not a number black") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  using Bytes = std::vector<std::uint8_t>;
  CHECK(tone_map({0.25f, 0.5f, 1}, 0, ToneMap::srgb) == Bytes{137, 188, 255});
  CHECK(tone_map({0.25f, 0.5f, 1}, -1, ToneMap::srgb) == Bytes{99, 137, 188});
  CHECK(tone_map({0.125f, 0.25f, 4}, 1, ToneMap::srgb) == Bytes{137, 188, 255});
  CHECK(tone_map({-1, infinity, nan}, 0, ToneMap::srgb) == Bytes{0, 255, 0});
  CHECK(tone_map({-infinity, infinity, nan}, 0, ToneMap::aces) == Bytes{0, 255, 0});
  CHECK(tone_map({0, 1e-30f, 1e30f}, 2000, ToneMap::srgb) == Bytes{0, 255, 255});
}

// The formulas themselves, in double; a grey stays a grey in AgX, and its code value is the contrast's.
TEST_CASE("tone map: the straight pieces are within 1/200 of a step of the curves") {
  const auto srgb = [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
  const auto aces = [](double v) { return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14); };
  const auto agx = [](double v) {
    return static_cast<double>(agx_contrast(static_cast<float>((std::log2(v) + 12.473931) / 16.5)));
  };
  for (double light = 2e-4; light < 16; light *= 1.0003) {
    const auto value = static_cast<float>(light);
    const double exact[] = {srgb(std::min(light, 1.0)), srgb(std::min(aces(light), 1.0)), agx(light)};
    for (const ToneMap curve : {ToneMap::srgb, ToneMap::aces, ToneMap::agx}) {
      const double shown = tone_map({value, value, value}, 0, curve)[1];
      REQUIRE(std::abs(shown - 255 * exact[static_cast<int>(curve)]) <= 0.5 + 1 / 200.0);
    }
  }
}

TEST_CASE("tone map: a texture has the bytes of a picture, and an alpha of 255") {
  std::vector<float> rgb, rgba;
  for (int i = 0; i < 3 * 13 * 7; ++i) {
    rgb.push_back(std::exp2(static_cast<float>(i % 97) / 8 - 9));
    rgba.push_back(rgb.back());
    if (i % 3 == 2) rgba.push_back(std::nanf(""));
  }
  for (const ToneMap curve : {ToneMap::srgb, ToneMap::aces, ToneMap::agx})
    for (const bool dither : {false, true}) {
      const auto picture = tone_map(rgb, 1, curve, 13, dither ? std::optional(DitherOrigin{}) : std::nullopt);
      std::vector<std::uint8_t> texture;
      tone_map_rgba(rgba, 1, curve, 13, dither, texture);
      REQUIRE(texture.size() == rgba.size());
      for (std::size_t i = 0; i < texture.size(); ++i)
        REQUIRE(texture[i] == (i % 4 == 3 ? 255 : picture[i / 4 * 3 + i % 4]));
    }
}

// The fit x(2.51x + 0.03) / (x(2.43x + 0.59) + 0.14) by hand, then sRGB: 0.18 -> 0.2669 -> 141.1, 0.5 -> 0.6163 ->
// 205.9, 1 -> 0.8038 -> 231.6; it reaches 1 at x = 7.2.
TEST_CASE("tone map: ACES") {
  CHECK(tone_map({0.18f, 0.5f, 1}, 0, ToneMap::aces) == std::vector<std::uint8_t>{141, 206, 232});
  CHECK(tone_map({0.36f, 1, 2}, -1, ToneMap::aces) == std::vector<std::uint8_t>{141, 206, 232});
  CHECK(tone_map({0, 8, 1e20f}, 0, ToneMap::aces) == std::vector<std::uint8_t>{0, 255, 255});
}

// Entries of Sobotka's table AgX_Default_Contrast, which has 4096 from 0 to 1: two of the toe, one of the shoulder.
// 0.18 is at 20/33 of the range of stops, and shown at half of the scale.
TEST_CASE("AgX: the contrast is that of its author's table, with 0.18 at half of the scale") {
  CHECK(std::abs(agx_contrast(0)) < 1e-6f);
  CHECK(std::abs(agx_contrast(1466 / 4095.0f) - 0.1000201f) < 1e-6f);
  CHECK(std::abs(agx_contrast(1856 / 4095.0f) - 0.2133565f) < 1e-6f);
  CHECK(std::abs(agx_contrast(2687 / 4095.0f) - 0.6000830f) < 1e-6f);
  CHECK(agx_contrast(20.0f / 33) == doctest::Approx(0.5));
  CHECK(agx_contrast(1) == doctest::Approx(1));
  const auto grey = tone_map({0.18f, 0.18f, 0.18f}, 0, ToneMap::agx);
  for (const std::uint8_t byte : grey) CHECK((byte == 127 || byte == 128));  // 0.5 of 255
}

TEST_CASE("AgX: greys stay grey and grow with the light; colours that are very bright become white") {
  std::uint8_t before = 0;
  for (float light = 1e-6f; light < 100; light *= 1.01f) {
    const auto shown = tone_map({light, light, light}, 0, ToneMap::agx);
    CHECK(shown[0] == shown[1]);
    CHECK(shown[1] == shown[2]);
    CHECK(shown[0] >= before);
    before = shown[0];
  }
  CHECK(before == 255);
  CHECK(tone_map({0, 1e-6f, -1}, 0, ToneMap::agx)[0] == 0);
  const auto red = tone_map({0.5f, 0, 0}, 0, ToneMap::agx), bright = tone_map({1000, 0, 0}, 0, ToneMap::agx);
  CHECK(red[0] > red[1] + 60);
  CHECK(bright[1] > red[1] + 60);
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  CHECK(tone_map({infinity, infinity, infinity}, 0, ToneMap::agx) == std::vector<std::uint8_t>{255, 255, 255});
  CHECK(tone_map({nan, nan, nan}, 0, ToneMap::agx) == std::vector<std::uint8_t>{0, 0, 0});
}

TEST_CASE("dithering: what 8 bits can show stays exact, everything else is one of its two neighbours") {
  std::vector<float> rgb;
  for (int step = 0; step < 256; ++step)
    for (int i = 0; i < 3 * 64; ++i) rgb.push_back(srgb_decode(static_cast<float>(step) / 255));
  const auto bytes = tone_map(rgb, 0, ToneMap::srgb, 64, DitherOrigin{});
  for (std::size_t i = 0; i < bytes.size(); ++i) REQUIRE(bytes[i] == i / 192);
  CHECK(tone_map({-1, std::nanf(""), 2}, 0, ToneMap::srgb, 1, DitherOrigin{}) == std::vector<std::uint8_t>{0, 0, 255});
}

TEST_CASE("dithering: the mean of a flat area is right to 1/128 of a step") {
  for (const float level : {10.3f, 100.02f, 200.5f, 254.9f}) {
    const std::vector<float> rgb(3 * 64, srgb_decode(level / 255));
    double sum = 0;
    for (const std::uint8_t byte : tone_map(rgb, 0, ToneMap::srgb, 8, DitherOrigin{3, 5})) sum += byte;
    CHECK(std::abs(sum / 192 - static_cast<double>(level)) <= 1.01 / 128);
  }
}

TEST_CASE("dithering: a sky of 512 rows has no bands, and a region is dithered like the same part of the whole") {
  const int width = 16, height = 512;
  std::vector<float> sky;
  for (int y = 0; y < height; ++y)
    for (int i = 0; i < 3 * width; ++i) sky.push_back(0.5f + 0.02f * static_cast<float>(y) / height);
  const auto row_means = [&](const std::vector<std::uint8_t>& bytes) {
    std::set<int> means;
    for (int y = 0; y + 8 <= height; y += 8) {
      int sum = 0;
      for (int i = 0; i < 8 * 3 * width; ++i) sum += bytes[static_cast<std::size_t>(y * 3 * width + i)];
      means.insert(sum);
    }
    return means.size();
  };
  CHECK(row_means(tone_map(sky, 0, ToneMap::srgb)) < 20);
  const auto whole = tone_map(sky, 0, ToneMap::srgb, width, DitherOrigin{});
  CHECK(row_means(whole) > 55);
  const std::vector<float> part(sky.begin() + 100 * 3 * width, sky.begin() + 120 * 3 * width);
  const auto region = tone_map(part, 0, ToneMap::srgb, width, DitherOrigin{0, 100});
  CHECK(std::equal(region.begin(), region.end(), whole.begin() + 100 * 3 * width));
}

}  // namespace tyndall::test::tonemap_test
