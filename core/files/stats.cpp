#include "core/files/film_files.h"

#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/render/plan.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/system/processors.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace tyndall {
namespace {

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds / 1e6 : 0;
}

void add_method(JsonObject& json, const RunFigures& run, const FilmTotals& sum) {
  const RenderSettings& settings = run.prepared.scene().render;
  put(json, "isa", run.result.kernels.isa);
  put(json, "lanes", run.result.kernels.lanes);
  put(json, "kernel_features", names_of(run.prepared.columns().features));
  put(json, "integrator", settings.integrator);
  put(json, "sampler", settings.sampler);
  put(json, "fresnel", settings.fresnel);
  put(json, "relative_error_estimate", run.picture.estimate.relative_error);
  put(json, "rejected_samples", sum.rejected);
  put(json, "truncated_paths", sum.truncated);
}

/// The choices and switches that are not in the object yet, in the order of fields(): a new setting is told without a
/// line here.
void add_choices(JsonObject& json, const RenderSettings& settings) {
  for_each_field(fields_of<RenderSettings>(), [&]<class T>(const Field<RenderSettings, T>& field) {
    if (find(json, field.name)) return;
    if constexpr (NamedEnum<T> || std::is_same_v<T, bool>) put(json, field.name, settings.*field.value);
  });
}

/// Of the clean view.
void add_clean(JsonObject& json, const RunFigures& run) {
  const std::optional<CleanPicture>& clean = run.result.clean;
  put(json, "denoised", clean.has_value());
  put(json, "denoised_relative_error_estimate", clean ? std::optional(clean->relative_error) : std::nullopt);
}
std::optional<std::string> clean_hash(const RunFigures& run) {
  return run.result.clean ? std::optional(hash_text(run.picture.clean_hash)) : std::nullopt;
}

/// Figures that were added after the first version, at the end, so that the order of the older ones stays.
void add_losses(JsonObject& json, const RunFigures& run, const FilmTotals& sum) {
  put(json, "truncated_throughput", sum.cut_throughput);
  JsonArray rejected;
  for (const RejectedSample& r : run.result.first_rejected)
    rejected.push_back(to_json(std::vector<std::int64_t>{r.x, r.y, r.sample}));
  put(json, "first_rejected", JsonValue{std::move(rejected)});
  put(json, "adaptive", run.prepared.scene().render.adaptive);
  put(json, "least_spp", sum.min_taken);
  put(json, "most_spp", sum.max_taken);
  put(json, "rare_bright_paths", run.picture.rare_bright_paths);
  put(json, "caustics", run.prepared.scene().render.caustics);
}

Layer variance_layer(const Film& film) {
  Layer layer{"Variance", {"R", "G", "B"}, {}};
  layer.values.reserve(3 * film.pixels.size());
  for (const FilmPixel& pixel : film.pixels) {
    const bool whole = counted(film, pixel, 0) > 0 && counted(film, pixel, 1) > 0;
    const Vec3f half = 0.5f * (half_mean(film, pixel, 0) - half_mean(film, pixel, 1));
    for (const float v : {half.x, half.y, half.z})
      layer.values.push_back(whole ? v * v : std::numeric_limits<float>::infinity());
  }
  return layer;
}

}  // namespace

std::string stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  JsonObject json;
  put(json, "scene", all_printable(run.scene));
  put(json, "width", film.region.width());
  put(json, "height", film.region.height());
  put(json, "spp", run.picture.spp);
  put(json, "samples", sum.samples);
  put(json, "rays", run.result.rays);
  put(json, "shadow_rays", run.result.shadow_rays);
  put(json, "seconds_render", run.result.seconds);
  put(json, "seconds_total", run.seconds_total);
  put(json, "seconds_build", run.seconds_build);
  put(json, "mrays_per_s", per_second(run.result.rays, run.result.seconds));
  put(json, "msamples_per_s", per_second(sum.samples - run.samples_before, run.result.seconds));
  put(json, "threads", run.result.threads);
  add_method(json, run, sum);
  put(json, "peak_memory_bytes", peak_memory());
  put(json, "image_hash", hash_text(run.picture.hash));
  put(json, "version", TYNDALL_VERSION);
  add_losses(json, run, sum);
  add_clean(json, run);
  put(json, "seconds_denoise", run.result.seconds_clean);
  put(json, "denoised_hash", clean_hash(run));
  put(json, "sharing", run.prepared.reuses_paths());  // whether it was done, not only allowed
  put(json, "threads_from", all_printable(run.threads_from));
  add_choices(json, run.prepared.scene().render);
  put(json, "guide_ms", run.prepared.guide().milliseconds);
  put(json, "guide_lobes", run.prepared.guide().lobes());
  put(json, "split_events", run.result.split_events);
  return print_members(json);
}

std::string embedded_stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  JsonObject json;
  put(json, "version", TYNDALL_VERSION);
  const Region& r = film.region;
  put(json, "region", std::vector{r.x0, r.y0, r.x1, r.y1});
  put(json, "first_sample", film.first_sample);
  put(json, "spp", run.picture.spp);
  add_method(json, run, sum);
  put(json, "image_hash", hash_text(run.picture.hash));
  add_losses(json, run, sum);
  add_clean(json, run);
  put(json, "denoised_hash", clean_hash(run));
  put(json, "sharing", run.prepared.reuses_paths());  // whether it was done, not only allowed
  add_choices(json, run.prepared.scene().render);
  return print_members(json);
}

std::string clean_stats_text(const Film& film, const CleanPicture& clean, double seconds) {
  const FilmTotals sum = totals(film);
  JsonObject json;
  put(json, "version", TYNDALL_VERSION);
  put(json, "width", film.region.width());
  put(json, "height", film.region.height());
  put(json, "spp", labelled_spp(film, sum));
  put(json, "samples", sum.samples);
  put(json, "relative_error_estimate", estimate_error(film).relative_error);
  put(json, "image_hash", hash_text(image_hash(film.region.width(), film.region.height(), resolve(film))));
  put(json, "denoised", true);
  put(json, "denoised_relative_error_estimate", clean.relative_error);
  if (seconds > 0) put(json, "seconds_denoise", seconds);
  put(json, "denoised_hash", hash_text(image_hash(clean.width, clean.height, clean.rgb)));
  return print_members(json);
}

std::vector<Layer> layers_of(const PreparedScene& scene, const Film& film, const Kernels& kernels) {
  const Region& region = film.region;
  constexpr int rows = 64;  // at a time, to spare memory
  std::vector<Layer> layers = {
      {"Albedo", {"R", "G", "B"}, {}, true}, {"Ns", {"X", "Y", "Z"}, {}}, {"Depth", {"Z"}, {}}};
  for (Layer& layer : layers) layer.values.reserve(layer.channels.size() * film.pixels.size());
  std::vector<float>&albedo = layers[0].values, &normal = layers[1].values, &depth = layers[2].values;
  for (int y = region.y0; y < region.y1; y += rows) {
    const Region strip{region.x0, y, region.x1, std::min(y + rows, region.y1)};
    std::vector<FirstHit> hits(static_cast<std::size_t>(strip.width()) * static_cast<std::size_t>(strip.height()));
    kernels.first_hits(scene.view(), strip, hits.data());
    for (const FirstHit& hit : hits) {
      albedo.insert(albedo.end(), {hit.albedo.x, hit.albedo.y, hit.albedo.z});
      normal.insert(normal.end(), {hit.normal.x, hit.normal.y, hit.normal.z});
      depth.push_back(hit.element < 0 ? std::numeric_limits<float>::infinity() : hit.depth);
    }
  }
  layers.push_back(variance_layer(film));
  return layers;
}

}  // namespace tyndall
