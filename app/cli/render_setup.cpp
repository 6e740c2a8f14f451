#include "app/cli/render_setup.h"

#include "app/report/contents.h"
#include "app/text/standard_streams.h"
#include "core/base/target.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/render/plan.h"

#include <cmath>
#include <optional>

namespace tyndall {
namespace {

/// Samples a pixel at which to stop.
std::uint32_t last_sample_count(const CommandRequest& command, const LoadedScene& loaded) {
  if (command.samples) return command.samples->last - command.samples->first;
  if (command.spp) return *command.spp;
  if (std::isfinite(command.time_limit) || command.target_error > 0) return max_samples;
  return static_cast<std::uint32_t>(loaded.scene.render.spp.value_or(64));
}

void check_region(const Region& region, const Scene& scene) {
  if (region.x1 <= scene.width && region.y1 <= scene.height) return;
  const auto pair = [](int x, int y) { return std::to_string(x) + "," + std::to_string(y); };
  throw UsageError("--region: found X1,Y1 = " + pair(region.x1, region.y1) + ", expected at most " +
                   pair(scene.width, scene.height) + ", the image's size");
}

std::string differing(const std::string& what, const std::string& film, const std::string& requested) {
  return film == requested ? "" : what + " " + film + ", expected " + requested;
}

std::string region_text(const Region& r) {
  return std::to_string(r.x0) + "," + std::to_string(r.y0) + "," + std::to_string(r.x1) + "," + std::to_string(r.y1);
}

std::string text_of_samples(std::uint32_t count) {
  return std::to_string(count) + (count == 1 ? " sample" : " samples") + " a pixel";
}

/// Reads what may be hours of work. If that fails, it is not replaced but told, with the way out.
template <class Read>
auto read_kept(Read read, const std::string& advice) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw UsageError(error.what() + advice);
  }
}

/// Whether the film in the file is to be gone on with without --resume.
bool invites(const std::filesystem::path& file, const RenderOptions& options, const std::string& advice) {
  const auto label = read_kept([&file] { return read_film_label(file); }, advice);
  if (!label || label->unfinished) return label.has_value();
  if (label->isa.empty()) return false;  // from before films said whether they are finished
  try {
    const auto spp = read_stored_frame(file).scene.render.spp;
    return spp && static_cast<std::uint32_t>(*spp) == *options.spp;
  } catch (const std::exception&) {
    return false;  // finished, but its scene cannot be read any more
  }
}

/// Whether a file holds a film of the same samples, from when the render was interrupted.
bool is_copy(const StoredFilm& film, const std::filesystem::path& file) {
  const StoredFilm other = read_stored_frame(file);
  return !differing_samples(other.scene, other.label, film.scene, film.label);
}

/// Throws UsageError if a render would replace an unfinished film that it does not go on from. on: the film in `kept`
/// that it goes on from; null: it starts anew.
void spare_unfinished(const std::vector<std::filesystem::path>& outputs, const std::filesystem::path& kept,
                      const StoredFilm* on) {
  for (const auto& file : outputs) {
    std::error_code error;
    if (file == kept || !is_exr(file) || !std::filesystem::is_regular_file(file, error)) continue;
    try {
      const auto label = read_film_label(file);
      if (!label || !label->unfinished) continue;
      if (on && is_copy(*on, file)) continue;
    } catch (const ImageFileError&) {
      continue;  // no film
    }
    throw UsageError(file.string() + ": found an unfinished film, expected it to be the first .exr output, which is " +
                     "gone on with; --fresh replaces it");
  }
}

RenderStart start_with(StoredFilm stored, const CommandRequest& command, const LoadedScene& loaded,
                       const RenderOptions& options) {
  RenderStart start;
  const std::uint32_t taken = labelled_spp(stored.part.film), requested = *options.spp;
  const std::string name = (command.resume ? "--resume" : stored.part.name) + ": ";
  const std::uint32_t maximum = options.adaptive ? taken : totals(stored.part.film).max_taken;
  const std::string range = (maximum > taken ? std::to_string(taken) + " to " : "") + text_of_samples(maximum);
  if (maximum > requested)
    start.note = name + "the film has " + range + " already, more than the " + std::to_string(requested) +
                 " asked for; " + (taken < requested ? "all pixels get as many" : "it is written as it is");
  else if (taken == requested)
    start.note = stored.part.name + ": already complete: " + text_of_samples(taken);
  else if (!command.resume)
    start.note = name + "goes on from the film's " + text_of_samples(taken);
  start.as_requested = taken == requested && !stored.label.unfinished && command.outputs.size() == 1 &&
                       command.stats.empty() && !command.denoise && stored.scene.display == loaded.scene.display;
  start.film = std::move(stored.part.film);
  return start;
}

/// The film in `file`, if it is to be gone on with.
std::optional<StoredFilm> find_film(const std::filesystem::path& file, const CommandRequest& command,
                                    const LoadedScene& loaded, const RenderOptions& options, const Kernels& kernels) {
  std::error_code error;
  const bool exists = std::filesystem::exists(file, error);
  if (command.resume && !exists)
    throw UsageError("--resume: found no file " + in_quotes(file.string()) +
                     ", expected a film to go on from; without --resume the render starts anew");
  if (!exists) return {};
  const std::string advice =
      std::string("; --fresh") + (command.resume ? " in place of --resume" : "") + " starts over";
  if (!command.resume && !invites(file, options, advice)) return {};
  StoredFilm stored = read_kept([&file] { return read_stored_film(file); }, advice);
  const std::string found = differing_film(stored, command, loaded, options, kernels);
  if (!found.empty() && !command.resume && !stored.label.unfinished) return {};
  if (!found.empty()) throw UsageError(file.string() + ": found " + found + advice);
  tell_contents(stored);
  return stored;
}

}  // namespace

Kernels find_kernels(const std::string& isa) {
  if (const auto kernels = choose_kernels(isa)) return *kernels;
  throw UsageError("--isa: found " + in_quotes(isa) + ", expected " + expected_targets(isa));
}

Kernels kernels_to_render(const std::string& isa) {
  const std::string warning = slow_build_warning();
  if (isa.empty() && !warning.empty()) throw UsageError(warning + "; --isa scalar renders with them nevertheless");
  return find_kernels(isa);
}

std::string differing_film(const StoredFilm& stored, const CommandRequest& command, const LoadedScene& loaded,
                           const RenderOptions& options, const Kernels& kernels) {
  const Film& film = stored.part.film;
  const auto other = differing_samples(stored.scene, stored.label, loaded.scene, label_for(loaded.scene, kernels.isa));
  std::string text = other ? other->found + ", expected " + other->expected : "";
  const auto look = [&text](const std::string& found) {
    if (text.empty()) text = found;
  };
  look(differing("a film of another region,", region_text(film.region), region_text(*options.region)));
  look(differing("samples from", std::to_string(film.first_sample), std::to_string(options.first_sample)));
  const std::uint32_t maximum = totals(film).max_taken;
  if (command.samples && maximum > *options.spp)
    look(
        differing("samples up to", std::to_string(film.first_sample + maximum), std::to_string(command.samples->last)));
  if (options.adaptive && film.planned.empty() && maximum > warm_up)
    look("an adaptive film that does not say how many samples each pixel was to get, expected one that does");
  return text;
}

namespace {

/// Own samples are no function of seed and index, so that nothing can be gone on with or put together.
void check_own_samples(const CommandRequest& command, const std::string& name) {
  const auto refuse = [&](const char* option) {
    throw UsageError(name + ": " + option +
                     ": found samples of the program's own, expected a scene; they are taken anew each time");
  };
  if (command.samples) refuse("--samples");
  if (command.resume) refuse("--resume");
  if (command.replay) refuse("--replay");
  if (command.frame) refuse("--frame");
  if (command.scene.render.given.size() > 0) refuse("an option of rendering");
}

}  // namespace

LoadedScene open_frame(const CommandRequest& command, OwnSamples& own) {
  LoadedScene loaded = open_scene_or_samples(command.scene, own);
  if (loaded.is_picture) check_own_samples(command, loaded.name);
  if (!command.frame) return loaded;
  if (!loaded.scene.animation)
    throw UsageError("--frame: found no \"animation\" in " + printable(loaded.name) + ", expected a scene with keys");
  const int frames = loaded.scene.animation->frames;
  if (*command.frame >= frames)
    throw UsageError("--frame: found " + std::to_string(*command.frame) + ", expected at most " +
                     std::to_string(frames - 1) + ", the last frame of the scene's animation");
  return at_frame(std::move(loaded), {.frames = frames, .seed_per_frame = command.seed_per_frame}, *command.frame);
}

RenderOptions render_options(const CommandRequest& command, const LoadedScene& loaded) {
  const bool adaptive = loaded.scene.render.adaptive;
  if (adaptive && command.samples)
    throw UsageError(
        "--samples and adaptive sampling exclude each other: it says which samples every pixel takes (it comes from "
        "--adaptive, or from /render/adaptive of the scene)");
  if (command.region) check_region(*command.region, loaded.scene);
  RenderOptions options;
  options.isa = command.isa;
  options.region = command.region.value_or(Region{0, 0, loaded.scene.width, loaded.scene.height});
  options.first_sample = command.samples ? command.samples->first : 0;
  options.spp = last_sample_count(command, loaded);
  options.time_limit = command.time_limit;
  options.target_error = command.target_error;
  options.adaptive = adaptive;
  options.clean = command.denoise;
  return options;
}

void tell_contents(const StoredFilm& film) {
  if (film.label.contents.empty() && !film.remark.empty()) complain(film.remark);
}

void tell_alpha(const LoadedScene& loaded) {
  const std::string note = alpha_note(contents_of(loaded.scene).with_alpha);
  if (!note.empty()) complain(loaded.name + ": " + note);
}

RenderStart find_start(const CommandRequest& command, const LoadedScene& loaded, const RenderOptions& options,
                       const Kernels& kernels) {
  const FilmPlace place = film_place(command.outputs, command.form);
  if (command.resume && place.output.empty())
    throw UsageError("--resume needs an output that ends in .exr, and --exr-film yes");
  RenderStart start;
  start.place = place;
  if (command.fresh) return start;
  std::error_code error;
  const bool apart = !place.beside().empty() && std::filesystem::exists(place.beside(), error);
  const std::filesystem::path& file = apart ? place.unfinished : place.output;
  std::optional<StoredFilm> stored;
  if (!file.empty()) stored = find_film(file, command, loaded, options, kernels);
  spare_unfinished(command.outputs, place.output, stored ? &*stored : nullptr);
  if (stored) start = start_with(std::move(*stored), command, loaded, options);
  start.place = place;
  return start;
}

std::vector<std::string> remarks_on_outputs(const CommandRequest& command, const FilmPlace& film) {
  std::vector<std::string> remarks;
  for (const auto& file : command.outputs) {
    const FilePlace place = check_can_write(file);
    const bool keeps = file == film.output && command.checkpoint != 0;
    if (place.method != WriteMethod::in_place || (place.folder_problem.empty() && !keeps)) continue;
    std::string text =
        file.string() + ": cannot be replaced, as " + place.obstacle + "; the picture is written into it at the end";
    if (!place.folder_problem.empty()) text += "; its folder takes no new files (" + place.folder_problem + ")";
    if (keeps && film.beside().empty()) text += "; no checkpoints are kept, so that a killed render starts over";
    if (keeps && !film.beside().empty()) text += "; checkpoints go to " + film.beside().string();
    remarks.push_back(text);
  }
  return remarks;
}

}  // namespace tyndall
