#include "app/window/accuracy/comparison.h"

#include "app/text/values.h"
#include "app/window/document/document.h"
#include "core/accuracy/error.h"
#include "core/files/film_files.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace tyndall::test::reference_test {
namespace fs = std::filesystem;

namespace {

fs::path scratch(const std::string& name) {
  const fs::path folder = scratch_folder() / ("reference_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

Document small_document(const std::string& name) {
  Document document = document_of(load_scene(name));
  document.scene.width = 8, document.scene.height = 6;
  return document;
}

LinearImage grey_image(int width, int height) {
  return {width, height, std::vector<float>(3 * static_cast<std::size_t>(width * height), 0.5f)};
}

/// A film whose halves differ by 0.2 around 1.
Film two_halves(const Scene& scene) {
  Film film = make_film(scene.width, scene.height, {0, 0, scene.width, scene.height}, 0, 4);
  for (FilmPixel& pixel : film.pixels) {
    add_sample(pixel, 0, {1.1f, 1.1f, 1.1f}, 0.25);
    add_sample(pixel, 1, {0.9f, 0.9f, 0.9f}, 0.25);
    pixel.taken = 2;
  }
  return film;
}

}  // namespace

TEST_CASE("a reference of another size is refused, with both sizes") {
  const fs::path file = scratch("size") / "large.pfm";
  write_pfm(file, grey_image(9, 6));
  try {
    read_reference(file, small_document("cover"));
    FAIL("it was taken");
  } catch (const UsageError& error) {
    CHECK(error.what() == file.string() + ": found 9x6 pixels, expected 8x6 as the picture has");
  }
  CHECK_THROWS_AS(read_reference(file.string() + "no", small_document("cover")), ImageFileError);
}

TEST_CASE("a reference with a value that is not finite is refused, with its place") {
  const fs::path file = scratch("not_finite") / "inf.pfm";
  LinearImage image = grey_image(8, 6);
  image.rgb[3 * (2 * 8 + 5) + 1] = std::numeric_limits<float>::infinity();
  write_pfm(file, image);
  try {
    read_reference(file, small_document("cover"));
    FAIL("it was taken");
  } catch (const UsageError& error) {
    CHECK(error.what() ==
          file.string() +
              ": found that 1 of 48 pixels is not finite, the first at 5,2 (green is inf), expected finite values");
  }
}

TEST_CASE("a plain image belongs to the scene that it was loaded for, whatever the method") {
  const fs::path file = scratch("plain") / "a.pfm";
  write_pfm(file, grey_image(8, 6));
  const Document document = small_document("cover");
  const Reference reference = read_reference(file, document);
  CHECK(reference.about == "a.pfm");
  CHECK(reference.rel_mse == 0);
  Scene scene = document.scene;
  CHECK(fit_of(reference, scene) == ReferenceFit::fits);
  scene.render.integrator = Integrator::path;
  scene.render.fresnel = FresnelKind::schlick;
  scene.render.max_depth = 3;
  scene.display.exposure = 2;
  CHECK(fit_of(reference, scene) == ReferenceFit::fits);
  scene.camera.vfov += 1;
  CHECK(fit_of(reference, scene) == ReferenceFit::other_scene);
  scene.width = 16;
  CHECK(fit_of(reference, scene) == ReferenceFit::other_size);
}

TEST_CASE("an image of Tyndall belongs to its own scene, textures and all; the same random numbers are told") {
  const fs::path folder = scratch("own");
  for (const char* name : {"earth", "hollow-glass"}) {
    const Document document = small_document(name);
    const fs::path file = folder / (std::string(name) + ".png");
    const Film film = two_halves(document.scene);
    write_png(file, {8, 6, resolve(film)}, 0, ToneMap::srgb,
              {embedded_scene(document.scene, document.origin->folder, film, file), ""});
    CHECK_FALSE(shows_no_scene(file));
    const Reference reference = read_reference(file, document);
    CHECK(reference.about == std::string(name) + ".png (8 bit)");
    Scene scene = document.scene;
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.camera.focus_distance = 3;  // without a lens that changes nothing
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.render.fresnel = FresnelKind::schlick;
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.render.seed = 5;
    CHECK(fit_of(reference, scene) == ReferenceFit::fits);
    CHECK(fit_of(read_reference(file, small_document("cover")), small_document("cover").scene) ==
          ReferenceFit::other_scene);
  }
}

TEST_CASE("a picture of a texture that has changed since is a reference of another scene") {
  const fs::path file = scratch("stale") / "a.png";
  const Document document = small_document("earth");
  const Film film = two_halves(document.scene);
  for (const std::string& contents : {contents_hash(document.scene), std::string(16, '0')}) {
    write_png(file, {8, 6, resolve(film)}, 0, ToneMap::srgb,
              {embedded_scene(document.scene, document.origin->folder, film, file), "", {"", "", false, contents}});
    const bool same = contents == contents_hash(document.scene);
    CHECK((fit_of(read_reference(file, document), document.scene) == ReferenceFit::other_scene) != same);
  }
}

TEST_CASE("which dropped images hold no scene") {
  const fs::path folder = scratch("dropped");
  write_pfm(folder / "a.pfm", grey_image(2, 2));
  write_png(folder / "a.png", grey_image(2, 2), 0, ToneMap::srgb, {});
  std::ofstream(folder / "a.json") << "{}";
  CHECK(shows_no_scene(folder / "a.pfm"));
  CHECK(shows_no_scene(folder / "a.png"));
  CHECK_FALSE(shows_no_scene(folder / "a.json"));
  CHECK_FALSE(shows_no_scene(folder / "no such file"));
  CHECK_FALSE(shows_no_scene(folder));
}

TEST_CASE("a film's own noise is known") {
  if (!has_openexr()) return;
  const fs::path file = scratch("film") / "a.exr";
  const Document document = small_document("cover");
  write_exr(file, two_halves(document.scene), {}, {});
  CHECK(read_reference(file, document).rel_mse == doctest::Approx(0.01 / 1.01).epsilon(1e-3).scale(0));
}

TEST_CASE("a layer of an EXR is a reference without a film's noise, and no scene when it is dropped") {
  if (!has_openexr()) return;
  const fs::path file = scratch("layer") / "a.exr";
  const Document document = small_document("cover");
  const Film film = two_halves(document.scene);
  write_exr(file, film, {{"Albedo", {"R", "G", "B"}, std::vector<float>(3 * film.pixels.size(), 0.25f)}}, {"{}", ""});
  CHECK_FALSE(shows_no_scene(file));
  CHECK(shows_no_scene(file.string() + ":Albedo"));
  const Reference reference = read_reference(file.string() + ":Albedo", document);
  CHECK(reference.image.rgb[0] == 0.25f);
  CHECK(reference.rel_mse == 0);
  CHECK(reference.about == "a.exr:Albedo");
  CHECK_THROWS_AS(read_reference(file.string() + ":albedo", document), NoSuchLayer);
}

TEST_CASE("a part of a picture is no reference") {
  if (!has_openexr()) return;
  const fs::path file = scratch("part") / "a.exr";
  const Document document = small_document("cover");
  write_exr(file, make_film(document.scene.width, document.scene.height, {1, 1, 5, 4}, 0, 1), {}, {});
  CHECK_THROWS_WITH_AS(read_reference(file, document),
                       (file.string() + ": found the pixels of its data window 1,1,5,4 alone, expected all of its "
                                        "display window 0,0,8,6")
                           .c_str(),
                       UsageError);
}

TEST_CASE("a reference is rendered with other random numbers, and can be stopped") {
  Document document = small_document("simple-light");
  ReferenceOrder order{document.scene, 8, 1, ""};
  const auto reference = rendered_reference(order, [](std::uint32_t) { return true; });
  REQUIRE(reference);
  CHECK(fit_of(*reference, document.scene) == ReferenceFit::fits);
  CHECK(reference->scene.render.seed == 1);
  CHECK(reference->rel_mse > 0);
  CHECK(reference->about == "this scene at 8 spp, seed 1");
  order.scene = reference->scene;
  const auto other = rendered_reference(order, [](std::uint32_t) { return true; });
  REQUIRE(other);
  CHECK(other->scene.render.seed == 0);
  CHECK(other->image.rgb != reference->image.rgb);
  CHECK_FALSE(rendered_reference(order, [](std::uint32_t) { return false; }));
}

}  // namespace tyndall::test::reference_test
