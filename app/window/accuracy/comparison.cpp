#include "app/window/accuracy/comparison.h"

#include "app/comparison/comparison.h"
#include "app/report/heat_map.h"
#include "app/text/numbers.h"
#include "app/window/picture/display.h"
#include "core/accuracy/error.h"
#include "core/accuracy/estimate.h"
#include "core/image/image_io_file.h"
#include "core/render/render.h"
#include "core/scene/load.h"
#include "core/scene/scene.h"
#include "core/system/process.h"

#include <fmt/core.h>

#include <cmath>
#include <exception>
#include <numeric>
#include <utility>

namespace tyndall {

namespace {

template <class Colour>
std::vector<float> map_of(const std::vector<float>& values, const Colour& colour_of) {
  std::vector<float> rgba;
  rgba.reserve(4 * values.size());
  for (const float value : values) {
    const std::array<float, 3> colour = colour_of(value);
    rgba.insert(rgba.end(), {colour[0], colour[1], colour[2], 1.0f});
  }
  return rgba;
}

std::array<float, 3> grey(float error) {
  const float shown = error < 1 ? error : 1.0f;  // also what is not a number
  return {shown, shown, shown};
}

bool has_picture(const Frame& frame) { return frame.spp > 0 && (frame.view == View::beauty || !frame.beauty.empty()); }

namespace fs = std::filesystem;

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

}  // namespace

bool can_compare(const ComparisonOrder& order) {
  if (!order.frame || !has_picture(*order.frame)) return false;
  const Frame& frame = *order.frame;
  if (order.kept)
    return has_picture(*order.kept) && order.kept->width == frame.width && order.kept->height == frame.height;
  return order.reference && order.reference->image.width == frame.width &&
         order.reference->image.height == frame.height;
}

ComparisonResult compare(const ComparisonOrder& order) {
  const double before = thread_cpu_seconds();
  const int width = order.frame->width, height = order.frame->height;
  const std::vector<float> image = picture_of(*order.frame);
  const std::vector<float> kept = order.kept ? picture_of(*order.kept) : std::vector<float>{};
  const std::vector<float>& against = order.kept ? kept : order.reference->image.rgb;
  ComparisonResult result;
  result.rel_mse = relative_mse(image, against);
  if (order.clean && order.frame->clean) result.clean_rel_mse = relative_mse(rgb_of(order.frame->clean->rgba), against);
  const double noise = !order.kept && order.independent ? order.reference->rel_mse : 0;
  result.rel_mse -= noise;
  if (result.clean_rel_mse) *result.clean_rel_mse -= noise;
  if (order.map == ErrorView::error) result.map = map_of(pixel_relative_error(image, against, width, height), grey);
  if (order.flip || order.map == ErrorView::flip) {
    const std::vector<float> flip = flip_map(image, against, width, height);
    result.flip = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
    if (order.map == ErrorView::flip) result.map = map_of(flip, heat);
  }
  result.cpu_seconds = thread_cpu_seconds() - before;
  return result;
}

Reference read_reference(const fs::path& name, const Document& document) {
  PictureFile picture = read_whole_picture(name);
  Reference reference{std::move(picture.image), 0, name.filename().string(), document.scene};
  reference.remarks = std::move(picture.remarks);
  const LinearImage& image = reference.image;
  if (image.width != document.scene.width || image.height != document.scene.height)
    throw UsageError(fmt::format("{}: found {}x{} pixels, expected {}x{} as the picture has", name.string(),
                                 image.width, image.height, document.scene.width, document.scene.height));
  check_finite(name, reference.image);
  if (picture.bits < 32) reference.about += " (" + std::to_string(picture.bits) + " bit)";
  const auto [file, layer] = picture_name(name);
  // A picture without a scene is compared with any of its size.
  const auto scene = document.origin->is_picture ? std::nullopt : scene_in(file, document);
  if (scene) reference.scene = *scene, reference.known_method = true;
  if (picture.kind != ImageKind::exr || layer) return reference;
  if (const auto film = read_film(file)) {
    const double error = estimate_error(*film).relative_error;
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
                   same_scene ? scene : order.shown, same_scene};
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

}  // namespace tyndall
