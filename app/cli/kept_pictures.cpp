#include "app/cli/pictures.h"
#include "app/text/standard_streams.h"
#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/base/text.h"
#include "core/files/film_files.h"
#include "core/render/plan.h"
#include "core/scene/place.h"
#include "core/system/open_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <new>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

std::string region_text(const Region& r) { return fmt::format("{},{},{},{}", r.x0, r.y0, r.x1, r.y1); }

/// What keeps a render from going on with a film, as "found X, expected Y" without "found"; "": nothing does.
std::string differing_film(const StoredFilm& stored, const RenderJob& job) {
  const Film& film = stored.part.film;
  const CommandRequest& options = job.command;
  const FilmLabel label = label_for(job.loaded.scene, job.kernels.isa);
  if (const auto other = differing_samples(stored.scene, stored.label, job.loaded.scene, label))
    return other->found + ", expected " + other->expected;
  if (!(film.region == *options.region))
    return "a film of another region, " + region_text(film.region) + ", expected " + region_text(*options.region);
  if (film.first_sample != options.first_sample)
    return fmt::format("samples from {}, expected {}", film.first_sample, options.first_sample);
  const std::uint32_t maximum = totals(film).max_taken;
  if (options.sample_range && maximum > *options.spp)
    return fmt::format("samples up to {}, expected {}", film.first_sample + maximum, options.sample_range->last);
  if (options.adaptive && film.planned.empty() && maximum > warm_up)
    return "an adaptive film that does not say how many samples each pixel was to get, expected one that does";
  return "";
}

/// One line on standard error if a film that fits does not say which pixels its textures and sky had.
void tell_contents(const StoredFilm& film) {
  if (film.label.contents.empty() && !film.remark.empty()) complain(film.remark);
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
    refuse("{}{}", error.what(), advice);
  }
}

/// Whether the film in the file is to be gone on with without --resume.
bool invites(const std::filesystem::path& file, const RenderJob& job, const std::string& advice) {
  const auto label = read_kept([&file] { return read_film_label(file); }, advice);
  if (!label || label->unfinished) return label.has_value();
  if (label->isa.empty()) return false;  // from before films said whether they are finished
  try {
    const auto spp = read_stored_frame(file).scene.render.spp;
    return spp && static_cast<std::uint32_t>(*spp) == *job.command.spp;
  } catch (const std::exception&) {
    return false;  // finished, but its scene cannot be read any more
  }
}

/// Throws UsageError if a render would replace an unfinished film that it does not go on from. on: the film in `kept`
/// that it goes on from, from when it was interrupted; null: it starts anew.
void spare_unfinished(const std::vector<std::filesystem::path>& outputs, const std::filesystem::path& kept,
                      const StoredFilm* on) {
  for (const auto& file : outputs) {
    std::error_code error;
    if (file == kept || !is_exr(file) || !std::filesystem::is_regular_file(file, error)) continue;
    try {
      const auto label = read_film_label(file);
      if (!label || !label->unfinished) continue;
      if (on) {
        const StoredFilm other = read_stored_frame(file);
        if (!differing_samples(other.scene, other.label, on->scene, on->label)) continue;  // a copy
      }
    } catch (const ImageFileError&) {
      continue;  // no film
    }
    refuse(
        "{}: found an unfinished film, expected it to be the first .exr output, which is gone on with; --fresh "
        "replaces it",
        file.string());
  }
}

void start_with(StoredFilm stored, RenderJob& job) {
  const CommandRequest& command = job.command;
  const std::uint32_t taken = labelled_spp(stored.part.film), requested = *job.command.spp;
  const std::string name = (command.resume ? "--resume" : stored.part.name) + ": ";
  const std::uint32_t maximum = job.command.adaptive ? taken : totals(stored.part.film).max_taken;
  const std::string range = (maximum > taken ? std::to_string(taken) + " to " : "") + text_of_samples(maximum);
  if (maximum > requested)
    job.note = fmt::format("{}the film has {} already, more than the {} asked for; {}", name, range, requested,
                           taken < requested ? "all pixels get as many" : "it is written as it is");
  else if (taken == requested)
    job.note = stored.part.name + ": already complete: " + text_of_samples(taken);
  else if (!command.resume)
    job.note = name + "goes on from the film's " + text_of_samples(taken);
  job.complete = taken == requested && !stored.label.unfinished && command.outputs.size() == 1 &&
                 command.stats.empty() && !command.clean && stored.scene.display == job.loaded.scene.display;
  job.begin = std::move(stored.part.film);
}

/// The film in `file`, if it is to be gone on with.
std::optional<StoredFilm> find_film(const std::filesystem::path& file, const RenderJob& job) {
  const bool resume = job.command.resume;
  std::error_code error;
  const bool exists = std::filesystem::exists(file, error);
  if (resume && !exists)
    refuse("--resume: found no file {}, expected a film to go on from; without --resume the render starts anew",
           in_quotes(file.string()));
  const std::string advice = resume ? "; --fresh in place of --resume starts over" : "; --fresh starts over";
  if (!exists || (!resume && !invites(file, job, advice))) return {};
  StoredFilm stored = read_kept([&file] { return read_stored_film(file); }, advice);
  const std::string found = differing_film(stored, job);
  if (!found.empty() && !resume && !stored.label.unfinished) return {};
  if (!found.empty()) refuse("{}: found {}{}", file.string(), found, advice);
  tell_contents(stored);
  return stored;
}

constexpr const char* remedy = "; --fresh replaces it";

using Json = nlohmann::ordered_json;

/// A figure that a picture carries; `otherwise` where it does not, or has something else in its place.
template <class T>
T figure(const Json& figures, const char* name, T otherwise) {
  try {
    return figures.value(name, otherwise);
  } catch (const Json::exception&) {
    return otherwise;
  }
}

/// The frame of a film that a picture without a film would have been made from, by the figures that it carries.
StoredFilm described_film(const std::filesystem::path& file, const Json& figures) {
  const LoadedScene loaded = load_scene(("./" / file).string());
  StoredFilm film{{file.string(), {}}, loaded.scene, {}, contents_remark(loaded)};
  const auto region = figure(figures, "region", std::vector<int>());
  if (region.size() == 4) film.part.film.region = {region[0], region[1], region[2], region[3]};
  film.part.film.first_sample = figure(figures, "first_sample", 0u);
  film.label = {figure(figures, "version", std::string()), figure(figures, "isa", std::string()), false,
                loaded.contents.value_or("")};
  return film;
}

/// How a finished picture differs from the one that the job makes, as "found X, expected Y" without "found".
std::string differing_picture(const StoredFilm& stored, const Json& figures, const RenderJob& job, bool shown) {
  const CommandRequest& command = job.command;
  const std::uint32_t found = static_cast<std::uint32_t>(stored.scene.render.spp.value_or(0)), wanted = *command.spp;
  const bool counted = wanted < max_samples && command.target_error == 0 && !(command.time_limit < 1e300);
  if (counted && (command.adaptive ? found > wanted : found != wanted))
    return fmt::format("{} samples a pixel, expected {}", found, wanted);
  if (figure(figures, "denoised", command.clean) != command.clean)
    return command.clean ? "an unfiltered picture, expected a filtered one"
                         : "a filtered picture, expected one without --denoise";
  if (shown && !(stored.scene.display == job.loaded.scene.display))
    return "a picture of another exposure or tone map, expected those of this command";
  return "";
}

/// Whether a picture that carries what it is of is finished.
bool is_finished(const std::filesystem::path& file, const RenderJob& job) {
  const auto label = is_exr(file) ? read_film_label(file) : std::nullopt;
  const Json figures = Json::parse(read_embedded_stats(file).value_or("{}"), nullptr, false);
  if (figures.is_discarded())
    refuse("{}: found a picture whose figures cannot be read, expected one of this command", file.string());
  const StoredFilm stored = label ? read_stored_frame(file) : described_film(file, figures);
  const bool unfinished = label && label->unfinished;
  std::string found = differing_film(stored, job);
  if (found.empty() && !unfinished) found = differing_picture(stored, figures, job, !is_exr(file));
  if (!found.empty()) refuse("{}: found {}", file.string(), found);
  tell_contents(stored);
  return !unfinished;
}

/// The same for a picture of which a list says that.
bool is_listed_whole(const std::filesystem::path& file, const FrameList& list, const RenderJob& job) {
  const auto entry = list.entries.find(*job.command.frame);
  if (entry == list.entries.end())
    refuse("{}: found a file of which {} does not say what it is, expected none or a frame of this command{}",
           file.string(), list.file.string(), remedy);
  if (!entry->second.ends_with(picture_mark(job)))
    refuse("{}: found a frame of another scene, other settings or another version ({}), expected one of this command{}",
           file.string(), list.file.string(), remedy);
  return entry->second.starts_with("whole");
}

/// Whether a file holds the whole picture of the job.
bool is_whole(const std::filesystem::path& file, const RenderJob& job) {
  std::error_code error;
  const bool of_sweep = !job.command.axes.empty();
  if ((of_sweep && !is_exr(file)) || !std::filesystem::exists(file, error)) return false;
  const auto list = job.lists.find(file);
  if (list != job.lists.end()) return is_listed_whole(file, *list->second, job);
  return read_kept([&] { return is_finished(file, job); }, remedy);
}

}  // namespace

void find_start(RenderJob& job) {
  const CommandRequest& command = job.command;
  const FilmPlace& place = job.place = film_place(command.outputs, command.form);
  if (command.resume && place.output.empty()) refuse("--resume needs an output that ends in .exr, and --exr-film yes");
  if (command.fresh) return;
  std::error_code error;
  const bool apart = std::filesystem::exists(place.beside(), error);
  std::optional<StoredFilm> stored;
  if (!place.output.empty()) stored = find_film(apart ? place.unfinished : place.output, job);
  spare_unfinished(command.outputs, place.output, stored ? &*stored : nullptr);
  if (stored) start_with(std::move(*stored), job);
}

FrameList read_frame_list(const std::filesystem::path& file) {
  FrameList list{file};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    int frame = 0;
    std::string state, mark, more;
    const bool read = static_cast<bool>(words >> frame >> state >> mark) && !(words >> more);
    if (read && mark.size() == 16 && (state == "begun" || state == "whole"))
      list.entries[frame] = fmt::format("{} {}", state, mark);
  }
  return list;
}

void add_frame(const std::filesystem::path& list, int frame, const std::string& entry) {
  // A line break in front ends a line that a kill has cut off.
  const std::string line = fmt::format("\n{} {}\n", frame, entry);
  const OpenFile file(list, OpenFor::adding);
  int problem = file ? file.write(line.data(), line.size()) : file.error();
  if (problem == 0) problem = file.synchronise();
  if (problem != 0) throw IoError(list.string() + ": cannot write: " + error_text(problem));
}

void list_outputs(const RenderJob& job, const std::string& state) {
  for (const auto& [file, list] : job.lists)
    if (std::count(job.command.outputs.begin(), job.command.outputs.end(), file) > 0)
      add_frame(list->file, *job.command.frame, state + " " + picture_mark(job));
}

PictureTask task_of(const RenderJob& job) {
  PictureTask task;
  for (const std::filesystem::path& file : job.command.outputs) {
    const bool whole = !job.command.fresh && is_whole(file, job);
    if (!whole) task.outputs.push_back(file);
    if (whole && task.film.empty() && is_exr(file) && read_film_label(file)) task.film = file;
  }
  return task;
}

std::string picture_mark(const RenderJob& job) {
  const CommandRequest& c = job.command;
  Scene scene = move_textures(job.loaded.scene, job.loaded.folder, ".");
  scene.name.clear();
  scene.render.spp.reset();
  return hash_text(
      fnv1a(fmt::format("{} {} {} {} {} {} {} {} ", TYNDALL_VERSION, job.kernels.isa, *job.command.spp, c.time_limit,
                        c.target_error, region_text(*job.command.region), c.clean, static_cast<int>(c.form.ppm)) +
            write_scene(scene) + contents_hash(scene)));
}

}  // namespace tyndall
