#include "core/files/film_files.h"
#include "core/image/image_io.h"
#include "core/scene/load.h"
#include "tests/scene/files.h"
#include "tests/support/pictures.h"
#include "tests/support/scratch.h"
#include "tests/support/skies.h"

#include <doctest/doctest.h>

#include <limits>

/// A picture of the sky in scene files: read, written, moved, and refused in one line where it is no sky.
namespace tyndall::test::scene_sky_test {
namespace fs = std::filesystem;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

std::string scene_with(const std::string& sky) { return R"({ "tyndall": 1, "background": )" + sky + " }"; }

Scene read(const std::string& sky, const fs::path& folder) { return read_scene(scene_with(sky), "scene.json", folder); }

std::string complaint(const std::string& sky, const fs::path& folder) {
  return tyndall::complaint(scene_with(sky), {}, folder);
}

std::string complaint_about_pixels(const std::vector<float>& rgb, const fs::path& folder) {
  write_pfm(folder / "bad.pfm", {static_cast<int>(rgb.size() / 3), 1, rgb});
  return complaint(R"({ "type": "image", "file": "bad.pfm" })", folder);
}

const SkyPicture& sky_in(const Scene& scene) { return std::get<SkyPicture>(scene.background); }

}  // namespace

TEST_CASE("sky: read with its defaults and with all values, and written as it was read") {
  const fs::path folder = scratch_folder("scene_sky");
  const LinearImage picture{2, 1, {0, 1, 2, 1e6f, 4, 5}};
  write_pfm(folder / "sky.pfm", picture), write_hdr(folder / "sky.hdr", picture);
  const Scene scene = read(R"({ "type": "image", "file": "sky.pfm" })", folder);
  CHECK(sky_in(scene).file == "sky.pfm");
  CHECK(sky_in(scene).rotate_y == 0);
  CHECK(sky_in(scene).scale == 1);
  CHECK(sky_in(scene).pixels->rgb == picture.rgb);
  CHECK(sky_in(scene).pixels->largest == 1e6f);
  const Scene turned = read(R"({ "type": "image", "file": "sky.hdr", "rotate_y": -30, "scale": 0.5 })", folder);
  CHECK(sky_in(turned).rotate_y == -30);
  CHECK(sky_in(turned).scale == 0.5);
  CHECK(read_scene(write_scene(turned), "again.json", folder) == turned);
  CHECK(read_scene(write_scene(scene), "again.json", folder) == scene);
}

TEST_CASE("sky: another folder finds the same file; the same pixels are the same samples, others are not") {
  const fs::path folder = scratch_folder("scene_sky_moved");
  Scene scene;
  scene.background = random_sky(4, 2, 1);
  const Scene moved = move_textures(scene, folder / "a", folder / "b");
  CHECK(sky_in(moved).file == "../a/sky.hdr");
  CHECK(same_samples(scene, moved));
  Scene other = scene;
  std::get<SkyPicture>(other.background).pixels = random_sky(4, 2, 2).pixels;
  CHECK(!same_samples(scene, other));
  other = scene;
  std::get<SkyPicture>(other.background).rotate_y = 1;
  CHECK(!same_samples(scene, other));
  write_pfm(folder / "sky.pfm", {1, 1, {1, 1, 1}});
  CHECK(sky_of_file(folder / "sky.pfm", folder).file == "sky.pfm");
  CHECK(sky_of_file(folder / "sky.pfm", folder / "elsewhere").file == fs::weakly_canonical(folder / "sky.pfm"));
  write_text(folder / "scene.json", scene_with(R"({ "type": "image", "file": "gone.hdr" })"));
  CHECK(files_of_scene(folder / "scene.json") == std::vector{folder / "scene.json", folder / "gone.hdr"});
}

TEST_CASE("sky: what is no sky is refused in one line that names the place") {
  const fs::path folder = scratch_folder("scene_sky_refused");
  const std::string start = "/background/file: found ";
  CHECK(complaint(R"({ "type": "image" })", folder).starts_with("/background: found no \"file\", expected"));
  CHECK(complaint(R"({ "type": "image", "file": "no.hdr" })", folder).starts_with(start + "no file \"no.hdr\""));
  CHECK(complaint(R"({ "type": "image", "file": "" })", folder).starts_with(start + "\"\", expected"));
  const std::string expected = ", expected radiance of the whole sky, finite and >= 0";
  CHECK(complaint_about_pixels({1, 1, 1, 1, -0.5f, 1}, folder) ==
        start + "-0.5 in pixel (1, 0) of \"bad.pfm\"" + expected);
  CHECK(complaint_about_pixels({1, 1, infinity}, folder).ends_with("in pixel (0, 0) of \"bad.pfm\"" + expected));
  CHECK(complaint_about_pixels({1, std::nanf(""), 1}, folder).ends_with("in pixel (0, 0) of \"bad.pfm\"" + expected));
  CHECK(complaint_about_pixels({0, 0, 0}, folder).empty());
  write_png(folder / "sky.png", {1, 1, {1, 1, 1}}, 0, ToneMap::srgb, {});
  CHECK(complaint(R"({ "type": "image", "file": "sky.png" })", folder) ==
        start +
            "a file that cannot be read (sky.png: cannot read: found 8 or 16 bits a number, expected radiance in "
            "floating point (HDR, EXR, PFM)), expected a picture of the sky in floating point (HDR, EXR or PFM)");
  write_pfm(folder / "one.pfm", {1, 1, {1e38f, 1, 1}});
  CHECK(complaint(R"({ "type": "image", "file": "one.pfm", "scale": 10 })", folder)
            .starts_with("/background/scale: found 10, expected"));
  CHECK(complaint(R"({ "type": "image", "file": "one.pfm", "scale": -1 })", folder)
            .starts_with("/background/scale: found -1, expected a number >= 0"));
  CHECK(
      complaint(R"({ "type": "image", "file": "one.pfm", "turn": 1 })", folder).starts_with("/background/turn: found"));
}

}  // namespace tyndall::test::scene_sky_test
