#ifdef TYNDALL_OPENEXR

#include "app/comparison/baseline.h"
#include "app/text/values.h"
#include "core/image/image_io.h"
#include "tests/support/exr_files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <OpenEXR/ImfStandardAttributes.h>

namespace tyndall::test::pair_test {
namespace fs = std::filesystem;

namespace {

/// A picture of its own coordinates, so that pixels of one place are equal.
const std::vector<ExrSource> place{{"R", [](int x, int) { return static_cast<float>(x); }},
                                   {"G", [](int, int y) { return static_cast<float>(y); }},
                                   {"B", [](int, int) { return 1.0f; }}};

fs::path exr(const fs::path& file, const std::vector<int>& display, const std::vector<int>& data) {
  write_exr_file(file, exr_header(display, data), place);
  return file;
}
fs::path pfm(const fs::path& file, int x0, int y0, int x1, int y1) {
  LinearImage image{x1 - x0, y1 - y0, {}};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) image.rgb.insert(image.rgb.end(), {static_cast<float>(x), static_cast<float>(y), 1});
  write_pfm(file, image);
  return file;
}

std::string refusal(const fs::path& image, const fs::path& reference) {
  try {
    compare_images(image, reference);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "compared";
}

const std::vector<int> display{0, 0, 16, 9};

}  // namespace

TEST_CASE("pair: EXR files of one display window are compared by position, over the pixels that both have") {
  const fs::path folder = scratch_folder("pair_windows");
  const fs::path whole = exr(folder / "whole.exr", display, display);
  struct Case {
    std::vector<int> data;
    std::size_t both;
  };
  for (const auto& [data, both] : {Case{{3, 2, 9, 6}, 24}, Case{{-2, -3, 20, 12}, 144}, Case{{-4, 5, 6, 20}, 24},
                                   Case{{15, 8, 30, 30}, 1}, Case{{0, 0, 16, 9}, 144}, Case{{1, 1, 17, 10}, 120}}) {
    const fs::path other = exr(folder / "other.exr", display, data);
    for (const bool swapped : {false, true}) {
      const Comparison c = swapped ? compare_images(whole, other) : compare_images(other, whole);
      CHECK(c.error.mse == 0);
      CHECK(c.flip_map.size() == both);
      CHECK(static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height) == both);
      CHECK((swapped ? c.image_pixels : c.reference_pixels) == 144);
      CHECK(overlap_text(c).empty() == (data == display));
    }
  }
  const Comparison two =
      compare_images(exr(folder / "a.exr", display, {0, 0, 5, 5}), exr(folder / "b.exr", display, {3, 4, 9, 9}));
  CHECK(overlap_text(two) == "2 that both have, of 25 in the image and 30 in the reference");
}

TEST_CASE("pair: EXR files without a common pixel or of different display windows are refused") {
  const fs::path folder = scratch_folder("pair_refused");
  const fs::path a = exr(folder / "a.exr", display, {0, 0, 5, 5});
  CHECK(refusal(a, exr(folder / "b.exr", display, {5, 0, 9, 5})) ==
        a.string() + ": found pixels in the data window 0,0,5,5 alone, expected some in 5,0,9,5 as in " +
            (folder / "b.exr").string());
  CHECK(refusal(a, exr(folder / "b.exr", {0, 0, 17, 9}, {0, 0, 5, 5})) ==
        a.string() + ": found the display window 0,0,16,9, expected 0,0,17,9 as in " + (folder / "b.exr").string());
  CHECK(refusal(a, exr(folder / "b.exr", {1, 0, 17, 9}, {0, 0, 5, 5})).find("display window") != std::string::npos);
}

TEST_CASE("pair: pixelAspectRatio and whiteLuminance must be the same") {
  const fs::path folder = scratch_folder("pair_fields");
  const auto write = [&](const char* name, float aspect, float luminance) {
    Imf::Header header = exr_header(display, display);
    header.pixelAspectRatio() = aspect;
    if (luminance > 0) Imf::addWhiteLuminance(header, luminance);
    write_exr_file(folder / name, header, place);
    return folder / name;
  };
  const fs::path plain = write("plain.exr", 1, 0), wide = write("wide.exr", 2, 0), bright = write("bright.exr", 1, 80);
  CHECK(refusal(wide, plain).find("wide.exr: found pixelAspectRatio 2, expected 1 as in") != std::string::npos);
  CHECK(refusal(wide, write("wide2.exr", 2, 0)) == "compared");
  CHECK(refusal(bright, plain) == "compared");
  CHECK(refusal(bright, write("b.exr", 1, 100)).find("found whiteLuminance 80, expected 100") != std::string::npos);
  const fs::path other = pfm(folder / "a.pfm", 0, 0, 16, 9);
  CHECK(refusal(other, wide).find("found square pixels, expected pixelAspectRatio 2") != std::string::npos);
  CHECK_THROWS_AS(read_whole_picture(wide), UsageError);
}

TEST_CASE("pair: a picture without windows is the display window of an EXR, or its data window, by its size") {
  const fs::path folder = scratch_folder("pair_plain");
  const fs::path whole = pfm(folder / "whole.pfm", 0, 0, 16, 9), part = pfm(folder / "part.pfm", 3, 2, 9, 6);
  const fs::path region = exr(folder / "region.exr", display, {3, 2, 9, 6});
  const fs::path overscan = exr(folder / "overscan.exr", display, {-2, -2, 18, 11});
  for (const auto& [one, other, both] : {std::tuple{whole, region, 24}, {part, region, 24}, {whole, overscan, 144}}) {
    CHECK(compare_images(one, other).error.mse == 0);
    CHECK(compare_images(other, one).error.mse == 0);
    CHECK(compare_images(other, one).flip_map.size() == static_cast<std::size_t>(both));
  }
  CHECK(refusal(part, overscan) ==
        part.string() + ": found 6x4 pixels, expected 16x9 or 20x13 as in " + overscan.string());
  CHECK(refusal(part, whole) == part.string() + ": found 6x4 pixels, expected 16x9 as in " + whole.string());
}

TEST_CASE("pair: what others are measured against is cut to its display window, and must fill it") {
  const fs::path folder = scratch_folder("pair_reference");
  const LinearImage image = read_whole_picture(exr(folder / "a.exr", {5, 5, 21, 14}, {0, 0, 40, 40})).image;
  CHECK(image.width == 16);
  CHECK(image.height == 9);
  CHECK(image.rgb[0] == 5);
  CHECK(image.rgb.back() == 1);
  const fs::path part = exr(folder / "part.exr", display, {0, 0, 16, 8});
  CHECK_THROWS_WITH_AS(read_whole_picture(part),
                       (part.string() + ": found the pixels of its data window 0,0,16,8 alone, expected all of its "
                                        "display window 0,0,16,9")
                           .c_str(),
                       UsageError);
}

TEST_CASE("baseline: layers of EXR files, and parts of pictures") {
  const fs::path folder = scratch_folder("pair_baseline");
  fs::create_directories(folder / "base");
  write_exr_file(
      folder / "a.exr", exr_header(display, {3, 2, 9, 6}),
      constant_channels({{"R", 1}, {"G", 1}, {"B", 1}, {"x.Combined.R", 2}, {"x.Combined.G", 2}, {"x.Combined.B", 2}}));
  BaselineRequest request{folder / "base", {folder / "a.exr:x.Combined"}, {}};
  CHECK(update_baseline(request).files == std::map<std::string, fs::path>{{"a.exr:x.Combined", request.images[0]}});
  CHECK(fs::exists(folder / "base" / "a.exr"));
  const auto checked = check_baseline(request).pictures;
  REQUIRE(checked.size() == 1);
  CHECK(checked[0].failures.empty());
  CHECK(checked[0].comparison->error.mean_image.x == 2);
  write_exr_file(folder / "a.exr", exr_header(display, display), constant_channels({{"x.Combined.Y", 2}}));
  const auto again = check_baseline(request).pictures;
  CHECK(again[0].failures.empty());
  CHECK(again[0].comparison->flip_map.size() == 24);
  write_html_report(folder / "report.html", again, PpmCurve::srgb);
  CHECK(read_text(folder / "report.html").find("24 that both have, of 144 in the image and 24") != std::string::npos);
  write_exr_file(folder / "a.exr", exr_header(display, display), constant_channels({{"x.R", 2}}));
  REQUIRE(check_baseline(request).pictures[0].failures.size() == 1);
  CHECK(check_baseline(request).pictures[0].failures[0].find("found no layer \"x.Combined\"") != std::string::npos);
}

#endif

}  // namespace tyndall::test::pair_test
