#include "app/files/stats.h"

#include "app/text/json_text.h"
#include "core/render/plan.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <fstream>

namespace tyndall {
namespace {

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds / 1e6 : 0;
}

void add_method(JsonText& json, const RunFigures& run, const FilmTotals& sum) {
  const RenderSettings& settings = run.prepared.scene().render;
  json.add("isa", run.result.kernels.isa);
  json.add("lanes", run.result.kernels.lanes);
  json.add("kernel_features", names_of(run.prepared.columns().needs));
  json.add("integrator", name_of(settings.integrator));
  json.add("sampler", name_of(settings.sampler));
  json.add("fresnel", name_of(settings.fresnel));
  json.add("relative_error_estimate", run.picture.estimate.relative_error);
  json.add("rejected_samples", sum.rejected);
  json.add("truncated_paths", sum.truncated);
}

/// The choices and switches that are not in the object yet, in the order of fields(): a new setting is told without a
/// line here.
void add_choices(JsonText& json, const RenderSettings& settings) {
  const auto add = [&]<class T>(const Field<RenderSettings, T>& field) {
    if (json.contains(field.name)) return;
    if constexpr (NamedEnum<T>) json.add(field.name, name_of(settings.*field.value));
    if constexpr (std::is_same_v<T, bool>) json.add(field.name, settings.*field.value);
  };
  std::apply([&](const auto&... field) { (add(field), ...); }, fields_of<RenderSettings>());
}

/// Of the clean view.
void add_clean(JsonText& json, const RunFigures& run) {
  const std::optional<CleanPicture>& clean = run.result.clean;
  json.add("denoised", clean.has_value());
  json.add("denoised_relative_error_estimate", clean ? std::optional(clean->relative_error) : std::nullopt);
}
std::optional<std::string> clean_hash(const RunFigures& run) {
  return run.result.clean ? std::optional(hash_text(run.picture.clean_hash)) : std::nullopt;
}

/// Figures that were added after the first version, at the end, so that the order of the older ones stays.
void add_losses(JsonText& json, const RunFigures& run, const FilmTotals& sum) {
  json.add("truncated_throughput", sum.cut_throughput);
  std::string rejected;
  for (const RejectedSample& r : run.result.first_rejected)
    rejected += fmt::format("{}[{}, {}, {}]", rejected.empty() ? "" : ", ", r.x, r.y, r.sample);
  json.add_json("first_rejected", "[" + rejected + "]");
  json.add("adaptive", run.prepared.scene().render.adaptive);
  json.add("least_spp", sum.least_taken);
  json.add("most_spp", sum.most_taken);
  json.add("rare_bright_paths", run.picture.rare_bright_paths);
  json.add("caustics", name_of(run.prepared.scene().render.caustics));
}

}  // namespace

std::string stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  JsonText json;
  json.add("scene", run.scene);
  json.add("width", film.region.width());
  json.add("height", film.region.height());
  json.add("spp", run.picture.spp);
  json.add("samples", sum.samples);
  json.add("rays", run.result.rays);
  json.add("shadow_rays", run.result.shadow_rays);
  json.add("seconds_render", run.result.seconds);
  json.add("seconds_total", run.seconds_total);
  json.add("seconds_build", run.seconds_build);
  json.add("mrays_per_s", per_second(run.result.rays, run.result.seconds));
  json.add("msamples_per_s", per_second(sum.samples - run.samples_before, run.result.seconds));
  json.add("threads", run.result.threads);
  add_method(json, run, sum);
  json.add("peak_memory_bytes", peak_memory());
  json.add("image_hash", hash_text(run.picture.hash));
  json.add("version", TYNDALL_VERSION);
  add_losses(json, run, sum);
  add_clean(json, run);
  json.add("seconds_denoise", run.result.seconds_clean);
  json.add("denoised_hash", clean_hash(run));
  json.add("sharing", run.prepared.reuses_paths());  // whether it was done, not only allowed
  json.add("threads_from", run.threads_from);
  add_choices(json, run.prepared.scene().render);
  return json.text();
}

std::string embedded_stats_text(const RunFigures& run) {
  const Film& film = run.result.film;
  const FilmTotals& sum = run.picture.totals;
  JsonText json;
  json.add("version", TYNDALL_VERSION);
  const Region& r = film.region;
  json.add_json("region", fmt::format("[{}, {}, {}, {}]", r.x0, r.y0, r.x1, r.y1));
  json.add("first_sample", film.first_sample);
  json.add("spp", run.picture.spp);
  add_method(json, run, sum);
  json.add("image_hash", hash_text(run.picture.hash));
  add_losses(json, run, sum);
  add_clean(json, run);
  json.add("denoised_hash", clean_hash(run));
  json.add("sharing", run.prepared.reuses_paths());  // whether it was done, not only allowed
  add_choices(json, run.prepared.scene().render);
  return json.text();
}

std::string clean_stats_text(const Film& film, const CleanPicture& clean, double seconds) {
  const FilmTotals sum = totals(film);
  JsonText json;
  json.add("version", TYNDALL_VERSION);
  json.add("width", film.region.width());
  json.add("height", film.region.height());
  json.add("spp", labelled_spp(film, sum));
  json.add("samples", sum.samples);
  json.add("relative_error_estimate", estimated_relative_error(film));
  json.add("image_hash", hash_text(image_hash(film.region.width(), film.region.height(), resolve(film))));
  json.add("denoised", true);
  json.add("denoised_relative_error_estimate", clean.relative_error);
  if (seconds > 0) json.add("seconds_denoise", seconds);
  json.add("denoised_hash", hash_text(image_hash(clean.width, clean.height, clean.rgb)));
  return json.text();
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
