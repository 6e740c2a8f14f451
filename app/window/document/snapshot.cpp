#include "app/window/document/snapshot.h"

#include "app/files/film_files.h"
#include "app/files/layers.h"
#include "app/files/outputs.h"
#include "app/files/stats.h"
#include "app/window/system/clock.h"

#include <fmt/format.h>

#include <thread>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

namespace {

/// Writes the files; returns their names, for the user.
std::string write_files(const Snapshot& snapshot, const Picture& picture) {
  std::vector<fs::path> files{snapshot.base.string() + ".png"};
  if (has_openexr()) files.emplace_back(snapshot.base.string() + ".exr");
  const std::vector<std::string> problems = write_images(picture, files);
  if (!problems.empty()) throw ImageFileError(fmt::format("{}", fmt::join(problems, "; ")));
  return files[0].filename().string() + (files.size() > 1 ? " and .exr" : "");
}

std::string write_without_scene(const Snapshot& snapshot, const Film& film) {
  const LinearImage image{film.region.width(), film.region.height(), resolve(film)};
  const auto nothing = [](const fs::path&) { return Embedded{"", "", {}, false}; };
  return "saved " + write_files(snapshot, {film, image, snapshot.document.scene.display, nothing, {}});
}

}  // namespace

std::string write_snapshot(const Snapshot& snapshot, Film film) {
  if (!snapshot.has_scene) return write_without_scene(snapshot, film);
  const Scene& scene = snapshot.document.scene;
  const std::shared_ptr<const PreparedScene> prepared = prepare(scene);
  RenderResult result;
  result.film = std::move(film);
  result.threads = snapshot.threads;
  result.kernels = choose_kernels(snapshot.isa).value();
  result.estimate = estimate_error(*prepared, result.kernels, result.film, 1);
  const FinishedPicture finished = finished_picture(*prepared, result);
  const std::string stats =
      embedded_stats_text({snapshot.document.origin->title, *prepared, result, finished, 0, 0, 0});
  const Picture picture{result.film, finished.image, scene.display,
                        [&](const fs::path& file) {
                          return Embedded{embedded_scene(scene, snapshot.document.origin->folder, result.film, file),
                                          stats,
                                          {TYNDALL_VERSION, result.kernels.isa, false}};
                        },
                        [&] { return layers_of(*prepared, result.film, result.kernels); }};
  const std::string files = write_files(snapshot, picture);
  const FilmTotals& sum = finished.totals;
  const bool uneven = !scene.render.adaptive && sum.min_taken != sum.max_taken;  // within a pass, or refined first
  return "saved " + files + ", " + std::to_string(finished.spp) +
         (uneven ? " to " + std::to_string(sum.max_taken) : "") + " spp";
}

Film wait_for_film(const std::function<Film()>& film, const std::function<bool()>& current,
                   const std::function<bool()>& patient) {
  for (const double end = clock_seconds() + 20; clock_seconds() < end;) {
    Film now = film();
    if (!current()) return {};
    if (!now.pixels.empty() && totals(now).min_taken > 0) return now;
    if (!patient()) return {};
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return {};
}

}  // namespace tyndall
