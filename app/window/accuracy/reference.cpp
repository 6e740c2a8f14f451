#include "app/window/accuracy/reference.h"

#include "app/comparison/comparison.h"
#include "app/comparison/pair.h"
#include "app/text/numbers.h"
#include "app/text/values.h"
#include "core/accuracy/estimate.h"
#include "core/image/image_io_file.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/scene/scene.h"

#include <cmath>
#include <exception>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

/// The scene inside an image that Tyndall made, with the paths of its textures as the document would write them;
/// nothing where there is none.
std::optional<Scene> scene_in(const fs::path& file, const Document& document) {
  try {
    if (!read_embedded_scene(file)) return {};
    const LoadedScene loaded = load_scene(fs::absolute(file).string());
    Scene scene = move_textures(loaded.scene, loaded.folder, document.origin->folder);
    // Pixels that are not those of the picture any more are left out, and so differ from all.
    if (loaded.contents && !loaded.contents->empty() && *loaded.contents != contents_hash(scene))
      each_picture(scene, [](auto& picture) { picture.pixels.reset(); });
    return scene;
  } catch (const std::exception&) {
    return {};  // the picture is of use without
  }
}

/// The scene with default settings: two scenes that agree in this have the same true picture.
Scene without_method(Scene scene) {
  scene.render = {};
  scene.display = {};
  scene.name.clear();
  return scene;
}

/// Throws UsageError unless the sizes are equal.
void check_size(const std::string& name, const LinearImage& image, const Scene& scene) {
  if (image.width == scene.width && image.height == scene.height) return;
  throw UsageError(name + ": found " + size_text(image.width, image.height) + " pixels, expected " +
                   size_text(scene.width, scene.height) + " as the picture has");
}

}  // namespace

Reference read_reference(const fs::path& name, const Document& document) {
  PictureFile picture = read_whole_picture(name);
  Reference reference{std::move(picture.image), 0, name.filename().string(), document.scene};
  reference.remarks = std::move(picture.remarks);
  check_size(name.string(), reference.image, document.scene);
  check_finite(name, reference.image);
  if (picture.bits < 32) reference.about += " (" + std::to_string(picture.bits) + " bit)";
  const auto [file, layer] = picture_name(name);
  // A picture without a scene is compared with any of its size.
  const auto scene = document.origin->is_picture ? std::nullopt : scene_in(file, document);
  if (scene) reference.scene = *scene, reference.known_method = true;
  if (picture.kind != ImageKind::exr || layer) return reference;
  if (const auto film = read_film(file)) {
    const double error = estimated_relative_error(*film);
    if (std::isfinite(error)) reference.rel_mse = error * error;
  }
  return reference;
}

bool shows_no_scene(const fs::path& name) {
  const auto [file, layer] = picture_name(name);
  if (layer) return true;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  return image_kind(read_bytes(file, kind_size)) != ImageKind::unknown && !read_embedded_scene(file);
}

bool may_be_sky(const fs::path& name) {
  const ImageKind kind = image_kind(read_bytes(picture_name(name).file, kind_size));
  return kind == ImageKind::hdr || kind == ImageKind::exr;
}

std::optional<Reference> rendered_reference(const ReferenceOrder& order,
                                            const std::function<bool(std::uint32_t spp)>& progress) {
  Scene scene = order.scene;
  scene.render.seed ^= 1;  // another one that is as valid
  RenderOptions options;
  options.threads = order.threads;
  options.isa = order.isa;
  options.spp = order.spp;
  options.adaptive = scene.render.adaptive;
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  const RenderResult result = render(*prepared, options, [&](const RenderProgress& now) { return progress(now.spp); });
  if (result.interrupted) return {};
  FinishedPicture picture = finished_picture(*prepared, result);
  const double error = picture.estimate.relative_error;
  const bool same_scene = order.name.empty();
  const std::string seed = same_scene ? ", seed " + std::to_string(scene.render.seed) : "";
  return Reference{std::move(picture.image), std::isfinite(error) ? error * error : 0,
                   (same_scene ? "this scene" : order.name) + " at " + format_count(order.spp) + " spp" + seed,
                   same_scene ? std::move(scene) : order.shown, same_scene};
}

ReferenceFit fit_of(const Reference& reference, const Scene& scene) {
  if (reference.image.width != scene.width || reference.image.height != scene.height) return ReferenceFit::other_size;
  if (!change_between(without_method(reference.scene), without_method(scene)).none()) return ReferenceFit::other_scene;
  const RenderSettings &one = reference.scene.render, &other = scene.render;
  const bool same = reference.known_method && one.seed == other.seed && one.sampler == other.sampler;
  return same ? ReferenceFit::same_samples : ReferenceFit::fits;
}

std::vector<float> picture_of(const Frame& frame) {
  return rgb_of(frame.view == View::beauty ? frame.rgba : frame.beauty);
}

std::vector<float> rgb_of(const std::vector<float>& rgba) {
  std::vector<float> rgb(rgba.size() / 4 * 3);
  for (std::size_t from = 0, to = 0; from < rgba.size(); from += 4, to += 3)
    for (std::size_t k = 0; k < 3; ++k) rgb[to + k] = rgba[from + k];
  return rgb;
}

}  // namespace tyndall
