#include "app/files/outputs.h"

#include "app/text/values.h"
#include "core/base/error.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace tyndall::test::outputs_test {

namespace {

/// An empty folder of this test.
std::filesystem::path empty_folder(const char* name) {
  const std::filesystem::path folder = scratch_folder() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TEST_CASE("names of images") {
  CHECK_NOTHROW(check_image_names({"a.png", "b.PFM", "c.hdr", "d.Ppm"}));
  for (const char* name : {"a.jpg", "png", "a", "a.png.txt", ".png"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(check_image_names({name}), UsageError);
  }
  CHECK_THROWS_AS(check_image_names({"a.png", "b.png", "a.png"}), UsageError);
  const ImageForm gamma2{"", true, PpmCurve::gamma2};
  CHECK_NOTHROW(check_image_names({"a.png", "b.ppm"}, gamma2));
  CHECK_THROWS_WITH_AS(check_image_names({"a.png"}, gamma2),
                       "--gamma2: found no output that ends in .ppm, expected one: only PPM is written so", UsageError);
  CHECK(is_exr("a.EXR"));
  CHECK_FALSE(is_exr("a.png"));
}

TEST_CASE("standard output needs a format, and a format needs standard output") {
  const auto refusal = [](const std::vector<std::filesystem::path>& files, const char* format, const char* stats) {
    try {
      check_image_names(files, {format}, stats);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal({"-"}, "", "").find("expected --format as well") != std::string::npos);
  CHECK(refusal({"a.png"}, "png", "").find("expected -o - as well") != std::string::npos);
  CHECK(refusal({"-", "-"}, "png", "").find("- twice") != std::string::npos);
  CHECK(refusal({"-"}, "png", "-").find("only one can go to standard output") != std::string::npos);
}

TEST_CASE("whether a file can be written is known beforehand, and asking leaves nothing") {
  const auto folder = empty_folder("outputs_test");
  CHECK_NOTHROW(check_can_write(folder / "a.png"));
  CHECK(std::filesystem::is_empty(folder));
  CHECK_THROWS_AS(check_can_write(folder / "none" / "a.png"), IoError);
  std::filesystem::create_directory(folder / "b.png");
  CHECK_THROWS_AS(check_can_write(folder / "b.png"), ImageFileError);
  std::ofstream(folder / "c.png") << "old";
  CHECK_NOTHROW(check_can_write(folder / "c.png"));
  CHECK(std::filesystem::file_size(folder / "c.png") == 3);
}

TEST_CASE("outputs over inputs are refused, under whatever name; so are two outputs that are one file") {
  const auto folder = empty_folder("outputs_over_inputs");
  const auto scene = folder / "scene.json";
  std::ofstream(scene) << "scene";
  std::ofstream(folder / "other.json") << "other";
  std::filesystem::create_directory(folder / "sub");
  std::filesystem::create_symlink("scene.json", folder / "link.json");
  std::filesystem::create_hard_link(scene, folder / "hard.json");
  const std::vector<std::filesystem::path> inputs = {folder / "none.png", scene};
  for (const char* name : {"scene.json", "./scene.json", "sub/../scene.json", "link.json", "hard.json"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(check_outputs({{"--stats", folder / name}}, inputs), UsageError);
  }
  CHECK_NOTHROW(check_outputs({{"--stats", folder / "other.json"}, {"--output", folder / "new.png"}}, inputs));
  CHECK_NOTHROW(check_outputs({{"--stats", ""}, {"--output", ""}, {"--stats", "-"}, {"--stats", "-"}}, inputs));
  CHECK_THROWS_AS(check_outputs({{"--output", folder / "sub/../new.png"}, {"--stats", folder / "new.png"}}, {}),
                  UsageError);
  CHECK_THROWS_AS(check_outputs({{"--output", folder / "hard.json"}, {"--stats", folder / "link.json"}}, {}),
                  UsageError);
}

TEST_CASE("what can be written is written, though something else cannot") {
  const auto folder = empty_folder("outputs_test");
  Film film = make_film(3, 2, {0, 0, 3, 2}, 0, 1);
  const LinearImage image{3, 2, resolve(film)};
  const Picture picture{film, image, {}, [](const auto& file) { return Embedded{file.filename().string(), ""}; }, {}};
  const auto problems =
      write_images(picture, {folder / "a.pfm", folder / "none" / "b.png", folder / "c.png", folder / "d.png"});
  REQUIRE(problems.size() == 1);
  CHECK(problems[0].find("b.png") != std::string::npos);
  CHECK(read_image(folder / "a.pfm").width == 3);
  CHECK(read_embedded_scene(folder / "c.png") == "c.png");
  CHECK(read_embedded_scene(folder / "d.png") == "d.png");
}

TEST_CASE(
    "what cannot be written where it belongs goes beside it, then among the temporary files, and the error says "
    "where") {
  const auto folder = empty_folder("outputs_rescue");
  const auto refuses = [&](const std::filesystem::path& refused) {
    return [=](const std::filesystem::path& file) {
      if (file.parent_path() == refused || file == refused)
        throw ImageFileError(file.string() + ": cannot write: busy");
      write_text_file(file, "picture");
    };
  };
  const auto problem = [](const std::filesystem::path& file, const auto& write) {
    try {
      write_or_rescue(file, write);
    } catch (const ImageFileError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  const auto file = folder / "a.png";
  const std::string busy = file.string() + ": cannot write: busy";
  CHECK(problem(folder / "b.png", refuses(file)) == "none");
  CHECK(problem(file, refuses(file)) == busy + "; it is in " + (folder / "a.new.png").string() + " instead");
  CHECK(problem(file, refuses(file)) == busy + "; it is in " + (folder / "a.new-2.png").string() + " instead");
  CHECK(std::filesystem::file_size(folder / "a.new-2.png") == 7);
  std::filesystem::create_directory(folder / "tmp");
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", (folder / "tmp").c_str(), 1);
  const std::string far = problem(file, refuses(folder));
  CHECK(far.find(busy + "; it is in " + (folder / "tmp" / "tyndall-").string()) == 0);
  CHECK(far.find("/a.png instead") != std::string::npos);
  // Nowhere: the error alone, and nothing is left.
  std::filesystem::remove_all(folder / "tmp");
  std::filesystem::create_directory(folder / "tmp");
  const auto never = [](const std::filesystem::path& at) {
    throw ImageFileError(at.string() + ": cannot write: full");
  };
  CHECK(problem(file, never) == file.string() + ": cannot write: full");
  CHECK(std::filesystem::is_empty(folder / "tmp"));
  setenv("TMPDIR", "/nowhere", 1);
  CHECK(problem(file, never) == file.string() + ": cannot write: full");
  if (before)
    setenv("TMPDIR", kept.c_str(), 1);
  else
    unsetenv("TMPDIR");
  // What goes through a pipe was for a reader who has left.
  int calls = 0;
  const auto count = [&calls](const std::filesystem::path& at) {
    ++calls;
    throw ImageFileError(at.string() + ": cannot write: Broken pipe");
  };
  CHECK(problem("-", count) == "-: cannot write: Broken pipe");
  CHECK(calls == 1);
}

}  // namespace tyndall::test::outputs_test
