#ifdef TYNDALL_OPENEXR

#include "core/image/image_io.h"
#include "tests/support/exr_files.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <OpenEXR/ImfStandardAttributes.h>

namespace tyndall::test::image_io_exr_layers_test {
namespace fs = std::filesystem;

namespace {

fs::path exr_file(const std::string& name) { return scratch_folder("exr_layers_" + name) / "a.exr"; }

ExrPartSource part(const std::string& name, const std::vector<std::pair<std::string, float>>& channels) {
  Imf::Header header = exr_header(4, 3);
  header.setName(name);
  return {header, constant_channels(channels)};
}

/// The first pixel, as "0.75 0.25 0.125", or what is said instead.
std::string first_pixel(const fs::path& name) {
  try {
    const LinearImage image = read_image(name);
    std::ostringstream text;
    text << image.rgb[0] << ' ' << image.rgb[1] << ' ' << image.rgb[2];
    return text.str();
  } catch (const ImageFileError& error) {
    return error.what();
  }
}
std::string layer_of(const fs::path& file, const std::string& layer) {
  return first_pixel(file.string() + ':' + layer);
}

bool says(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& one : parts)
    if (text.find(one) == text.npos) return false;
  return true;
}

}  // namespace

TEST_CASE("EXR layers: of several parts the first that has colour is taken") {
  const fs::path file = exr_file("parts");
  write_exr_file(file, {part("depth", {{"Z", 7}}), part("motion", {{"X", 1}, {"Y", 2}, {"Z", 3}}),
                        part("beauty", {{"R", 0.75f}, {"G", 0.25f}, {"B", 0.125f}, {"A", 1}}),
                        part("more", {{"R", 1}, {"G", 1}, {"B", 1}})});
  CHECK(first_pixel(file) == "0.75 0.25 0.125");
  CHECK(layer_of(file, "more") == "1 1 1");
  CHECK(layer_of(file, "depth") == "7 7 7");
  CHECK(layer_of(file, "depth.Z") == "7 7 7");
  CHECK(layer_of(file, "motion") == "1 2 3");
  write_exr_file(file, {part("depth", {{"Z", 7}}), part("grey", {{"Y", 0.5f}})});
  CHECK(first_pixel(file) == "0.5 0.5 0.5");
}

TEST_CASE("EXR layers: a part's own name may stand before its channels") {
  const fs::path file = exr_file("named_parts");
  write_exr_file(
      file, {part("depth", {{"depth.Z", 7}}),
             part("beauty", {{"beauty.R", 0.75f}, {"beauty.G", 0.25f}, {"beauty.B", 0.125f}}),
             part("light", {{"key.R", 1}, {"key.G", 2}, {"key.B", 3}, {"fill.R", 4}, {"fill.G", 5}, {"fill.B", 6}})});
  CHECK(first_pixel(file) == "0.75 0.25 0.125");
  CHECK(layer_of(file, "beauty") == "0.75 0.25 0.125");
  CHECK(layer_of(file, "light.key") == "1 2 3");
  CHECK(layer_of(file, "fill") == "4 5 6");
  CHECK(layer_of(file, "depth.Z") == "7 7 7");
}

TEST_CASE("EXR layers: without colour the channels and the layers are listed") {
  const fs::path file = exr_file("listed");
  write_exr_file(file, exr_header(4, 3),
                 constant_channels({{"ViewLayer.Combined.R", 0.75f},
                                    {"ViewLayer.Combined.G", 0.25f},
                                    {"ViewLayer.Combined.B", 0.125f},
                                    {"ViewLayer.Combined.A", 1},
                                    {"ViewLayer.Depth.Z", 7},
                                    {"Composite.Vector.U", 1},
                                    {"Composite.Vector.V", 2}}));
  const std::string message = first_pixel(file);
  CAPTURE(message);
  CHECK(says(message, {"a.exr: cannot read: found no channels R, G and B, nor Y, but ", "\"ViewLayer.Combined.R\"",
                       "\"ViewLayer.Depth.Z\"", "\"Composite.Vector.U\"",
                       "a.exr:LAYER takes a layer: \"ViewLayer.Combined\", \"ViewLayer.Depth\""}));
  CHECK(layer_of(file, "ViewLayer.Combined") == "0.75 0.25 0.125");
  CHECK(layer_of(file, "ViewLayer.Depth") == "7 7 7");
  CHECK(layer_of(file, "ViewLayer.Combined.A") == "1 1 1");
  CHECK(layer_of(file, "Composite.Vector.V") == "2 2 2");
  CHECK(says(layer_of(file, "Composite.Vector"), {"\"Composite.Vector.U\", \"Composite.Vector.V\"", "by its name"}));
}

TEST_CASE("EXR layers: a misspelt layer gets the list of the layers") {
  const fs::path file = exr_file("misspelt");
  write_exr_file(file, exr_header(4, 3),
                 constant_channels({{"R", 1},
                                    {"G", 1},
                                    {"B", 1},
                                    {"ViewLayer.Combined.R", 1},
                                    {"ViewLayer.Combined.G", 1},
                                    {"ViewLayer.Combined.B", 1},
                                    {"Depth.Z", 7}}));
  for (const char* name : {"ViewLayer.Combind", "", "R.", ".R", "depth", "a.exr", ":"}) {
    CAPTURE(name);
    CHECK(says(layer_of(file, name), {"found no layer \"", "expected one of \"Depth\", \"ViewLayer.Combined\""}));
    CHECK_THROWS_AS(read_image(file.string() + ':' + name), NoSuchLayer);
  }
  CHECK(says(layer_of(file, "ViewLayer.Combind"), {"did you mean \"ViewLayer.Combined\"?"}));
  write_exr_file(file, exr_header(4, 3), constant_channels({{"R", 1}, {"G", 1}, {"B", 1}}));
  CHECK(says(layer_of(file, "x"), {"found no layer \"x\", expected none: it has the channels \"B\", \"G\", \"R\""}));
}

TEST_CASE("EXR layers: hundreds of them are listed in one line of bearable length") {
  const fs::path file = exr_file("many");
  std::vector<std::pair<std::string, float>> channels;
  for (int i = 0; i < 300; ++i) channels.push_back({"layer" + std::to_string(i) + ".mask", 1.0f});
  write_exr_file(file, exr_header(4, 3), constant_channels(channels));
  const std::string message = first_pixel(file);
  CHECK(says(message, {"and 276 more"}));
  CHECK(message.size() < 1900);
  CHECK(layer_of(file, "layer299") == "1 1 1");
}

TEST_CASE("EXR layers: views, in one part by their names, in several by the attribute") {
  const fs::path file = exr_file("views");
  Imf::Header header = exr_header(4, 3);
  Imf::addMultiView(header, {"left", "right"});
  write_exr_file(file, header,
                 constant_channels({{"R", 1}, {"G", 2}, {"B", 3}, {"right.R", 4}, {"right.G", 5}, {"right.B", 6}}));
  CHECK(first_pixel(file) == "1 2 3");
  CHECK(layer_of(file, "left") == "1 2 3");
  CHECK(layer_of(file, "right") == "4 5 6");
  ExrPartSource left = part("picture.left", {{"R", 1}, {"G", 2}, {"B", 3}});
  ExrPartSource right = part("picture.right", {{"R", 4}, {"G", 5}, {"B", 6}});
  left.header.setView("left"), right.header.setView("right");
  write_exr_file(file, {left, right});
  CHECK(first_pixel(file) == "1 2 3");
  CHECK(layer_of(file, "right") == "4 5 6");
  CHECK(layer_of(file, "picture.right") == "4 5 6");
}

TEST_CASE("EXR layers: parts with windows of their own") {
  const fs::path file = exr_file("windows");
  ExrPartSource small = part("small", {{"Z", 1}}), large = part("large", {{"R", 1}, {"G", 2}, {"B", 3}});
  large.header.dataWindow() = Imath::Box2i({-1, 2}, {9, 5});
  write_exr_file(file, {small, large});
  CHECK(read_image(file).frame->data == Region{-1, 2, 10, 6});
  CHECK(read_image(file.string() + ":small").frame->data == Region{0, 0, 4, 3});
}

TEST_CASE("EXR layers: deep data is passed by where there is a flat picture, and refused where not") {
  const fs::path file = exr_file("deep");
  write_deep_exr(file, {part("flat", {{"R", 1}, {"G", 2}, {"B", 3}})});
  CHECK(first_pixel(file) == "1 2 3");
  CHECK(says(layer_of(file, "deep"), {"layer \"deep\": found deep data (many depths a pixel), expected a flat"}));
  CHECK_FALSE(read_film(file).has_value());
  CHECK_FALSE(read_embedded_scene(file).has_value());
  write_deep_exr(file);
  CHECK(says(first_pixel(file), {"found deep data (many depths a pixel), expected a flat picture"}));
}

TEST_CASE("EXR layers: luminance and chroma in layers and parts") {
  const fs::path file = exr_file("chroma");
  const std::vector<std::pair<std::string, float>> grey{{"Y", 0.5f}, {"RY", 0}, {"BY", 0}};
  write_exr_file(file, {part("depth", {{"Z", 7}}), part("picture", grey)});
  CHECK(first_pixel(file) == "0.5 0.5 0.5");
  write_exr_file(file, exr_header(4, 3), constant_channels({{"a.Y", 0.5f}, {"a.RY", 1}, {"a.BY", 0}}));
  CHECK(read_image(file.string() + ":a").rgb[0] == 1.0f);
  std::vector<ExrSource> sampled = constant_channels({{"a.Y", 0.5f}, {"a.RY", 1}, {"a.BY", 0}});
  for (std::size_t i : {1u, 2u}) sampled[i].every_x = sampled[i].every_y = 2;
  write_exr_file(file, exr_header(4, 4), sampled);
  CHECK(read_image(file.string() + ":a").rgb[0] == doctest::Approx(1).epsilon(1e-3));
  for (ExrSource& channel : sampled) channel.name = channel.name.substr(2);
  Imf::Header one = exr_header(4, 4), two = exr_header(4, 4);
  one.setName("a"), two.setName("b");
  write_exr_file(file, {{one, constant_channels({{"Z", 7}})}, {two, sampled}});
  CHECK(says(first_pixel(file), {"luminance and chroma of 2 x 2 pixels in a file of several parts"}));
}

TEST_CASE("picture names: a ':' in a file's own name, and in a layer's") {
  const fs::path folder = exr_file("colon").parent_path();
  const std::vector<ExrSource> channels =
      constant_channels({{"R", 1}, {"G", 2}, {"B", 3}, {"x:y.R", 4}, {"x:y.G", 5}, {"x:y.B", 6}});
  write_exr_file(folder / "a:b.exr", exr_header(4, 3), channels);
  CHECK(first_pixel(folder / "a:b.exr") == "1 2 3");
  CHECK(first_pixel(folder / "a:b.exr:x:y") == "4 5 6");
  write_exr_file(folder / "a.exr", exr_header(4, 3), channels);
  write_pfm(folder / "a.exr:x", {1, 1, {7, 8, 9}});
  CHECK(first_pixel(folder / "a.exr:x") == "7 8 9");  // a file of the whole name
  CHECK(first_pixel(folder / "a.exr:x:y").find("found a layer's name after a file that is no EXR") !=
        std::string::npos);
  CHECK(picture_name(folder / "none.exr:x").file == folder / "none.exr:x");
  CHECK(picture_name(":x").file == ":x");
}

#endif

}  // namespace tyndall::test::image_io_exr_layers_test
