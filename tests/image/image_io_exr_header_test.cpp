// One test for each row of the table of EXR's header fields in core/image/README.md.
#ifdef TYNDALL_OPENEXR

#include "core/image/image_io.h"
#include "tests/support/exr_files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <OpenEXR/ImfChromaticities.h>
#include <OpenEXR/ImfPreviewImage.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace tyndall::test::image_io_exr_header_test {
namespace fs = std::filesystem;

namespace {

const std::vector<ExrSource> orange = constant_channels({{"R", 0.75f}, {"G", 0.25f}, {"B", 0.125f}});

/// Values that differ at each pixel and in each channel, exact in 16 bits.
std::vector<ExrSource> ramps(Imf::PixelType type = Imf::FLOAT) {
  return {{"R", [](int x, int) { return static_cast<float>(x); }, type},
          {"G", [](int, int y) { return static_cast<float>(y); }, type},
          {"B", [](int x, int y) { return static_cast<float>(x + 8 * y); }, type}};
}
bool is_ramp(const LinearImage& image, int x0, int y0) {
  for (int y = 0, i = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, i += 3) {
      const float* p = &image.rgb[static_cast<std::size_t>(i)];
      const auto u = static_cast<float>(x + x0), v = static_cast<float>(y + y0);
      if (p[0] != u || p[1] != v || p[2] != u + 8 * v) return false;
    }
  return true;
}

void check_colour(const LinearImage& image, const std::vector<double>& expected, double tolerance) {
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    if (!(std::abs(static_cast<double>(image.rgb[i]) - expected[i % 3]) <= tolerance)) {
      CHECK_MESSAGE(false, "value " << i << " is " << image.rgb[i] << ", expected " << expected[i % 3]);
      return;
    }
}

/// What a file says when it is read; "read": nothing.
std::string message_of(const fs::path& file) {
  try {
    read_image(file);
  } catch (const ImageFileError& error) {
    CHECK(std::string(error.what()).find(picture_name(file).file.string()) == 0);
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
  return "read";
}
void check_says(const fs::path& file, const std::vector<std::string>& parts) {
  const std::string message = message_of(file);
  CAPTURE(message);
  for (const std::string& part : parts) CHECK(message.find(part) != message.npos);
}

fs::path exr_file(const std::string& name) { return scratch_folder("exr_header_" + name) / "a.exr"; }

const Imf::Chromaticities rec709;
const Imf::Chromaticities ap0({0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
const Imf::Chromaticities xyz({1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f});

/// A file whose pixels are 0.75, 0.25, 0.125 of Rec.709, in other primaries.
Imf::Header write_in(const fs::path& file, const Imf::Chromaticities& c) {
  Imf::Header header = exr_header(4, 3);
  Imf::addChromaticities(header, c);
  const Imath::V3f v = Imath::V3f(0.75f, 0.25f, 0.125f) * Imf::RGBtoXYZ(rec709, 1) * Imf::XYZtoRGB(c, 1);
  write_exr_file(file, header, constant_channels({{"R", v.x}, {"G", v.y}, {"B", v.z}}));
  return header;
}

}  // namespace

TEST_CASE("EXR header: channels R, G, B in 16 and 32 bits and as whole numbers") {
  for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
    const fs::path file = exr_file("types");
    write_exr_file(file, exr_header(9, 7), ramps(type));
    CHECK(is_ramp(read_image(file), 0, 0));
  }
}

TEST_CASE("EXR header: channels r, g, b and red, green, blue are colours, too") {
  const fs::path file = exr_file("names");
  for (const auto& names : {std::array{"r", "g", "b"}, std::array{"red", "green", "blue"}}) {
    write_exr_file(file, exr_header(4, 3),
                   constant_channels({{names[0], 0.75f}, {names[1], 0.25f}, {names[2], 0.125f}}));
    check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
  }
}

TEST_CASE("EXR header: channel Y alone is grey, whatever the chromaticities") {
  const fs::path file = exr_file("grey");
  Imf::Header header = exr_header(4, 3);
  Imf::addChromaticities(header, ap0);
  write_exr_file(file, header, constant_channels({{"Y", 0.3f}, {"A", 1.0f}, {"Z", 7.0f}}));
  check_colour(read_image(file), {0.3f, 0.3f, 0.3f}, 0);
}

TEST_CASE("EXR header: channels Y, RY, BY are colours, with chroma of 2 x 2 pixels or of each") {
  const fs::path file = exr_file("chroma");
  write_luminance_chroma(file, Imf::Header(64, 32), [](int, int) { return std::vector{0.8f, 0.2f, 0.1f}; });
  check_colour(read_image(file), {0.8, 0.2, 0.1}, 1e-3);
  write_luminance_chroma(file, Imf::Header(Imath::Box2i({0, 0}, {63, 31}), Imath::Box2i({-2, 4}, {9, 21})),
                         [](int x, int) {
                           return std::vector{0.8f, 0.02f * static_cast<float>(x + 2), 0.1f};
                         });
  const LinearImage image = read_image(file);
  CHECK(image.width == 12);
  CHECK(image.rgb[3 * 6 + 1] == doctest::Approx(0.12).epsilon(0.02));
  const double y = 0.75 * 0.2126 + 0.25 * 0.7152 + 0.125 * 0.0722;
  const auto channel = [](double value) { return static_cast<float>(value); };
  write_exr_file(file, exr_header(4, 3),
                 constant_channels({{"Y", channel(y)}, {"RY", channel(0.75 / y - 1)}, {"BY", channel(0.125 / y - 1)}}));
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 1e-4);
}

TEST_CASE("EXR header: luminance and chroma go with the chromaticities") {
  const fs::path file = exr_file("chroma_primaries");
  Imf::Header header(64, 32);
  Imf::addChromaticities(header, ap0);
  const Imath::V3f v = Imath::V3f(0.75f, 0.25f, 0.125f) * Imf::RGBtoXYZ(rec709, 1) * Imf::XYZtoRGB(ap0, 1);
  write_luminance_chroma(file, header, [&](int, int) { return std::vector{v.x, v.y, v.z}; });
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 2e-3);
}

TEST_CASE("EXR header: half of luminance and chroma is no colour, other samplings are refused by name") {
  const fs::path file = exr_file("half_chroma");
  write_exr_file(file, exr_header(4, 3), constant_channels({{"Y", 0.3f}, {"RY", 0.1f}}));
  check_says(file, {"found no channels R, G and B, nor Y", "\"RY\", \"Y\""});
  std::vector<ExrSource> channels = constant_channels({{"Y", 0.3f}, {"RY", 0.1f}, {"BY", 0.1f}});
  channels[1].every_x = channels[1].every_y = channels[2].every_x = channels[2].every_y = 4;
  write_exr_file(file, exr_header(8, 8), channels);
  check_says(file, {"one value for every 4 x 4 pixels in channel RY, expected one for each pixel"});
}

TEST_CASE("EXR header: xSampling and ySampling of colours are refused by name") {
  const fs::path file = exr_file("sampling");
  std::vector<ExrSource> channels = orange;
  channels[1].every_x = 2;
  write_exr_file(file, exr_header(4, 4), channels);
  check_says(file, {"found one value for every 2 x 1 pixels in channel G, expected one for each pixel"});
}

TEST_CASE("EXR header: other channels and their sampling do not matter") {
  const fs::path file = exr_file("others");
  std::vector<ExrSource> channels = orange;
  channels.push_back({"mask", [](int, int) { return 9.0f; }, Imf::UINT, 2, 4});
  write_exr_file(file, exr_header(4, 4), channels);
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
}

TEST_CASE("EXR header: A does not matter: colours are multiplied by it already") {
  const fs::path file = exr_file("alpha");
  for (const float alpha : {0.0f, 0.5f, 1.0f}) {
    std::vector<ExrSource> channels = orange;
    channels.push_back({"A", [alpha](int, int) { return alpha; }});
    write_exr_file(file, exr_header(4, 3), channels);
    check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
  }
}

TEST_CASE("EXR header: every compression is read") {
  const fs::path file = exr_file("compression");
  for (int kind = 0; kind < Imf::NUM_COMPRESSION_METHODS; ++kind) {
    CAPTURE(kind);
    Imf::Header header = exr_header(64, 40);
    header.compression() = static_cast<Imf::Compression>(kind);
    write_exr_file(file, header, ramps(Imf::HALF));
    const LinearImage image = read_image(file);
    const bool exact = kind <= Imf::PXR24_COMPRESSION;
    if (exact) CHECK(is_ramp(image, 0, 0));
    CHECK(image.rgb[3 * (64 * 20 + 32)] == doctest::Approx(32).epsilon(0.05));
    CHECK(image.rgb[3 * (64 * 20 + 32) + 1] == doctest::Approx(20).epsilon(0.05));
  }
}

TEST_CASE("EXR header: lineOrder") {
  const fs::path file = exr_file("order");
  for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
    Imf::Header header = exr_header(9, 70);
    header.lineOrder() = order, header.compression() = Imf::ZIP_COMPRESSION;
    write_exr_file(file, header, ramps());
    CHECK(is_ramp(read_image(file), 0, 0));
  }
}

TEST_CASE("EXR header: tiles in any order and with smaller levels give the picture of full size") {
  const fs::path file = exr_file("tiles");
  for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS})
    for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::RANDOM_Y}) {
      Imf::Header header = exr_header({0, 0, 40, 30}, {3, -5, 29, 22});
      header.setTileDescription({8, 16, mode, Imf::ROUND_UP});
      header.lineOrder() = order;
      write_exr_file(file, header, ramps());
      const LinearImage image = read_image(file);
      CHECK(image.width == 26);
      CHECK(is_ramp(image, 3, -5));
    }
}

TEST_CASE("EXR header: dataWindow and displayWindow say where the pixels lie") {
  const fs::path file = exr_file("windows");
  for (const std::vector<int>& data : {std::vector{0, 0, 16, 9}, {5, 2, 9, 6}, {-3, -4, 20, 13}, {100, 50, 103, 52}}) {
    write_exr_file(file, exr_header({0, 0, 16, 9}, data), ramps());
    const LinearImage image = read_image(file);
    CHECK(is_ramp(image, data[0], data[1]));
    REQUIRE(image.frame.has_value());
    CHECK(image.frame->data == Region{data[0], data[1], data[2], data[3]});
    CHECK(image.frame->display == Region{0, 0, 16, 9});
    CHECK(image.width == data[2] - data[0]);
    CHECK(image.height == data[3] - data[1]);
  }
  write_pfm(file.parent_path() / "a.pfm", {1, 1, {1, 2, 3}});
  CHECK_FALSE(read_image(file.parent_path() / "a.pfm").frame.has_value());
}

TEST_CASE("EXR header: pixelAspectRatio and whiteLuminance come with the picture") {
  const fs::path file = exr_file("aspect");
  Imf::Header header = exr_header(4, 3);
  write_exr_file(file, header, orange);
  CHECK(read_image(file).frame->pixel_aspect == 1);
  CHECK_FALSE(read_image(file).frame->white_luminance.has_value());
  header.pixelAspectRatio() = 2;
  Imf::addWhiteLuminance(header, 80);
  write_exr_file(file, header, orange);
  CHECK(read_image(file).frame->pixel_aspect == 2);
  CHECK(read_image(file).frame->white_luminance == 80.0f);
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
}

TEST_CASE("EXR header: chromaticities are converted to those of Rec.709") {
  const fs::path file = exr_file("chromaticities");
  for (const Imf::Chromaticities& c : {ap0, xyz}) {
    write_in(file, c);
    check_colour(read_image(file), {0.75, 0.25, 0.125}, 1e-6);
  }
  Imf::Chromaticities close = rec709;
  close.white = {0.31272f, 0.32903f};
  Imf::Header header = exr_header(4, 3);
  Imf::addChromaticities(header, close);
  write_exr_file(file, header, orange);
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
}

TEST_CASE("EXR header: chromaticities of layers are converted, numbers that are no colours are not") {
  const fs::path file = exr_file("chromaticities_layers");
  Imf::Header header = exr_header(4, 3);
  Imf::addChromaticities(header, xyz);
  write_exr_file(file, header,
                 constant_channels({{"a.R", 0.95047f},
                                    {"a.G", 1.0f},
                                    {"a.B", 1.08883f},
                                    {"Ns.X", 0.5f},
                                    {"Ns.Y", 0.25f},
                                    {"Ns.Z", -1.0f},
                                    {"depth.Z", 7.0f}}));
  check_colour(read_image(file.string() + ":a"), {1, 1, 1}, 1e-3);
  check_colour(read_image(file.string() + ":Ns"), {0.5, 0.25, -1}, 0);
  check_colour(read_image(file.string() + ":depth"), {7, 7, 7}, 0);
}

TEST_CASE("EXR header: chromaticities that span no colours are refused by name") {
  const fs::path file = exr_file("degenerate");
  const Imath::V2f white(0.3127f, 0.329f), nan(NAN, 0.3f);
  for (const Imf::Chromaticities& c : {Imf::Chromaticities({0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, white),
                                       Imf::Chromaticities({0.1f, 0.1f}, {0.2f, 0.2f}, {0.3f, 0.3f}, white),
                                       Imf::Chromaticities(rec709.red, rec709.green, rec709.blue, {0.5f, 0.0f}),
                                       Imf::Chromaticities(rec709.red, rec709.green, nan, white)}) {
    Imf::Header header = exr_header(4, 4);
    Imf::addChromaticities(header, c);
    write_exr_file(file, header, orange);
    check_says(file, {"attribute chromaticities", "span no colours"});
    write_exr_file(file, header, constant_channels({{"Y", 0.3f}, {"RY", 0.1f}, {"BY", 0.1f}}));
    check_says(file, {"attribute chromaticities", "span no colours"});
  }
}

TEST_CASE("EXR header: adoptedNeutral becomes white") {
  const fs::path file = exr_file("neutral");
  Imf::Header header = exr_header(4, 3);
  Imf::addChromaticities(header, ap0);
  const std::vector<ExrSource> white = constant_channels({{"R", 0.5f}, {"G", 0.5f}, {"B", 0.5f}});
  write_exr_file(file, header, white);
  CHECK(read_image(file).rgb[0] > read_image(file).rgb[2] + 0.01f);  // the white of AP0 is yellower
  Imf::addAdoptedNeutral(header, ap0.white);
  write_exr_file(file, header, white);
  check_colour(read_image(file), {0.5, 0.5, 0.5}, 1e-4);
  Imf::addAdoptedNeutral(header, {0, 0});
  write_exr_file(file, header, white);
  check_says(file, {"attribute adoptedNeutral that is no chromaticity"});
}

TEST_CASE("EXR header: what says how a picture was taken or is to be shown does not change its pixels") {
  const fs::path file = exr_file("without_meaning");
  Imf::Header header = exr_header(4, 3);
  header.screenWindowCenter() = {3, 4};
  header.screenWindowWidth() = 7;
  Imf::addXDensity(header, 300), Imf::addOwner(header, "me"), Imf::addComments(header, "none");
  Imf::addCapDate(header, "2026:01:01 00:00:00"), Imf::addUtcOffset(header, 60), Imf::addLongitude(header, 1);
  Imf::addLatitude(header, 1), Imf::addAltitude(header, 1), Imf::addFocus(header, 2), Imf::addExpTime(header, 0.5f);
  Imf::addAperture(header, 8), Imf::addIsoSpeed(header, 800), Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
  Imf::addKeyCode(header, Imf::KeyCode()), Imf::addTimeCode(header, Imf::TimeCode());
  Imf::addWrapmodes(header, "black"), Imf::addFramesPerSecond(header, Imf::Rational(24, 1));
  Imf::addRenderingTransform(header, "brighter"), Imf::addLookModTransform(header, "darker");
  Imf::addWorldToCamera(header, Imath::M44f(2)), Imf::addWorldToNDC(header, Imath::M44f(2));
  header.setPreviewImage(Imf::PreviewImage(2, 2));
  write_exr_file(file, header, orange);
  check_colour(read_image(file), {0.75, 0.25, 0.125}, 0);
}

TEST_CASE("EXR header: a version that is not known is refused") {
  const fs::path file = exr_file("version");
  write_exr_file(file, exr_header(4, 3), orange);
  std::string bytes = read_text(file);
  bytes[4] = 3;
  write_text(file, bytes);
  check_says(file, {"version 3"});
}

#endif

}  // namespace tyndall::test::image_io_exr_header_test
