#include "app/cli/commands.h"
#include "app/cli/render_setup.h"
#include "app/files/memory.h"
#include "app/files/outputs.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/estimate.h"
#include "core/files/film_files.h"
#include "core/files/stats.h"
#include "core/render/clean_film.h"

namespace tyndall {
namespace {

/// Writes the film's files and returns the exit code. Layers (albedo, normal, depth) are not written: such an EXR has
/// none.
int write(const Film& film, const Scene& scene, const FilmLabel& label, const std::vector<std::filesystem::path>& files,
          const ImageForm& form, const std::optional<CleanOfFilm>& clean) {
  const auto embedded = [&](const std::filesystem::path& file) {
    return Embedded{embedded_scene(scene, ".", film, file), clean ? clean_stats_text(film, clean->picture, 0) : "",
                    label};
  };
  const LinearImage image{film.region.width(), film.region.height(), resolve(film)};
  const auto problems =
      write_images({film, image, scene.display, embedded, {}, clean ? &clean->picture : nullptr, form}, files);
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
    throw UsageError(name + ": found an adaptive render, expected a range of samples that every pixel has");
  if (parts.frames.empty()) return;
  const auto other = differing_samples(part.scene, part.label, parts.scene, parts.expected);
  if (other)
    throw UsageError(name + ": found " + other->found + ", expected " + other->expected + " as in " + parts.name);
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

MemoryPlan memory_plan(const FilmPart& part, const Scene& scene, const std::vector<std::filesystem::path>& files,
                       const ImageForm& form) {
  MemoryPlan plan;
  plan.width = part.film.region.width(), plan.height = part.film.region.height();
  plan.place = part.name;
  plan.emission = has_lights(scene);
  plan.files = files;
  plan.form = form;
  return plan;
}

}  // namespace

int run_merge(const CommandRequest& command) {
  const std::vector<std::filesystem::path> files(command.operands.begin(), command.operands.end());
  check_image_names(command.outputs, command.form);
  check_outputs(outputs_of("--output", command.outputs), files);
  check_can_write(outputs_of("--output", command.outputs));
  const Parts parts = read_parts(files);
  MemoryPlan plan = memory_plan(parts.frames.front(), parts.scene, command.outputs, command.form);
  plan.parts = parts.frames.size() > 1;
  plan.clean = command.denoise;
  check_memory(plan, free_memory());
  const Film film = merge(parts.frames, [&](std::size_t part) { return read_film_alone(files[part]); });
  if (parts.label.isa.starts_with("several"))
    complain("the parts are of instruction sets that differ in a few bits (" + parts.label.isa +
             "); the sum is as right as each, but no render on one machine gives its bits");
  if (!parts.remark.empty() && (command.denoise || parts.label.contents.empty())) complain(parts.remark);
  std::optional<CleanOfFilm> clean;
  if (command.denoise) clean = clean_view(film, parts.scene, files.front().string());
  return write(film, parts.scene, parts.label, command.outputs, command.form, clean);
}

int run_denoise(const CommandRequest& command) {
  check_image_names(command.outputs, command.form, command.stats);
  find_kernels(command.isa);
  std::vector<Output> outputs = outputs_of("--output", command.outputs);
  outputs.push_back({"--stats", command.stats});
  check_outputs(outputs, {command.image});
  check_can_write(outputs);
  const StoredFilm stored = read_stored_frame(command.image);
  MemoryPlan plan = memory_plan(stored.part, stored.scene, command.outputs, command.form);
  plan.clean = true;
  check_memory(plan, free_memory());
  if (!stored.remark.empty()) complain(stored.remark);
  const Film film = read_film_alone(command.image);
  const CleanOfFilm clean = clean_view(film, stored.scene, command.image.string(), command.threads, command.isa);
  const int code = write(film, stored.scene, stored.label, command.outputs, command.form, clean);
  if (is_doubtful(clean.picture, totals(film).min_taken))
    complain(std::string(rare_bright_paths) + "; the error may be larger than estimated");
  const std::string stats = clean_stats_text(film, clean.picture, clean.seconds);
  if (command.stats == "-")
    write_standard_output(stats);
  else if (!command.stats.empty())
    write_text_or_rescue(command.stats, stats);
  return code;
}

}  // namespace tyndall
