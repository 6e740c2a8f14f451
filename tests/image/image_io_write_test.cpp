#include "core/film/film.h"
#include "core/image/image_io.h"
#include "tests/support/capture.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <functional>

namespace tyndall::test::image_io_write_test {
namespace fs = std::filesystem;

namespace {

LinearImage noise(int width, int height) {
  LinearImage image{width, height, {}};
  std::uint32_t state = 1;
  for (int i = 0; i < 3 * width * height; ++i) {
    state = state * 1664525u + 1013904223u;
    image.rgb.push_back(static_cast<float>(state >> 8) / 16777216.0f);
  }
  return image;
}

/// An image in each format that this build writes.
std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> writers(int width, int height) {
  const LinearImage image = noise(width, height);
  std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> list = {
      {"a.png",
       [=](const fs::path& file) {
         write_png(file, image, 0, ToneMap::srgb, {"{}", ""});
       }},
      {"a.pfm", [=](const fs::path& file) { write_pfm(file, image); }},
      {"a.hdr", [=](const fs::path& file) { write_hdr(file, image); }}};
  if (has_openexr()) {
    Film film = make_film(width, height, {0, 0, width, height}, 0, 1);
    for (std::size_t i = 0; i < film.pixels.size(); ++i) film.pixels[i].sum[0][0].add(image.rgb[i]);
    for (FilmPixel& pixel : film.pixels) pixel.taken = 1;
    list.emplace_back("a.exr", [=](const fs::path& file) { write_exr(file, film, {}, {"{}", ""}); });
  }
  return list;
}

std::string error_of(const std::function<void(const fs::path&)>& write, const fs::path& file) {
  try {
    write(file);
  } catch (const ImageFileError& error) {
    const std::string text = error.what();
    REQUIRE(text.starts_with(file.string()));
    return text.substr(file.string().size());
  }
  return "none";
}

/// While it lives, no file can grow beyond `bytes`: as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace

TEST_CASE("writing: a missing folder is one clear error") {
  const fs::path folder = scratch_folder("write_missing");
  for (const auto& [name, write] : writers(4, 4)) {
    CHECK(error_of(write, folder / "none" / name) == ": cannot write: No such file or directory");
  }
}

TEST_CASE("writing: only whole files appear, and nothing else") {
  const fs::path folder = scratch_folder("write_whole");
  for (const auto& [name, write] : writers(4, 4)) {
    write(folder / name);
    write(folder / name);  // replaces it
    CHECK(fs::file_size(folder / name) > 0);
    CHECK_NOTHROW(read_image(folder / name));
  }
  CHECK(count_files(folder) == writers(4, 4).size());
}

TEST_CASE("writing: a full disk leaves the old file and no scraps") {
  const fs::path folder = scratch_folder("write_full");
  // Some of these fail only when the file is closed, the others before.
  const std::pair<rlim_t, int> cases[] = {{0, 4}, {0, 100}, {100, 100}, {6000, 100}};
  for (const auto& [room, size] : cases) {
    for (const auto& [name, write] : writers(size, size)) {
      CAPTURE_BOUND(name);
      CAPTURE_BOUND(room);
      write_text(folder / name, "old");
      std::string message;
      {
        const FullDisk full(room);
        message = error_of(write, folder / name);
      }
      CHECK(message == ": cannot write: File too large");
      CHECK(read_text(folder / name) == "old");
    }
  }
  CHECK(count_files(folder) == writers(4, 4).size());
}

/// What a writer puts into a named pipe, which has room for all of it.
std::string from_pipe(const fs::path& pipe, const std::function<void(const fs::path&)>& write) {
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  write(pipe);
  std::string bytes(65536, '\0');
  const ssize_t got = read(reader, bytes.data(), bytes.size());
  close(reader);
  return bytes.substr(0, got > 0 ? static_cast<std::size_t>(got) : 0);
}

TEST_CASE("writing: folders, pipes and links") {
  const fs::path folder = scratch_folder("write_kinds");
  fs::create_directory(folder / "dir.png");
  fs::create_directory(folder / "real");
  fs::create_symlink("real/target", folder / "link");
  fs::create_symlink("pipe", folder / "to_pipe");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const auto& [name, write] : writers(4, 4)) {
    CHECK(error_of(write, folder / "dir.png") == ": cannot write: Is a directory");
    CHECK_NOTHROW(write("/dev/null"));
    write(folder / "link");
    const std::string whole = read_text(folder / "real" / "target");
    CHECK(from_pipe(folder / "pipe", write) == whole);
    CHECK(from_pipe(folder / "to_pipe", write) == whole);
    CHECK(fs::is_symlink(folder / "link"));
    CHECK_NOTHROW(read_image(folder / "real" / "target"));
  }
  CHECK(fs::is_fifo(folder / "pipe"));
  CHECK(count_files(folder) == 5);
  CHECK(count_files(folder / "real") == 1);
}

TEST_CASE("writing: an image without pixels is refused") {
  const fs::path folder = scratch_folder("write_empty");
  const std::string expected = ": cannot write: found an image of 0 x 0 pixels, expected 1 to 2^28 in all";
  CHECK(error_of([](const fs::path& file) { write_png(file, {}, 0, ToneMap::srgb, {}); }, folder / "a") == expected);
  CHECK(error_of([](const fs::path& file) { write_pfm(file, {}); }, folder / "a") == expected);
  CHECK(error_of([](const fs::path& file) { write_hdr(file, {}); }, folder / "a") == expected);
  if (has_openexr()) {
    CHECK(error_of([](const fs::path& file) { write_exr(file, {}, {}, {}); }, folder / "a") == expected);
  }
  CHECK(count_files(folder) == 0);
}

namespace {

/// A film in the middle of a round of adaptive sampling; its size is no multiple of a cell's edge.
Film adaptive_film() {
  Film film = make_film(40, 30, {3, 2, 14, 11}, 0, 2);
  film.planned.resize(planned_cells(film.region));
  std::uint32_t count = 16;
  for (PlannedSamples& planned : film.planned) planned = {count, 2 * count + 2}, ++count;
  for (int y = 2; y < 11; ++y)
    for (int x = 3; x < 14; ++x) {
      const std::size_t cell = static_cast<std::size_t>((y - 2) / 4 * 3 + (x - 3) / 4);
      film.at(x, y).taken = film.planned[cell].from + static_cast<std::uint32_t>(x % 3);
    }
  return film;
}

const FilmLabel film_label = {"1.2.3", "scalar", true, "0123456789abcdef"};

}  // namespace

TEST_CASE("film label: version, instruction set and whether it is unfinished come back, of images and checkpoints" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("film_label");
  const Film film = adaptive_film();
  write_exr(folder / "whole.exr", film, {}, {"{}", "{\"spp\": 1}", film_label});
  write_checkpoint(folder / "checkpoint.exr", film, {"{}", "", film_label});
  for (const char* name : {"whole.exr", "checkpoint.exr"}) {
    CAPTURE(name);
    CHECK(read_film_label(folder / name) == film_label);
    CHECK(read_film(folder / name) == film);
    CHECK(read_embedded_scene(folder / name) == "{}");
    CHECK(read_embedded_contents(folder / name) == "0123456789abcdef");
  }
  CHECK(read_embedded_stats(folder / "whole.exr") == "{\"spp\": 1}");
  CHECK_FALSE(read_embedded_stats(folder / "checkpoint.exr"));
  CHECK_NOTHROW(read_image(folder / "whole.exr"));
  write_text(folder / "text.exr", "text");
  CHECK_FALSE(read_film_label(folder / "text.exr"));
}

TEST_CASE("film label: a film from before there were labels is read; one of a newer format is refused" *
          doctest::skip(!has_openexr())) {
  const fs::path folder = scratch_folder("film_formats"), old = tests_folder() / "image/film_of_format_0.exr";
  CHECK(read_film_label(old) == FilmLabel{});
  const auto film = read_film(old);
  REQUIRE(film);
  CHECK(totals(*film).samples == 2 * 8 * 6);
  write_exr(folder / "new.exr", *film, {}, {"{}", "", film_label});
  std::string bytes = read_text(folder / "new.exr");
  const std::string name = std::string("tyndall:film_format") + '\0' + "int" + '\0';
  const std::size_t at = bytes.find(name);
  REQUIRE(at != bytes.npos);
  bytes[at + name.size() + 4] = 9;
  write_text(folder / "new.exr", bytes);
  const std::string expected = (folder / "new.exr").string() +
                               ": cannot read: found a film in format 9, expected at most 1: "
                               "a newer version of Tyndall wrote it";
  CHECK_THROWS_WITH_AS(read_film(folder / "new.exr"), expected.c_str(), ImageFileError);
  CHECK_THROWS_WITH_AS(read_film_label(folder / "new.exr"), expected.c_str(), ImageFileError);
}

TEST_CASE("film label: rounds of adaptive sampling that contradict the counts are refused" *
          doctest::skip(!has_openexr())) {
  const fs::path file = scratch_folder("film_planned") / "a.exr";
  const auto refused = [&file](const Film& film) {
    write_checkpoint(file, film, {});
    CHECK_THROWS_AS(read_film(file), ImageFileError);
  };
  Film film = adaptive_film();
  film.planned.pop_back();
  refused(film);
  film = adaptive_film();
  film.planned[4].from = 1000;
  refused(film);
  film = adaptive_film();
  film.planned[0].to = film.planned[0].from;
  refused(film);
  film = adaptive_film();
  for (PlannedSamples& planned : film.planned) planned.to = 1u << 25u;
  refused(film);
}

}  // namespace tyndall::test::image_io_write_test
