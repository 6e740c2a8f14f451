#include "tests/scene/files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <ctime>
#include <regex>
#include <sstream>

namespace tyndall::test::bad_scenes_test {

namespace {

const std::filesystem::path folder = tests_folder() / "scene";

/// The file that a line of the table stands for.
std::string file_of(const std::string& line) {
  const std::string begin = R"({ "tyndall": 1, )", object = "  object ", text = "  text ";
  const std::string materials = R"("materials": { "white": { "type": "lambertian", "albedo": [0.7, 0.7, 0.7] },
    "glass": { "type": "dielectric", "refractive_index": 1.5 } }, "objects": [)";
  if (line.starts_with(object)) return begin + materials + line.substr(object.size()) + "] }";
  if (line.starts_with(text)) return std::regex_replace(line.substr(text.size()), std::regex("⏎"), "\n");
  return begin + line + " }";
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

TEST_CASE("bad scenes: each is refused with the line that it carries") {
  std::istringstream table(test::read_text(folder / "bad_scenes.txt"));
  int scenes = 0;
  for (std::string expected, line; std::getline(table, expected);) {
    if (expected.starts_with("#")) continue;
    std::getline(table, line);
    CAPTURE(line);
    std::string found = complaint(file_of(line), {}, folder);
    CHECK_FALSE(has_control_character(found));
    if (constexpr std::string_view more = "…"; expected.ends_with(more)) {
      expected.resize(expected.size() - more.size());
      CHECK(found.size() > expected.size());
      found.resize(std::min(found.size(), expected.size()));
    }
    CHECK(found == expected);
    ++scenes;
  }
  CHECK(scenes > 100);
}

TEST_CASE("bad scenes: empty files, broken texts and odd bytes are refused, too") {
  CHECK(complaint("") == "/: found an empty file, expected a scene: { \"tyndall\": 1, … }");
  CHECK(complaint(" \n\t ") == "/: found an empty file, expected a scene: { \"tyndall\": 1, … }");
  CHECK(complaint(std::string(3, '\0')) == "line 1, column 1: found a zero byte, expected text in UTF-8");
  CHECK(complaint("{\"tyndall\": 1, \"name\": \"\xff\"}") ==
        "line 1, column 25: found bytes that are not UTF-8, expected text in UTF-8");
  CHECK(complaint("{\"t\": \"abc").starts_with("line 1, column 11: found a text that is not closed"));
  CHECK(complaint("{\"t\": \"\\ud800\"}").find("half of a \\u pair") != std::string::npos);
  CHECK(complaint("{\"t\": \"\\u12x\"}").find("without 4 hexadecimal digits") != std::string::npos);
  CHECK(complaint("{\"ä\": ö}").starts_with("line 1, column 7: found 'ö', expected a value"));
  CHECK(complaint("{\r\n  \"tyndall\": 1,\r\n  nix\r\n}").starts_with("line 3, column 3: found 'nix'"));
  CHECK(complaint("\"" + std::string(1000, 'x') + "\" 1").size() < 200);
  CHECK(complaint("\xef\xbb\xbf{ \"tyndall\": 1 }") == "");  // a byte order mark is no fault
}

TEST_CASE("bad scenes: nesting is refused before it is built, 64 levels are not") {
  const std::clock_t start = std::clock();  // processor time
  const std::string deep = complaint(std::string(1000000, '['));
  const auto more = complaint("{ \"tyndall\": 1, \"objects\": " + std::string(1000000, '['));
  CHECK(std::clock() - start < 2 * CLOCKS_PER_SEC);
  CHECK(deep == "/0/0/0/…: found brackets nested more than 64 deep, expected at most 64 levels");
  CHECK(more == "/objects/0/0/…: found brackets nested more than 64 deep, expected at most 64 levels");
  std::string groups = "{ \"tyndall\": 1";
  for (int level = 0; level < 33; ++level) groups += ", \"objects\": [{ \"type\": \"group\"";
  CHECK(complaint(groups).starts_with("/objects/0/objects/…: found brackets nested more than 64 deep"));
  const auto nested = [](std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  CHECK(complaint(nested(65)).find("nested more") != std::string::npos);
  CHECK(complaint(nested(64)) == "/: found an array of 1 value, expected a scene: { \"tyndall\": 1, … }");
}

TEST_CASE("bad scenes: long names and values are cut in the message") {
  const std::string name(100000, 'n');
  CHECK(complaint("{ \"tyndall\": 1, \"" + name + "\": 1 }").size() < 1000);
  CHECK(complaint("{ \"tyndall\": 1, \"name\": 1, \"camera\": \"" + name + "\" }").size() < 1000);
}

TEST_CASE("bad scenes: a scene of more than 256 MiB is refused") {
  std::string text(std::size_t(256) << 20, ' ');
  const std::string begin = "{ \"tyndall\": 1 }";
  text.replace(0, begin.size(), begin);
  CHECK(complaint(text) == "");
  text += ' ';
  CHECK(complaint(text) == "/: found more than 256 MiB of text, expected a scene of at most 256 MiB");
}

}  // namespace tyndall::test::bad_scenes_test
