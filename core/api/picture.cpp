#include "core/api/data.h"
#include "core/base/fnv1a.h"
#include "core/base/target.h"

#include <cmath>
#include <numeric>

namespace tyndall {
inline namespace v0 {
namespace {

using inner::guarded;

/// "options: NAME: found X, expected Y".
[[noreturn]] void refuse(const char* name, const std::string& found, const std::string& expected) {
  throw SceneError("options", name, found, expected);
}

void check_limit(const char* name, double value) {
  if (!(value >= 0) || !std::isfinite(value)) refuse(name, number_text(value), "a finite number >= 0; 0: no limit");
}

std::string text_of(const inner::CoreRegion& r) {
  std::string text;
  for (const int number : {r.x0, r.y0, r.x1, r.y1}) text += (text.empty() ? "" : ",") + std::to_string(number);
  return text;
}

inner::CoreRegion region_of(const inner::CoreScene& scene, const RenderOptions& options) {
  if (!options.region) return {0, 0, scene.width, scene.height};
  const inner::CoreRegion region{options.region->x0, options.region->y0, options.region->x1, options.region->y1};
  const bool fits = 0 <= region.x0 && region.x0 < region.x1 && region.x1 <= scene.width && 0 <= region.y0 &&
                    region.y0 < region.y1 && region.y1 <= scene.height;
  if (!fits)
    refuse("region", text_of(region),
           "0 <= x0 < x1 <= " + std::to_string(scene.width) + " and 0 <= y0 < y1 <= " + std::to_string(scene.height));
  return region;
}

/// The core's options for a scene, after looking at each.
inner::CoreOptions core_options(const inner::CoreScene& scene, const RenderOptions& options) {
  check_limit("time", options.time), check_limit("target_error", options.target_error);
  if (!choose_kernels(options.isa)) refuse("isa", in_quotes(options.isa), expected_targets(options.isa));
  if (options.threads < 0) refuse("threads", std::to_string(options.threads), "a whole number >= 0");
  inner::CoreOptions core;
  core.region = region_of(scene, options);
  core.isa = options.isa;
  core.threads = thread_count(options.threads).count;
  core.first_sample = options.first_sample;
  core.adaptive = scene.render.adaptive;
  core.clean = options.clean;
  const bool unlimited = options.time > 0 || options.target_error > 0;
  const auto own = static_cast<std::uint32_t>(scene.render.spp.value_or(64));
  core.spp = options.spp > 0 ? options.spp : unlimited ? max_samples : own;
  if (*core.spp > max_samples || options.first_sample > max_samples - *core.spp)
    refuse("spp", std::to_string(*core.spp), "at most " + std::to_string(max_samples) + " with first_sample");
  if (core.adaptive && options.first_sample > 0)
    refuse("first_sample", std::to_string(options.first_sample), "0, as the scene asks for adaptive sampling");
  if (options.time > 0) core.time_limit = options.time;
  core.target_error = options.target_error;
  return core;
}

/// The film to go on from, which must be one of this scene.
inner::CoreFilm begun(const Scene::Data& scene, const RenderOptions& options, const inner::CoreOptions& core) {
  if (!options.film) return {};
  const Film::Data& begun = *Access::of(*options.film);
  const inner::CoreFilm& film = *begun.film;
  const Scene::Data& stored = Access::of(begun.scene);
  const FilmLabel label = label_for(scene.scene, choose_kernels(core.isa)->isa);
  if (const auto other = differing_samples(stored.scene, begun.label, scene.scene, label))
    refuse("film", other->found, other->expected);
  if (film.region != *core.region) refuse("film", "a film of region " + text_of(film.region), text_of(*core.region));
  if (film.first_sample != core.first_sample)
    refuse("film", "samples from " + std::to_string(film.first_sample), "samples from first_sample");
  return film;
}

/// thrown: gets what the caller's function throws, which stops the render.
ProgressCallback progress_of(const RenderOptions& options, std::exception_ptr& thrown) {
  if (!options.progress) return {};
  return [&](const RenderProgress& now) {
    try {
      return options.progress(Progress{now.spp, now.seconds, now.relative_error, now.mrays_per_s});
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
  };
}

Vec3 to_vec(const Vec3d& v) { return {v.x, v.y, v.z}; }

FilmLabel label_of(const Picture::Data& data) {
  return label_for(Access::of(data.scene).scene, data.result.kernels.isa, data.result.interrupted);
}

}  // namespace

const std::vector<float>& Picture::Data::error_map() const {
  std::call_once(error_made_, [this] { error_map_ = pixel_relative_error(result.film); });
  return error_map_;
}

const std::vector<Layer>& Picture::Data::layers() const {
  const PreparedScene& prepared = *Access::of(scene).prepared();
  std::call_once(layers_made_, [&] { layers_ = layers_of(prepared, result.film, result.kernels); });
  return layers_;
}

const CleanPicture& Picture::Data::clean() const {
  if (result.clean) return *result.clean;
  throw SceneError("picture", "clean", "no clean view", "RenderOptions::clean, and 2 samples in each pixel");
}

Picture render(const Scene& scene, const RenderOptions& options) {
  std::exception_ptr thrown;
  Picture picture = guarded([&] {
    const Scene::Data& of = Access::of(scene);
    const inner::CoreOptions core = core_options(of.scene, options);
    inner::CoreFilm film = begun(of, options, core);
    auto data = std::make_shared<Picture::Data>();
    data->scene = scene;
    data->result = inner::render_film(*of.prepared(), core, progress_of(options, thrown), std::move(film));
    data->picture = finished_picture(*of.prepared(), data->result);
    return Access::picture(std::move(data));
  });
  if (thrown) std::rethrow_exception(thrown);
  return picture;
}

int Picture::width() const { return data_->result.film.region.width(); }
int Picture::height() const { return data_->result.film.region.height(); }
const std::vector<float>& Picture::rgb() const { return data_->picture.image.rgb; }
double Picture::error() const { return data_->picture.estimate.relative_error; }
bool Picture::error_is_reliable() const { return !data_->picture.rare_bright_paths; }
const std::vector<float>& Picture::error_map() const {
  return guarded([&]() -> const std::vector<float>& { return data_->error_map(); });
}
const std::vector<float>& Picture::clean() const {
  return guarded([&]() -> const std::vector<float>& { return data_->clean().rgb; });
}
double Picture::clean_error() const {
  return guarded([&] { return data_->clean().relative_error; });
}
const std::vector<float>& Picture::albedo() const {
  return guarded([&]() -> const std::vector<float>& { return data_->layers()[0].values; });
}
const std::vector<float>& Picture::normal() const {
  return guarded([&]() -> const std::vector<float>& { return data_->layers()[1].values; });
}
const std::vector<float>& Picture::depth() const {
  return guarded([&]() -> const std::vector<float>& { return data_->layers()[2].values; });
}
std::string Picture::hash() const { return hash_text(data_->picture.hash); }
std::string Picture::clean_hash() const {
  return guarded([&] { return data_->clean(), hash_text(data_->picture.clean_hash); });
}
std::uint32_t Picture::spp() const { return data_->picture.spp; }
double Picture::seconds() const { return data_->result.seconds; }
bool Picture::stopped() const { return data_->result.interrupted; }
std::uint64_t Picture::rejected() const { return data_->picture.totals.rejected; }
Scene Picture::scene() const { return data_->scene; }
Film Picture::film() const {
  const std::shared_ptr<const inner::CoreFilm> film(data_.pointer(), &data_->result.film);
  return Access::film(std::make_shared<const Film::Data>(Film::Data{film, data_->scene, label_of(*data_)}));
}

void Picture::save(const std::string& file) const {
  guarded([&] {
    const RenderResult& result = data_->result;
    const Scene::Data& of = Access::of(data_->scene);
    const auto embedded = [&](const std::filesystem::path& to) {
      const RunFigures figures{of.name, *of.prepared(), result, data_->picture, 0, 0, 0};
      return Embedded{embedded_scene(of.scene, of.folder, result.film, to), embedded_stats_text(figures),
                      label_of(*data_)};
    };
    const auto layers = [&] { return data_->layers(); };
    const CleanPicture* clean = result.clean ? &*result.clean : nullptr;
    write_picture({result.film, data_->picture.image, of.scene.display, embedded, layers, clean}, file);
  });
}

std::vector<unsigned char> Picture::png() const {
  return guarded([&] {
    const CleanPicture* clean = data_->result.clean ? &*data_->result.clean : nullptr;
    const inner::CoreRegion& region = data_->result.film.region;
    const Display& display = Access::of(data_->scene).scene.display;
    const LinearImage image = clean ? LinearImage{clean->width, clean->height, clean->rgb} : data_->picture.image;
    const auto dither = display.dither ? std::optional(DitherOrigin{region.x0, region.y0}) : std::nullopt;
    return png_bytes("picture", image, display.exposure, display.tone_map, {}, dither);
  });
}

Film Film::load(const std::string& file) {
  return guarded([&] {
    StoredFilm stored = read_stored_film(file);
    auto scene = std::make_shared<Scene::Data>();
    scene->scene = std::move(stored.scene), scene->name = file;
    auto film = std::make_shared<const inner::CoreFilm>(std::move(stored.part.film));
    return Access::film(std::make_shared<const Data>(Data{film, Access::scene(std::move(scene)), stored.label}));
  });
}

Film Film::merge(const std::vector<Film>& parts) {
  return guarded([&] {
    if (parts.empty()) refuse("parts", "none", "one film at least");
    std::vector<FilmPart> frames;
    const Data& first = *parts[0].data_;
    Data merged{nullptr, first.scene, first.label};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Data& part = *parts[i].data_;
      const std::string name = "part " + std::to_string(i);
      FilmLabel label = part.label;
      label.isa.clear();  // those of several instruction sets are added
      if (const auto other =
              differing_samples(Access::of(part.scene).scene, label, Access::of(first.scene).scene, first.label))
        refuse("parts", name + ": " + other->found, other->expected);
      inner::CoreFilm frame = *part.film;
      frame.pixels.clear(), frame.emission.clear();
      frames.push_back({name, std::move(frame)});
      merged.label = merged_label(merged.label, part.label);
    }
    merged.film = std::make_shared<const inner::CoreFilm>(
        inner::merge_films(frames, [&](std::size_t index) { return *parts[index].data_->film; }));
    return Access::film(std::make_shared<const Data>(std::move(merged)));
  });
}

void Film::save(const std::string& file) const {
  guarded([&] {
    if (!is_exr(file)) throw SceneError(file, "another name", "one that ends in .exr: only EXR holds films");
    const Scene::Data& of = Access::of(data_->scene);
    write_exr(file, *data_->film, {}, {embedded_scene(of.scene, of.folder, *data_->film, file), "", data_->label});
  });
}

int Film::width() const { return data_->film->region.width(); }
int Film::height() const { return data_->film->region.height(); }
std::uint32_t Film::spp() const {
  return guarded([&] { return labelled_spp(*data_->film); });
}
std::string Film::hash() const {
  return guarded([&] { return hash_text(image_hash(width(), height(), resolve(*data_->film))); });
}
Scene Film::scene() const { return data_->scene; }

Picture Film::picture() const {
  return guarded([&] {
    auto data = std::make_shared<Picture::Data>();
    data->scene = data_->scene;
    data->result.film = *data_->film;
    data->result.kernels = choose_kernels(data_->label.isa).value_or(*choose_kernels(""));
    data->result.interrupted = data_->label.unfinished;
    data->picture = finished_picture(*Access::of(data->scene).prepared(), data->result);
    return Access::picture(std::move(data));
  });
}

Comparison compare(const std::vector<float>& image, const std::vector<float>& reference, int width, int height) {
  return guarded([&] {
    const std::size_t expected =
        width > 0 && height > 0 ? std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)
                                : 0;
    if (expected == 0) refuse("size", std::to_string(width) + "x" + std::to_string(height), "at least 1x1 pixel");
    for (const auto* pixels : {&image, &reference})
      if (pixels->size() != expected)
        refuse("pixels", std::to_string(pixels->size()) + " numbers", std::to_string(expected) + ", 3 a pixel");
    const ImageError error = image_error(image, reference);
    const std::vector<float> flip = flip_map(image, reference, width, height);
    Comparison out;
    out.mse = error.mse, out.rmse = error.rmse, out.relmse = error.rel_mse, out.psnr = error.psnr;
    out.flip = std::accumulate(flip.begin(), flip.end(), 0.0) / static_cast<double>(flip.size());
    out.mean_image = to_vec(error.mean_image), out.mean_reference = to_vec(error.mean_reference);
    return out;
  });
}

Comparison compare(const Picture& image, const Picture& reference) {
  return guarded([&] {
    const auto size = [](const Picture& p) { return std::to_string(p.width()) + "x" + std::to_string(p.height()); };
    if (size(image) != size(reference)) refuse("image", size(image) + " pixels", size(reference));
    Comparison out = compare(image.rgb(), reference.rgb(), image.width(), image.height());
    const BlockScores blocks = block_scores(*Access::of(image.film())->film, *Access::of(reference.film())->film);
    out.blocks = blocks.blocks, out.block_score = blocks.mean_square, out.block_limit = blocks.maximum;
    out.worst_z = blocks.worst;
    out.only_noise = blocks.blocks > 0 && blocks.noise();
    if (blocks.blocks == 0) return out;
    const auto a = noisy_image(*Access::of(image.film())->film), b = noisy_image(*Access::of(reference.film())->film);
    const NoiseScores noise = noise_scores(*a, *b);
    out.z = noise.z, out.unclear_blocks = noise.unclear_blocks, out.enough_spp = noise.enough_spp;
    return out;
  });
}

}  // namespace v0
}  // namespace tyndall
