#include "app/window/document/numbered_files.h"

#include "app/window/document/document.h"
#include "core/image/image_io.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

namespace tyndall::test::snapshot_test {
namespace fs = std::filesystem;

TEST_CASE("a snapshot opens again as the scene that made it") {
  const fs::path folder = scratch_folder("snapshot");
  Document document = document_of(load_scene("simple-light"));
  document.scene.width = 16;
  document.scene.height = 8;
  document.scene.camera.vfov = 33;
  Film film = make_film(16, 8, {0, 0, 16, 8}, 0, 4);
  for (FilmPixel& pixel : film.pixels) {
    add_sample(pixel, 0, {1, 1, 1}, 0.25);
    pixel.taken = 1;
  }
  const std::string text = write_snapshot({document, folder / "light-001", "scalar", 1}, film);
  CHECK(text.find("light-001.png") != std::string::npos);
  for (const char* name : {"light-001.png", "light-001.exr"}) {
    if (std::string(name).ends_with("exr") && !has_openexr()) continue;
    const LoadedScene again = load_scene((folder / name).string());
    CHECK(again.scene.camera == document.scene.camera);
    CHECK(again.scene.objects == document.scene.objects);
    CHECK(again.source.empty());
  }
}

TEST_CASE("a film is waited for, but not when the picture changed or the window closes") {
  int requested = 0;
  const auto yes = [] { return true; };
  const auto no = [] { return false; };
  const auto late = [&] {
    Film film = make_film(2, 2, {0, 0, 2, 2}, 0, 1);
    for (FilmPixel& pixel : film.pixels) pixel.taken = ++requested > 8 ? 1 : 0;
    return film;
  };
  CHECK(wait_for_film(late, yes, yes).pixels.size() == 4);
  CHECK(wait_for_film(late, no, yes).pixels.empty());
  requested = 0;
  CHECK(wait_for_film(late, yes, no).pixels.empty());
}

}  // namespace tyndall::test::snapshot_test
