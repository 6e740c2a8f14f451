#include "app/window/accuracy/comparison.h"
#include "app/window/document/document.h"
#include "core/accuracy/error.h"
#include "core/files/film_files.h"
#include "tests/app/window/scenes.h"
#include "tests/support/scratch.h"

#include <cmath>
#include <numeric>

namespace tyndall::test::comparison_test {
namespace fs = std::filesystem;

namespace {

constexpr int columns = 24, rows = 16;

std::shared_ptr<Frame> frame_of(float add, std::uint32_t spp = 4) {
  auto frame = std::make_shared<Frame>();
  frame->width = columns, frame->height = rows, frame->spp = spp;
  for (int i = 0; i < columns * rows; ++i) {
    const float value = 0.03f * static_cast<float>(i % 17) + add;
    frame->rgba.insert(frame->rgba.end(), {value, 0.5f * value, 0.25f, 1.0f});
  }
  return frame;
}
std::shared_ptr<Reference> reference_for(const Frame& frame, double noise = 0) {
  return std::make_shared<Reference>(Reference{{columns, rows, picture_of(frame)}, noise, "made up", {}, false});
}

Document small_document(const std::string& name) {
  Document document = document_of(load_scene(name));
  document.scene.width = 8, document.scene.height = 6;
  return document;
}
LinearImage grey_image() { return {8, 6, std::vector<float>(3 * 8 * 6, 0.5f)}; }

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
/// A picture that Tyndall has made of the document's scene; contents: of its textures.
void write_own_picture(const fs::path& file, const Document& document, const std::string& contents = "") {
  const Film film = two_halves(document.scene);
  write_png(file, {8, 6, resolve(film)}, 0, ToneMap::srgb,
            {embedded_scene(document.scene, document.origin->folder, film, file), "", {"", "", false, contents}});
}

}  // namespace

TEST_CASE("errors against a reference are those of the command compare, less the reference's noise") {
  const auto frame = frame_of(0.1f);
  const auto reference = reference_for(*frame_of(0), 1e-3);
  const std::vector<float> image = picture_of(*frame);
  const ComparisonResult quick = compare({frame, nullptr, reference});
  CHECK(quick.rel_mse == doctest::Approx(image_error(image, reference->image.rgb).rel_mse - 1e-3));
  CHECK(compare({frame, nullptr, reference, ErrorView::none, false, false, false}).rel_mse ==
        doctest::Approx(quick.rel_mse + 1e-3));
  CHECK_FALSE(quick.flip);
  CHECK(quick.map.empty());
  const ComparisonResult whole = compare({frame, nullptr, reference, ErrorView::none, true});
  const std::vector<float> flip = flip_map(image, reference->image.rgb, columns, rows);
  REQUIRE(whole.flip);
  CHECK(*whole.flip == doctest::Approx(std::accumulate(flip.begin(), flip.end(), 0.0) / (columns * rows)));
  CHECK(whole.cpu_seconds > 0);
}

TEST_CASE("the error map is grey, 1 is 100 % and more; that of FLIP is brighter where it is worse") {
  const auto frame = frame_of(0);
  const auto reference = reference_for(*frame);
  CHECK(compare({frame, nullptr, reference, ErrorView::error}).map[0] == 0);
  for (float& value : frame->rgba) value += 100;
  const std::vector<float> map = compare({frame, nullptr, reference, ErrorView::error}).map;
  CHECK(map == std::vector<float>(frame->rgba.size(), 1));
  const std::vector<float> flip = compare({frame, nullptr, reference, ErrorView::flip}).map;
  REQUIRE(flip.size() == frame->rgba.size());
  CHECK(flip[0] > 0.5f);
  CHECK(flip[3] == 1);
}

TEST_CASE("pictures are compared only if both are whole and of one size") {
  const auto frame = frame_of(0), coarse = frame_of(0, 0), small = frame_of(0), view = frame_of(0);
  const auto reference = reference_for(*frame);
  small->width = columns / 2;
  view->view = View::noise;
  CHECK(can_compare({frame, nullptr, reference}));
  CHECK(can_compare({frame, frame, nullptr}));
  for (const auto& one : {coarse, small, view}) {
    CHECK_FALSE(can_compare({one, nullptr, reference}));
    CHECK_FALSE(can_compare({frame, one, nullptr}));
  }
  CHECK_FALSE(can_compare({frame, nullptr, nullptr}));
  CHECK_FALSE(can_compare({nullptr, nullptr, reference}));
  view->beauty = frame->rgba;
  CHECK(can_compare({view, nullptr, reference}));
  CHECK(compare({view, nullptr, reference}).rel_mse == 0);
}

TEST_CASE("work keeps to its share of the processors") {
  ProcessorBudget fraction{0.02};
  CHECK(fraction.due(0));
  double used = 0;
  for (double now = 0; now < 100; now += 0.01)
    if (fraction.due(now)) fraction.spent(now, 0.05, 4), used += 0.05;
  CHECK(used / (100 * 4) == about(0.02, 0.05));
  fraction.renew();
  CHECK(fraction.due(0));
}

TEST_CASE("a plain image belongs to the scene that it was loaded for, whatever the method, if all of it is finite") {
  const fs::path file = scratch_folder("reference_plain") / "a.pfm";
  LinearImage image = grey_image();
  write_pfm(file, image);
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
  CHECK_THROWS_AS(read_reference(file.string() + "no", document), ImageFileError);
  image.rgb[3 * (2 * 8 + 5) + 1] = std::numeric_limits<float>::infinity();
  write_pfm(file, image);
  const std::string problem = ": found that 1 of 48 pixels is not finite, the first at 5,2 (green is inf), expected ";
  CHECK_THROWS_WITH_AS(read_reference(file, document), (file.string() + problem + "finite values").c_str(), UsageError);
}

TEST_CASE("an image of Tyndall belongs to its own scene, textures and all; the same random numbers are told") {
  const fs::path folder = scratch_folder("reference_own");
  for (const std::string name : {"earth", "hollow-glass"}) {
    const Document document = small_document(name);
    const fs::path file = folder / (name + ".png");
    write_own_picture(file, document);
    CHECK_FALSE(shows_no_scene(file));
    const Reference reference = read_reference(file, document);
    CHECK(reference.about == name + ".png (8 bit)");
    Scene scene = document.scene;
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.camera.focus_distance = 3;  // without a lens that changes nothing
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.render.fresnel = FresnelKind::schlick;
    CHECK(fit_of(reference, scene) == ReferenceFit::same_samples);
    scene.render.seed = 5;
    CHECK(fit_of(reference, scene) == ReferenceFit::fits);
    const Document cover = small_document("cover");
    CHECK(fit_of(read_reference(file, cover), cover.scene) == ReferenceFit::other_scene);
  }
  const Document document = small_document("earth");
  for (const std::string& contents : {contents_hash(document.scene), std::string(16, '0')}) {
    write_own_picture(folder / "stale.png", document, contents);  // where the texture has changed since
    const bool same = contents == contents_hash(document.scene);
    const ReferenceFit fit = fit_of(read_reference(folder / "stale.png", document), document.scene);
    CHECK((fit == ReferenceFit::other_scene) != same);
  }
}

TEST_CASE("which dropped images hold no scene") {
  const fs::path folder = scratch_folder("reference_dropped");
  write_pfm(folder / "a.pfm", grey_image());
  write_png(folder / "a.png", grey_image(), 0, ToneMap::srgb, {});
  write_text(folder / "a.json", "{}");
  for (const char* file : {"a.pfm", "a.png"}) CHECK(shows_no_scene(folder / file));
  for (const char* file : {"a.json", "no such file", ""}) CHECK_FALSE(shows_no_scene(folder / file));
}

TEST_CASE("of films the noise is known, but not of a layer of an EXR; a part of a picture is no reference") {
  if (!has_openexr()) return;
  const fs::path file = scratch_folder("reference_film") / "a.exr";
  const Document document = small_document("cover");
  const Film film = two_halves(document.scene);
  write_exr(file, film, {{"Albedo", {"R", "G", "B"}, std::vector<float>(3 * film.pixels.size(), 0.25f)}}, {"{}", ""});
  CHECK(read_reference(file, document).rel_mse == about(0.01 / 1.01, 1e-3));
  CHECK_FALSE(shows_no_scene(file));
  CHECK(shows_no_scene(file.string() + ":Albedo"));
  const Reference reference = read_reference(file.string() + ":Albedo", document);
  CHECK(reference.image.rgb[0] == 0.25f);
  CHECK(reference.rel_mse == 0);
  CHECK(reference.about == "a.exr:Albedo");
  CHECK_THROWS_AS(read_reference(file.string() + ":albedo", document), NoSuchLayer);
  write_exr(file, make_film(document.scene.width, document.scene.height, {1, 1, 5, 4}, 0, 1), {}, {});
  const std::string problem =
      ": found the pixels of its data window 1,1,5,4 alone, expected all of its display window ";
  CHECK_THROWS_WITH_AS(read_reference(file, document), (file.string() + problem + "0,0,8,6").c_str(), UsageError);
}

TEST_CASE("a reference is rendered with other random numbers, and can be stopped") {
  const Document document = small_document("simple-light");
  ReferenceOrder order{document.scene, 8, 1, ""};
  const auto reference = rendered_reference(order, [](std::uint32_t) { return true; });
  REQUIRE(reference);
  CHECK(fit_of(*reference, document.scene) == ReferenceFit::fits);
  CHECK(reference->scene.render.seed == 1);
  CHECK(reference->rel_mse > 0);
  order.scene = reference->scene;
  const auto other = rendered_reference(order, [](std::uint32_t) { return true; });
  REQUIRE(other);
  CHECK(other->scene.render.seed == 0);
  CHECK(other->image.rgb != reference->image.rgb);
  CHECK_FALSE(rendered_reference(order, [](std::uint32_t) { return false; }));
}

}  // namespace tyndall::test::comparison_test
