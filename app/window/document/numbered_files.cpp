#include "app/window/document/numbered_files.h"

#include "app/files/outputs.h"
#include "app/window/system/pacing.h"
#include "core/files/film_files.h"
#include "core/system/open_file.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <thread>
#include <utility>

namespace tyndall {
namespace {

namespace fs = std::filesystem;

/// Writes the files; returns their names, for the user.
std::string write_files(const Snapshot& snapshot, const Picture& picture) {
  std::vector<fs::path> files{snapshot.base.string() + ".png"};
  if (has_openexr()) files.emplace_back(snapshot.base.string() + ".exr");
  const std::vector<std::string> problems = write_images(picture, files);
  if (!problems.empty()) throw ImageFileError(fmt::format("{}", fmt::join(problems, "; ")));
  return files[0].filename().string() + (files.size() > 1 ? " and .exr" : "");
}

}  // namespace

fs::path numbered_base(const fs::path& folder, const std::string& stem, int minimum,
                       const std::vector<const char*>& endings) {
  for (int number = minimum;; ++number) {
    fs::path base = folder / fmt::format("{}-{:03}", stem, number);
    std::error_code ignored;
    const auto taken = [&](const char* ending) {
      return fs::symlink_status(base.string() + ending, ignored).type() != fs::file_type::not_found;
    };
    if (std::none_of(endings.begin(), endings.end(), taken)) return base;
  }
}

int number_of(const fs::path& base) {
  const std::string name = base.filename().string();
  return std::atoi(name.c_str() + name.rfind('-') + 1);
}

fs::path NumberedFiles::next_base(const std::string& stem) {
  std::error_code gone;  // the current folder may be; writing then says so
  fs::path base = numbered_base(fs::current_path(gone), stem, last_ + 1, endings_);
  last_ = number_of(base);
  return base;
}

void NumberedFiles::write(const fs::path& base, std::function<std::string(const fs::path& base)> work) {
  jobs_.run([this, base, work = std::move(work)]() -> JobQueue::Result {
    try {
      // Other windows choose no name meanwhile, where folders can be locked.
      const OpenFile folder(base.parent_path(), OpenFor::folder);
      if (folder) folder.lock(true);
      const std::string name = base.filename().string();
      const fs::path free =
          numbered_base(base.parent_path(), name.substr(0, name.rfind('-')), number_of(base), endings_);
      const std::string text = work(free);
      return [this, text, free] {
        last_ = std::max(last_, number_of(free));
        messages_.say(text);
        if (log_) log_->line("saved " + free.string());
      };
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { messages_.say(text, true); };
    }
  });
}

std::string write_snapshot(const Snapshot& snapshot, Film film) {
  const Scene& scene = snapshot.document.scene;
  if (!snapshot.has_scene) {
    const LinearImage image{film.region.width(), film.region.height(), resolve(film)};
    const auto nothing = [](const fs::path&) { return Embedded{"", "", {}, false}; };
    return "saved " + write_files(snapshot, {film, image, scene.display, nothing, {}});
  }
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
                                          stats, label_for(scene, result.kernels.isa)};
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
