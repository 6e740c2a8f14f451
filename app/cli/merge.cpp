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
  const std::string uneven = uneven_text(scene, totals(film));
  if (!uneven.empty()) complain(uneven);
  for (const std::string& problem : problems) complain(problem);
  return problems.empty() ? 0 : output_failed;
}

/// What merge finds before it reads the films themselves.
struct Parts {
  std::vector<FilmPart> frames;
  Scene scene;
  FilmLabel label;
  FilmLabel expected;  ///< what labels of parts must agree with: of the first one that says its version
  std::string name;    ///< of that part
  std::string remark;  ///< of the first part that has one
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

Parts read_parts(const std::vector<std::filesystem::path>& files) {
  Parts parts;
  for (const auto& file : files) {
    StoredFilm part = read_stored_frame(file);
    check_part(parts, part);
    parts.label = parts.frames.empty() ? part.label : merged_label(parts.label, part.label);
    if (parts.frames.empty()) parts.scene = part.scene;
    if (parts.expected.version.empty()) parts.expected = part.label, parts.name = part.part.name;
    parts.expected.isa.clear();  // those of several instruction sets are added
    if (parts.remark.empty()) parts.remark = part.remark;
    parts.frames.push_back(std::move(part.part));
  }
  return parts;
}

void check_memory(const CommandRequest& command, const FilmPart& part, const Scene& scene, bool parts, bool clean) {
  check_memory({.width = part.film.region.width(),
                .height = part.film.region.height(),
                .place = part.name,
                .emission = has_lights(scene),
                .clean = clean,
                .parts = parts,
                .files = command.outputs,
                .form = command.form},
               free_memory());
}

}  // namespace

int run_merge(const CommandRequest& command) {
  const std::vector<std::filesystem::path> files(command.operands.begin(), command.operands.end());
  check_image_names(command.outputs, command.form);
  const std::vector<Output> outputs = outputs_of(command.outputs);
  check_outputs(outputs, files);
  check_can_write(outputs);
  const Parts parts = read_parts(files);
  check_memory(command, parts.frames.front(), parts.scene, parts.frames.size() > 1, command.denoise);
  const Film film = merge(parts.frames, [&](std::size_t part) { return read_film_alone(files[part]); });
  if (parts.label.isa.starts_with("several"))
    complain("the parts are of instruction sets that differ in a few bits (" + parts.label.isa +
             "); the sum is as right as each, but no render on one machine gives its bits");
  if (!parts.remark.empty() && (command.denoise || parts.label.contents.empty())) complain(parts.remark);
  std::optional<CleanOfFilm> clean;
  if (command.denoise) clean = clean_view(film, parts.scene, files.front().string());
  return write(command, film, parts.scene, parts.label, clean ? &*clean : nullptr);
}

int run_denoise(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  find_kernels(command.isa);
  const std::vector<Output> outputs = outputs_of(command.outputs, command.stats);
  check_outputs(outputs, {command.image});
  check_can_write(outputs);
  const StoredFilm stored = read_stored_frame(command.image);
  check_memory(command, stored.part, stored.scene, false, true);
  if (!stored.remark.empty()) complain(stored.remark);
  const Film film = read_film_alone(command.image);
  const CleanOfFilm clean = clean_view(film, stored.scene, command.image.string(), command.threads, command.isa);
  const int code = write(command, film, stored.scene, stored.label, &clean);
  if (is_doubtful(clean.picture, totals(film).min_taken))
    complain(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  if (!command.stats.empty()) write_text_or_rescue(command.stats, clean_stats_text(film, clean.picture, clean.seconds));
  return code;
}

}  // namespace tyndall
