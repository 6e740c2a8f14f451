#include "app/files/outputs.h"

#include "app/text/values.h"
#include "core/base/error.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>

namespace tyndall::test::outputs_test {
namespace fs = std::filesystem;

TEST_CASE("names of images; standard output needs a format, and a format needs standard output") {
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
  CHECK_THROWS_WITH_AS(check_image_names({"-"}), doctest::Contains("expected --format as well"), UsageError);
  CHECK_THROWS_WITH_AS(check_image_names({"a.png"}, {"png"}), doctest::Contains("expected -o - as well"), UsageError);
  CHECK_THROWS_WITH_AS(check_image_names({"-", "-"}, {"png"}), doctest::Contains("- twice"), UsageError);
  CHECK_THROWS_WITH_AS(check_image_names({"-"}, {"png"}, "-"), doctest::Contains("only one can go to standard output"),
                       UsageError);
}

TEST_CASE("whether a file can be written is known beforehand, and asking leaves nothing") {
  const auto folder = scratch_folder("outputs_test");
  CHECK_NOTHROW(check_can_write(folder / "a.png"));
  CHECK(fs::is_empty(folder));
  CHECK_THROWS_AS(check_can_write(folder / "none" / "a.png"), IoError);
  fs::create_directory(folder / "b.png");
  CHECK_THROWS_AS(check_can_write(folder / "b.png"), ImageFileError);
  write_text(folder / "c.png", "old");
  CHECK_NOTHROW(check_can_write(folder / "c.png"));
  CHECK(fs::file_size(folder / "c.png") == 3);
}

TEST_CASE("outputs over inputs are refused, under whatever name; so are two outputs that are one file") {
  const auto folder = scratch_folder("outputs_over_inputs");
  const auto scene = folder / "scene.json";
  write_text(scene, "scene");
  write_text(folder / "other.json", "other");
  fs::create_directory(folder / "sub");
  fs::create_symlink("scene.json", folder / "link.json");
  fs::create_hard_link(scene, folder / "hard.json");
  const std::vector<fs::path> inputs = {folder / "none.png", scene};
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
  const auto folder = scratch_folder("outputs_test");
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
  const auto folder = scratch_folder("outputs_rescue");
  const auto file = folder / "a.png", temporary = folder / "tmp";
  int calls = 0;
  // What is told where the places `are_refused`.
  const auto problem = [&](const fs::path& to, const std::function<bool(const fs::path&)>& are_refused) -> std::string {
    try {
      write_or_rescue(to, [&](const fs::path& at) {
        ++calls;
        if (are_refused(at)) throw ImageFileError(at.string() + ": cannot write: busy");
        write_text_file(at, "picture");
      });
    } catch (const ImageFileError& error) {
      return error.what();
    }
    return "none";
  };
  const auto itself = [&](const fs::path& at) { return at == file; };
  const auto beside = [&](const fs::path& at) { return at.parent_path() == folder; };
  const auto always = [](const fs::path&) { return true; };
  const std::string busy = file.string() + ": cannot write: busy";
  CHECK(problem(folder / "b.png", itself) == "none");
  CHECK(problem(file, itself) == busy + "; it is in " + (folder / "a.new.png").string() + " instead");
  CHECK(problem(file, itself) == busy + "; it is in " + (folder / "a.new-2.png").string() + " instead");
  CHECK(fs::file_size(folder / "a.new-2.png") == 7);
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "/tmp";
  setenv("TMPDIR", temporary.c_str(), 1);
  CHECK(problem(file, beside) == busy);  // there is no such folder
  fs::create_directory(temporary);
  CHECK(problem(file, always) == busy);
  CHECK(fs::is_empty(temporary));
  const std::string far = problem(file, beside);
  CHECK(far.starts_with(busy + "; it is in " + (temporary / "tyndall-").string()));
  CHECK(far.ends_with("/a.png instead"));
  setenv("TMPDIR", kept.c_str(), 1);
  calls = 0;
  CHECK(problem("-", always) == "-: cannot write: busy");  // what goes through a pipe was for a reader who has left
  CHECK(calls == 1);
}

}  // namespace tyndall::test::outputs_test
