#include "app/files/stats.h"

#include "core/kernel/scene_view.h"
#include "core/render/plan.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <fstream>

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

/// Infinite and undefined numbers as null: JSON has no others.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds / 1e6 : 0;
}

void add_method(Json& json, const RunFigures& run, const FilmTotals& sum) {
  const RenderSettings& settings = run.settings.render;
  json["isa"] = run.result.kernels.isa;
  json["lanes"] = run.result.kernels.lanes;
  json["kernel_features"] = names_of(run.compiled.needs);
  json["integrator"] = name_of(settings.integrator);
  json["sampler"] = name_of(settings.sampler);
  json["fresnel"] = name_of(settings.fresnel);
  json["relative_error_estimate"] = number(run.picture.estimate.relative_error);
  json["rejected_samples"] = sum.rejected;
  json["truncated_paths"] = sum.truncated;
}

/// The choices and switches that are not in the object yet, in the order of fields(): a new setting is told without a
/// line here.
void add_choices(Json& json, const RenderSettings& settings) {
  const auto add = [&]<class T>(const Field<RenderSettings, T>& field) {
    if (json.contains(field.name)) return;
    if constexpr (NamedEnum<T>) json[field.name] = name_of(settings.*field.value);
    if constexpr (std::is_same_v<T, bool>) json[field.name] = settings.*field.value;
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields_of<RenderSettings>());
}

/// Of the clean view.
void add_clean(Json& json, const RunFigures& run) {
  json["denoised"] = run.result.clean.has_value();
  json["denoised_relative_error_estimate"] =
      run.result.clean ? number(run.result.clean->relative_error) : Json(nullptr);
}
Json clean_hash(const RunFigures& run) {
  return run.result.clean ? Json(hash_text(run.picture.clean_hash)) : Json(nullptr);
}

/// Figures that were added after the first version, at the end, so that the order of the older ones stays.
void add_losses(Json& json, const RunFigures& run, const FilmTotals& sum) {
  json["truncated_throughput"] = sum.cut_throughput;
  json["first_rejected"] = Json::array();
  for (const RejectedSample& r : run.result.first_rejected) json["first_rejected"].push_back({r.x, r.y, r.sample});
  json["adaptive"] = run.settings.render.adaptive;
  json["least_spp"] = sum.least_taken;
  json["most_spp"] = sum.most_taken;
  json["rare_bright_paths"] = run.rare_bright_paths;
  json["caustics"] = name_of(run.settings.render.caustics);
  json["sharing"] = SceneViewOf(run.compiled).view().shares;  // what was done, not only what was allowed
  add_choices(json, run.settings.render);
}

}  // namespace

std::string stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  Json json;
  json["scene"] = run.scene;
  json["width"] = film.region.width();
  json["height"] = film.region.height();
  json["spp"] = run.picture.spp;
  json["samples"] = sum.samples;
  json["rays"] = run.result.rays;
  json["shadow_rays"] = run.result.shadow_rays;
  json["seconds_render"] = run.result.seconds;
  json["seconds_total"] = run.seconds_total;
  json["seconds_build"] = run.seconds_build;
  json["mrays_per_s"] = per_second(run.result.rays, run.result.seconds);
  json["msamples_per_s"] = per_second(sum.samples - run.samples_before, run.result.seconds);
  json["threads"] = run.result.threads;
  add_method(json, run, sum);
  json["peak_memory_bytes"] = peak_memory();
  json["image_hash"] = hash_text(run.picture.hash);
  json["version"] = TYNDALL_VERSION;
  add_losses(json, run, sum);
  add_clean(json, run);
  json["seconds_denoise"] = run.result.seconds_clean;
  json["denoised_hash"] = clean_hash(run);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string embedded_stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  Json json;
  json["version"] = TYNDALL_VERSION;
  json["region"] = {film.region.x0, film.region.y0, film.region.x1, film.region.y1};
  json["first_sample"] = film.first_sample;
  json["spp"] = run.picture.spp;
  add_method(json, run, sum);
  json["image_hash"] = hash_text(run.picture.hash);
  add_losses(json, run, sum);
  add_clean(json, run);
  json["denoised_hash"] = clean_hash(run);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string clean_stats_text(const Film& film, const CleanPicture& clean, double seconds) {
  const FilmTotals sum = totals(film);
  Json json;
  json["version"] = TYNDALL_VERSION;
  json["width"] = film.region.width();
  json["height"] = film.region.height();
  json["spp"] = labelled_spp(film, sum);
  json["samples"] = sum.samples;
  json["relative_error_estimate"] = number(estimated_relative_error(film));
  json["image_hash"] = hash_text(image_hash(film.region.width(), film.region.height(), resolve(film)));
  json["denoised"] = true;
  json["denoised_relative_error_estimate"] = number(clean.relative_error);
  if (seconds > 0) json["seconds_denoise"] = seconds;
  json["denoised_hash"] = hash_text(image_hash(clean.width, clean.height, clean.rgb));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::size_t peak_memory() {
  // ru_maxrss also counts the program that started this one (before exec); VmHWM of the kernel does not.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    unsigned long long kilobytes = 0;
    if (std::sscanf(line.c_str(), "VmHWM: %llu kB", &kilobytes) == 1) return kilobytes * 1024;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace tyndall
