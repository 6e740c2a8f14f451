#include "app/cli/pictures.h"
#include "app/files/memory.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/files/film_files.h"
#include "core/render/clean_film.h"

namespace tyndall {
namespace {

/// Writes the film's files and returns the exit code. Layers (albedo, normal, depth) are not written: such an EXR has
/// none.
int write(const CommandRequest& command, const Film& film, const Scene& scene, const FilmLabel& label,
          const CleanOfFilm* clean) {
  const auto embedded = [&](const std::filesystem::path& file) {
    return Embedded{embedded_scene(scene, ".", film, file), clean ? clean_stats_text(film, clean->picture, 0) : "",
                    label};
  };
  const LinearImage image{film.region.width(), film.region.height(), resolve(film)};
  const auto problems = write_images(
      {film, image, scene.display, embedded, {}, clean ? &clean->picture : nullptr, command.form}, command.outputs);
  if (const std::string uneven = uneven_text(scene, totals(film)); !uneven.empty()) complain(uneven);
  for (const std::string& problem : problems) complain(problem);
  return problems.empty() ? 0 : output_failed;
}

/// What is known of the films before they are read themselves.
struct Parts {
  std::vector<FilmPart> frames{};
  Scene scene{};
  FilmLabel label{};
  FilmLabel expected{};  ///< what labels of parts must agree with: of the first one that says its version
  std::string name{};    ///< of that part
  std::string remark{};  ///< of the first part that has one
};

/// Throws UsageError unless the part is of the same scene, settings and version as those before.
void check_part(const Parts& parts, const StoredFilm& part) {
  const std::string& name = part.part.name;
  if (part.scene.render.adaptive)
    refuse("{}: found an adaptive render, expected a range of samples that every pixel has", name);
  if (parts.frames.empty()) return;
  const auto other = differing_samples(part.scene, part.label, parts.scene, parts.expected);
  if (other) refuse("{}: found {}, expected {} as in {}", name, other->found, other->expected, parts.name);
}

Parts read_parts(const std::vector<std::filesystem::path>& files, bool are_added) {
  Parts parts;
  for (const auto& file : files) {
    StoredFilm part = read_stored_frame(file);
    if (are_added) check_part(parts, part);
    parts.label = parts.frames.empty() ? part.label : merged_label(parts.label, part.label);
    if (parts.frames.empty()) parts.scene = part.scene;
    if (parts.expected.version.empty()) parts.expected = part.label, parts.name = part.part.name;
    parts.expected.isa.clear();  // those of several instruction sets are added
    if (parts.remark.empty()) parts.remark = part.remark;
    parts.frames.push_back(std::move(part.part));
  }
  return parts;
}

/// Makes one film of the files, filters it if that is asked for, and writes both. are_added: as ranges of samples.
int make_one(const CommandRequest& command, const std::vector<std::filesystem::path>& files, bool are_added) {
  check_image_names(command.outputs, command.form, command.stats);
  find_kernels(command.isa);
  const std::vector<Output> outputs = outputs_of(command.outputs, command.stats);
  check_outputs(outputs, files);
  check_can_write(outputs);
  const Parts parts = read_parts(files, are_added);
  const bool is_filtered = command.clean || !are_added;
  check_memory({.width = parts.frames.front().film.region.width(),
                .height = parts.frames.front().film.region.height(),
                .place = parts.frames.front().name,
                .emission = has_lights(parts.scene),
                .clean = is_filtered,
                .parts = files.size() > 1,
                .files = command.outputs,
                .form = command.form},
               free_memory());
  const auto read = [&](std::size_t part) { return read_film_alone(files[part]); };
  const Film film = are_added ? merge(parts.frames, read) : read(0);
  if (are_added && parts.label.isa.starts_with("several"))
    complain("the parts are of instruction sets that differ in a few bits (" + parts.label.isa +
             "); the sum is as right as each, but no render on one machine gives its bits");
  if (!parts.remark.empty() && (is_filtered || parts.label.contents.empty())) complain(parts.remark);
  std::optional<CleanOfFilm> clean;
  if (is_filtered) clean = clean_view(film, parts.scene, files.front().string(), command.threads, command.isa);
  const int code = write(command, film, parts.scene, parts.label, clean ? &*clean : nullptr);
  if (!are_added && is_doubtful(clean->picture, totals(film).min_taken))
    complain(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (!command.stats.empty())
    write_text_or_rescue(command.stats, clean_stats_text(film, clean->picture, clean->seconds));
  return code;
}

}  // namespace

int run_merge(const CommandRequest& command) {
  return make_one(command, {command.operands.begin(), command.operands.end()}, true);
}

int run_denoise(const CommandRequest& command) { return make_one(command, {command.image}, false); }

}  // namespace tyndall
