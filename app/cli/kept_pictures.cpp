#include "app/cli/kept_pictures.h"

#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/files/film_files.h"
#include "core/scene/json_tree.h"
#include "core/scene/place.h"
#include "core/system/open_file.h"

#include <fmt/core.h>

#include <fstream>
#include <new>
#include <sstream>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

constexpr const char* remedy = "; --fresh replaces it";

int whole_number(const JsonValue* value) {
  const auto* number = value ? std::get_if<double>(&value->value) : nullptr;
  return number ? static_cast<int>(*number) : 0;
}

/// The frame of a film that a picture without a film would have been made from, by the figures that it carries.
StoredFilm described_film(const std::filesystem::path& file, const JsonValue& stats) {
  const LoadedScene loaded = load_scene(("./" / file).string());
  StoredFilm film{{file.string(), {}}, loaded.scene, {}, contents_remark(loaded)};
  if (const JsonValue* region = find(&stats, "region"))
    if (const auto* numbers = std::get_if<JsonArray>(&region->value); numbers && numbers->size() == 4)
      film.part.film.region = {whole_number(&(*numbers)[0]), whole_number(&(*numbers)[1]), whole_number(&(*numbers)[2]),
                               whole_number(&(*numbers)[3])};
  film.part.film.first_sample = static_cast<std::uint32_t>(whole_number(find(&stats, "first_sample")));
  film.label = {text_of(find(&stats, "version")), text_of(find(&stats, "isa")), false, loaded.contents.value_or("")};
  return film;
}

/// How a finished picture differs from the one that the job makes, as "found X, expected Y" without "found".
std::string differing_picture(const StoredFilm& stored, const JsonValue& stats, const RenderJob& job, bool shown) {
  const CommandRequest& command = job.command;
  const std::uint32_t found = static_cast<std::uint32_t>(stored.scene.render.spp.value_or(0)),
                      wanted = *job.options.spp;
  const bool counted = wanted < max_samples && command.target_error == 0 && !(command.time_limit < 1e300);
  if (counted && (job.options.adaptive ? found > wanted : found != wanted))
    return fmt::format("{} samples a pixel, expected {}", found, wanted);
  const JsonValue* denoised = find(&stats, "denoised");
  const auto* clean = denoised ? std::get_if<bool>(&denoised->value) : nullptr;
  if (clean && *clean != command.denoise)
    return *clean ? "a filtered picture, expected one without --denoise"
                  : "an unfiltered picture, expected a filtered one";
  if (shown && !(stored.scene.display == job.loaded.scene.display))
    return "a picture of another exposure or tone map, expected those of this command";
  return "";
}

PictureState look(const std::filesystem::path& file, const RenderJob& job) {
  const auto label = is_exr(file) ? read_film_label(file) : std::nullopt;
  const std::string text = read_embedded_stats(file).value_or("{}");
  const JsonDocument stats = parse_json(text);
  const StoredFilm stored = label ? read_stored_frame(file) : described_film(file, stats.root);
  const bool unfinished = label && label->unfinished;
  std::string found = differing_film(stored, job.command, job.loaded, job.options, job.kernels);
  if (found.empty() && !unfinished) found = differing_picture(stored, stats.root, job, !is_exr(file));
  if (!found.empty()) throw UsageError(file.string() + ": found " + found);
  tell_contents(stored);
  return unfinished ? PictureState::unfinished : PictureState::whole;
}

}  // namespace

PictureState look_at_picture(const std::filesystem::path& file, const RenderJob& job) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return PictureState::nothing;
  try {
    return look(file, job);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const ParseError&) {
    throw UsageError(file.string() + ": found a picture whose figures cannot be read, expected one of this command" +
                     remedy);
  } catch (const std::exception& problem) {
    throw UsageError(problem.what() + std::string(remedy));
  }
}

FrameList::FrameList(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    int frame = 0;
    std::string state, mark, more;
    const bool read = static_cast<bool>(words >> frame >> state >> mark) && !(words >> more);
    if (read && mark.size() == 16 && (state == "begun" || state == "whole")) entries_[frame] = {mark, state == "whole"};
  }
}

const FrameList::Entry* FrameList::find(int frame) const {
  const auto found = entries_.find(frame);
  return found == entries_.end() ? nullptr : &found->second;
}

void FrameList::add(int frame, const Entry& entry) {
  // A line break in front ends a line that a kill has cut off.
  const std::string line = "\n" + std::to_string(frame) + (entry.whole ? " whole " : " begun ") + entry.mark + "\n";
  const OpenFile list(file_, OpenFor::adding);
  int problem = list ? list.write(line.data(), line.size()) : list.error();
  if (problem == 0) problem = list.synchronise();
  if (problem != 0) throw IoError(file_.string() + ": cannot write: " + error_text(problem));
  entries_[frame] = entry;
}

PictureState look_at_list(const std::filesystem::path& file, const FrameList& list, int frame,
                          const std::string& mark) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return PictureState::nothing;
  const FrameList::Entry* entry = list.find(frame);
  if (!entry)
    throw UsageError(file.string() + ": found a file of which " + list.file().string() +
                     " does not say what it is, expected none or a frame of this command" + remedy);
  if (entry->mark != mark)
    throw UsageError(file.string() + ": found a frame of another scene, other settings or another version (" +
                     list.file().string() + "), expected one of this command" + remedy);
  return entry->whole ? PictureState::whole : PictureState::nothing;
}

std::string mark_of(const std::string& text) { return hash_text(fnv1a(text)); }

std::string picture_mark(const RenderJob& job) {
  const CommandRequest& c = job.command;
  Scene scene = move_textures(job.loaded.scene, job.loaded.folder, ".");
  scene.name.clear();
  scene.render.spp.reset();
  const Region& r = *job.options.region;
  return mark_of(fmt::format("{} {} {} {} {} {},{},{},{} {} {} ", TYNDALL_VERSION, job.kernels.isa, *job.options.spp,
                             c.time_limit, c.target_error, r.x0, r.y0, r.x1, r.y1, c.denoise,
                             static_cast<int>(c.form.ppm)) +
                 write_scene(scene) + contents_hash(scene));
}

}  // namespace tyndall
