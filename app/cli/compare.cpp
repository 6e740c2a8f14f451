#include "app/check/check.h"
#include "app/cli/requests.h"
#include "app/report/heat_map.h"
#include "app/text/standard_streams.h"
#include "core/accuracy/error.h"
#include "core/base/text.h"
#include "core/system/process.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace tyndall {
namespace {

/// If both are EXR files with films: scores that tell whether they differ by more than their noise; else no blocks.
BlockScores compare_films(const CommandRequest& command) {
  if (!is_exr(command.image) || !is_exr(command.reference)) return {};
  const auto image = read_film(command.image), reference = read_film(command.reference);
  return image && reference ? block_scores(*image, *reference) : BlockScores{};
}

/// The picture against a scene; nothing if the reference is a picture.
std::optional<Check> check_against_scene(const CommandRequest& command) {
  if (!names_scene(command.reference.string())) {
    const ProgramSources& sources = command.scene.program.sources;
    const bool of_scene = command.seconds || !command.scene.overrides.empty() || !sources.include_folders.empty() ||
                          !sources.files.empty();
    if (of_scene) refuse("--time, --set, -I and further files need a scene in place of REFERENCE");
    return {};
  }
  if (command.baseline.limits.z)
    refuse(
        "--max-z needs two pictures that know their noise; a scene in place of REFERENCE is compared within the noise "
        "without it");
  CheckRequest request{command.image, command.baseline.ppm, command.scene, {}, {}};
  request.options.seconds = command.seconds.value_or(request.options.seconds);
  ProgressReport report(is_terminal(standard_error) ? ProgressStyle::automatic : ProgressStyle::none);
  request.progress = [&](const std::string& stage, double seconds) {
    report.show(seconds, std::min(1.0, seconds / request.options.seconds), stage);
    return true;
  };
  return check_picture(request);
}

using Json = nlohmann::ordered_json;

/// The numbers that the JSON and the table both have, with what the table says of them.
struct Score {
  const char *key, *name, *note;
  double value;
};
std::vector<Score> scores_of(const Comparison& c) {
  return {{"mse", "MSE", "", c.error.mse},
          {"rmse", "RMSE", "", c.error.rmse},
          {"relmse", "relMSE", "depends on the unit of radiance", c.error.rel_mse},
          {"psnr", "PSNR", "dB, sRGB", c.error.psnr},  // infinite for equal images: null
          {"flip", "FLIP", "mean, 67 pixels a degree, sRGB", c.flip}};
}

std::string json_text(const Comparison& c, const BlockScores& blocks, const Findings* verdict) {
  const auto channels = [](Vec3d v) { return Json{v.x, v.y, v.z}; };
  Json json{{"width", c.width}, {"height", c.height}};
  for (const Score& score : scores_of(c)) json[score.key] = score.value;
  json["mean_image"] = channels(c.error.mean_image);
  json["mean_reference"] = channels(c.error.mean_reference);
  json["pixels"] = {{"compared", c.flip_map.size()}, {"image", c.image_pixels}, {"reference", c.reference_pixels}};
  if (blocks.blocks > 0)
    json["blocks"] = {{"count", blocks.blocks},
                      {"mean_square_z", blocks.mean_square},
                      {"worst_z", blocks.worst},
                      {"limit", blocks.maximum},
                      {"only_noise", blocks.noise()}};
  if (const auto& s = c.noise)
    json["noise"] = {{"z", s->z},
                     {"mean_z", s->mean_z},
                     {"difference", s->difference},
                     {"error", s->error},
                     {"block_z", s->block_z},
                     {"outlier_z", s->outlier_z},
                     {"blocks", s->blocks},
                     {"lit_blocks", s->lit_blocks},
                     {"cannot_tell", s->unclear_blocks},
                     {"outliers", s->outliers},
                     {"explained_outliers", s->explained_outliers}};
  json["not_finite"] = c.not_finite;
  if (verdict) json["verdict"] = verdict_json(*verdict);
  return json.dump(2) + "\n";
}

std::string table(const Comparison& c, const BlockScores& b) {
  const std::string overlap = overlap_text(c);
  std::string text = overlap.empty() ? "" : "pixels   " + overlap + "\n";
  for (const Score& score : scores_of(c)) {
    text += fmt::format("{:<8} {:<13.6g} {}", score.name, score.value, score.note);
    text = text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }
  if (b.blocks > 0)
    text +=
        fmt::format("blocks   mean z^2 {:.3g} in {} blocks of 16x16 (up to {:.3g} is noise), worst |z| {:.3g}: {}\n",
                    b.mean_square, b.blocks, b.maximum, b.worst, b.noise() ? "only noise" : "more than noise");
  if (c.noise) text += "noise    " + noise_text(*c.noise) + "\n";
  text += "mean     image         reference\n";
  const Vec3d x = c.error.mean_image, y = c.error.mean_reference;
  const std::tuple<const char*, double, double> channels[] = {
      {"red", x.x, y.x}, {"green", x.y, y.y}, {"blue", x.z, y.z}};
  for (const auto& [name, image, reference] : channels)
    text += fmt::format("  {:<6} {:<13.6g} {:.6g}\n", name, image, reference);
  return text;
}

/// A line for each picture, and the reports. Returns the exit code.
int compare_with_baseline(const CommandRequest& command) {
  std::vector<std::filesystem::path> inputs;
  for (const auto& image : command.baseline.images) inputs.push_back(picture_name(image).file);
  std::vector<Output> outputs{{"--report", command.report}, {"--junit", command.junit}};
  if (!command.report.empty()) outputs.push_back({"--report", numbers_beside(command.report)});
  check_outputs(outputs, inputs);
  check_can_write(outputs);
  if (command.update) {
    const NamedPictures kept = update_baseline(command.baseline);
    std::string text;
    for (const auto& [name, file] : kept.files) text += all_printable(name) + "  kept\n";
    for (const std::string& note : kept.notes) complain(note);
    write_standard_output(text);
    return 0;
  }
  const BaselineCheck checked = check_baseline(command.baseline);
  const std::vector<CheckedPicture>& pictures = checked.pictures;
  for (const std::string& note : checked.notes) complain(note);
  std::string text;
  bool good = true;
  for (const CheckedPicture& picture : pictures) {
    const auto& c = picture.comparison;
    text += fmt::format("{:<6} {}", picture.failures.empty() ? "ok" : "FAILED", all_printable(picture.name));
    if (c) text += fmt::format("  FLIP {:.4g}  relMSE {:.4g}  RMSE {:.4g}", c->flip, c->error.rel_mse, c->error.rmse);
    if (c && c->noise) text += "  noise: " + noise_text(*c->noise);
    const std::string overlap = c ? overlap_text(*c) : "";
    text += (overlap.empty() ? "" : "  pixels: " + overlap) + "\n";
    if (c)
      for (const std::string& remark : c->remarks) complain(remark);
    for (const std::string& failure : picture.failures) complain(picture.name + ": " + failure);
    good = good && picture.failures.empty();
  }
  bool whole = true;
  const auto write = [&whole](const auto& output) { whole = written_or_told(output) && whole; };
  if (!command.report.empty()) write([&] { write_html_report(command.report, pictures, command.baseline.ppm); });
  if (!command.junit.empty()) write([&] { write_text_or_rescue(command.junit, junit_report(pictures)); });
  write([&text] { write_standard_output(text); });
  if (!whole) return output_failed;
  return good ? 0 : 1;
}

}  // namespace

int run_compare(const CommandRequest& command) {
  if (!command.baseline.folder.empty()) return compare_with_baseline(command);
  check_outputs({{"--heatmap", command.heatmap}},
                {picture_name(command.image).file, picture_name(command.reference).file});
  if (!command.heatmap.empty()) check_can_write(command.heatmap);
  const std::optional<Check> check = check_against_scene(command);
  const Comparison comparison = check ? check->comparison
                                      : compare_images(command.image, command.reference, command.baseline.ppm,
                                                       command.baseline.limits.z.has_value());
  check_gamma2(command.baseline.ppm, comparison.has_ppm);
  for (const std::string& remark : comparison.remarks) complain(remark);
  const BlockScores blocks = check ? BlockScores{} : compare_films(command);
  const auto write_heat_map = [&comparison](const std::filesystem::path& file) {
    write_png(file, heat_map(comparison.flip_map, comparison.width, comparison.height), 0, ToneMap::srgb, {});
  };
  bool whole = command.heatmap.empty() || written_or_told([&] { write_or_rescue(command.heatmap, write_heat_map); });
  const std::string text = command.json ? json_text(comparison, blocks, check ? &check->verdict : nullptr)
                                        : table(comparison, blocks) + (check ? verdict_text(check->verdict) : "");
  whole = written_or_told([&text] { write_standard_output(text); }) && whole;
  const std::vector<std::string> failures = too_large(comparison, command.baseline.limits);
  for (const std::string& failure : failures) complain("check failed: " + failure);
  if (!whole) return output_failed;
  return failures.empty() ? 0 : 1;
}

}  // namespace tyndall
