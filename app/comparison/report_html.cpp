#include "app/comparison/baseline.h"
#include "app/files/outputs.h"
#include "app/report/heat_map.h"
#include "app/text/markup.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

namespace tyndall {
namespace {

using Json = nlohmann::ordered_json;

/// RFC 4648, section 4.
std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k < bytes.size() + 1 ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// The picture within the page, as PNG.
std::string data_of(const LinearImage& image) {
  const std::vector<std::uint8_t> rgb = tone_map(image.rgb, 0, ToneMap::srgb);
  return "data:image/png;base64," + base64(encode_png(image.width, image.height, rgb.data()));
}

/// What was measured.
struct Row {
  const char *key, *name;  ///< for programs, and on the page
  double value;
  std::optional<double> limit{};
};

std::vector<Row> rows_of(const CheckedPicture& picture) {
  const Comparison& c = *picture.comparison;
  const Tolerance& limits = picture.limits;
  std::vector<Row> rows;
  if (c.noise) {
    rows = {{"mean_z", "z of the means", std::ranges::max(c.noise->mean_z), limits.z},
            {"block_z", "z of the blocks", c.noise->block_z, limits.z}};
    if (c.noise->compares_outliers) rows.push_back({"outlier_z", "z of outliers", c.noise->outlier_z, limits.z});
  }
  rows.insert(rows.end(), {{"flip", "FLIP", c.flip, limits.flip},
                           {"relmse", "relMSE", c.error.rel_mse, limits.rel_mse},
                           {"rmse", "RMSE", c.error.rmse, limits.rmse},
                           {"psnr", "PSNR (dB)", c.error.psnr}});
  if (c.outside.values > 0)
    rows.push_back({"relmse_outside", "relMSE outside [0, 1]", c.outside.rel_mse,
                    limits == usual_tolerance ? std::optional(usual_outside) : std::nullopt});
  return rows;
}

/// A line to copy.
std::string command_line(const char* what, const std::string& command) {
  return fmt::format("<p class=\"command\">{} <code>{}</code> <button type=\"button\">copy</button></p>\n", what,
                     in_html(command));
}

/// How the pictures are made again and compared; those that Tyndall did not make carry no scene.
std::string commands_of(const CheckedPicture& picture) {
  std::string text;
  const auto made = [&text](const char* what, const std::filesystem::path& name) {
    const std::filesystem::path file = picture_name(name).file;
    if (!read_embedded_scene(file)) return;
    const std::string again = file.stem().string() + "-again" + file.extension().string();
    text += command_line(what, "tyndall render " + in_shell(file.string()) + " -o " + in_shell(again));
  };
  made("The rendered picture again:", picture.image);
  made("The baseline again:", picture.reference);
  std::string compare =
      "tyndall compare " + in_shell(picture.image.string()) + " " + in_shell(picture.reference.string());
  for (const auto& [key, member] : tolerance_keys)
    if (picture.limits.*member)
      compare += fmt::format(" --max-{} {:g}", key + std::strlen("max_"), *(picture.limits.*member));
  return text + command_line("Compared:", compare);
}

std::string pictures_of(const CheckedPicture& picture, PpmCurve ppm) {
  const Comparison& c = *picture.comparison;
  const LinearImage flip = heat_map(c.flip_map, c.width, c.height, false);
  const PicturePair pair = read_pair(picture.image, picture.reference, ppm);
  return from_template("report_pair.html", {{"baseline", data_of(pair.reference.pixels)},
                                            {"rendered", data_of(pair.image.pixels)},
                                            {"flip", data_of(flip)}});
}

std::string table_of(const CheckedPicture& picture) {
  std::string text = "<table><tr><th></th><th>measured</th><th>at most</th></tr>\n";
  for (const Row& row : rows_of(picture))
    text += fmt::format("<tr{}><th>{}</th><td>{:.6g}</td><td>{}</td></tr>\n",
                        row.limit && !(row.value <= *row.limit) ? " class=\"bad\"" : "", row.name, row.value,
                        row.limit ? fmt::format("{:.6g}", *row.limit) : "–");
  if (const auto& noise = picture.comparison->noise)
    text += fmt::format("<tr><th>blocks: cannot tell</th><td>{} of {}</td><td>–</td></tr>\n", noise->unclear_blocks,
                        noise->blocks);
  return text + "</table>\n";
}

std::string section(const CheckedPicture& picture, std::size_t number, PpmCurve ppm) {
  const bool good = picture.failures.empty();
  std::string text = fmt::format("<section id=\"p{}\" class=\"{}\"><h2>{} <em>{}</em></h2>\n", number,
                                 good ? "good" : "failed", in_html(picture.name), good ? "passed" : "failed");
  for (const std::string& failure : picture.failures) text += "<p class=\"bad\">" + in_html(failure) + "</p>\n";
  if (!picture.comparison) return text + "</section>\n";
  const std::string overlap = overlap_text(*picture.comparison);
  text += pictures_of(picture, ppm) + table_of(picture);
  if (!overlap.empty()) text += "<p>Pixels: " + overlap + ".</p>\n";
  return text + commands_of(picture) + "</section>\n";
}

/// A row of the table at the top.
std::string summary_row(const CheckedPicture& picture, std::size_t number) {
  const bool good = picture.failures.empty();
  const auto& c = picture.comparison;
  const auto cell = [](double value) { return fmt::format("<td>{:.4g}</td>", value); };
  const std::string none = "<td>–</td>";
  return fmt::format("<tr class=\"{}\"><th><a href=\"#p{}\">{}</a></th><td>{}</td>", good ? "good" : "bad", number,
                     in_html(picture.name), good ? "passed" : "failed") +
         (c && c->noise ? cell(c->noise->z) : none) + (c ? cell(c->flip) + cell(c->error.rel_mse) : none + none) +
         "<td class=\"why\">" + (good ? "" : in_html(picture.failures.front())) + "</td></tr>\n";
}

/// The colours of a heat map as stops of a CSS gradient.
std::string css_stops() {
  std::string text;
  for (int i = 0; i <= 16; ++i) {
    const std::array<float, 3> colour = heat(static_cast<float>(i) / 16);
    const auto byte = [](float v) { return static_cast<int>(std::lround(255 * static_cast<double>(srgb_encode(v)))); };
    text += fmt::format("{}rgb({} {} {})", i == 0 ? "" : ", ", byte(colour[0]), byte(colour[1]), byte(colour[2]));
  }
  return text;
}

}  // namespace

/// Its numbers on the page, for programs.
static void to_json(Json& json, const CheckedPicture& picture) {
  Json failures = Json::array(), measured = Json::object(), limits = Json::object();
  for (const std::string& failure : picture.failures) failures.push_back(all_printable(failure));
  for (const Row& row : picture.comparison ? rows_of(picture) : std::vector<Row>{}) {
    measured[row.key] = row.value;  // null where it is not finite
    if (row.limit) limits[row.key] = *row.limit;
  }
  json = {{"name", all_printable(picture.name)},
          {"passed", picture.failures.empty()},
          {"failures", failures},
          {"measured", measured},
          {"limits", limits}};
}

std::filesystem::path numbers_beside(std::filesystem::path report) {
  report.replace_extension(".json");
  std::error_code error;  // what is no ordinary file is not read
  std::ifstream in(std::filesystem::is_regular_file(report, error) ? report : "");
  if (in && !Json::parse(in, nullptr, false).contains("pictures"))
    throw UsageError("--report: found " + in_quotes(report.string()) +
                     ", which holds no report's numbers, expected another name: they are written there");
  return report;
}

void write_html_report(const std::filesystem::path& file, const std::vector<CheckedPicture>& pictures, PpmCurve ppm) {
  const auto passes = [](const CheckedPicture& picture) { return picture.failures.empty(); };
  std::string rows, sections;
  std::size_t number = 0;
  for (const bool good : {false, true})  // failures first
    for (const CheckedPicture& picture : pictures) {
      if (passes(picture) != good) continue;
      rows += summary_row(picture, ++number);
      sections += section(picture, number, ppm);
    }
  const std::filesystem::path numbers = numbers_beside(file);
  const std::string sentence = fmt::format("{} of {} pictures look like their baseline",
                                           std::count_if(pictures.begin(), pictures.end(), passes), pictures.size());
  write_text_or_rescue(file, from_template("report.html", {{"stops", css_stops()},
                                                           {"sentence", sentence},
                                                           {"numbers", in_html(numbers.filename().string())},
                                                           {"rows", rows},
                                                           {"sections", sections}}));
  write_text_or_rescue(numbers, Json{{"pictures", pictures}}.dump(2) + "\n");
}

std::string junit_report(const std::vector<CheckedPicture>& pictures) {
  std::size_t failed = 0;
  double seconds = 0;
  std::string cases;
  for (const CheckedPicture& picture : pictures) {
    const bool good = picture.failures.empty();
    failed += good ? 0 : 1, seconds += picture.seconds;
    cases += fmt::format("  <testcase classname=\"pictures\" name=\"{}\" time=\"{:.3f}\"", in_xml(picture.name),
                         picture.seconds);
    cases +=
        good ? "/>\n" : ">\n    <failure message=\"" + in_xml(joined(picture.failures, "; ")) + "\"/>\n  </testcase>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"tyndall compare\" tests=\"{}\" failures=\"{}\" "
      "errors=\"0\" time=\"{:.3f}\">\n{}</testsuite>\n",
      pictures.size(), failed, seconds, cases);
}

}  // namespace tyndall
