#include "app/comparison/baseline.h"
#include "app/files/outputs.h"
#include "app/report/heat_map.h"
#include "app/text/markup.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"
#include "core/image/tonemap.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tyndall {
namespace {

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

std::string row(const char* name, double value, const std::optional<double>& limit) {
  const char* bad = limit && !(value <= *limit) ? " class=\"bad\"" : "";
  return fmt::format("<tr{}><th>{}</th><td>{:.6g}</td><td>{}</td></tr>\n", bad, name, value,
                     limit ? fmt::format("{:.6g}", *limit) : "–");
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
  if (picture.limits.z) compare += fmt::format(" --max-z {:g}", *picture.limits.z);
  if (picture.limits.flip) compare += fmt::format(" --max-flip {:g}", *picture.limits.flip);
  if (picture.limits.rel_mse) compare += fmt::format(" --max-relmse {:g}", *picture.limits.rel_mse);
  if (picture.limits.rmse) compare += fmt::format(" --max-rmse {:g}", *picture.limits.rmse);
  return text + command_line("Compared:", compare);
}

std::string pictures_of(const CheckedPicture& picture, PpmCurve ppm) {
  const Comparison& c = *picture.comparison;
  const LinearImage flip = heat_colours(c.flip_map, c.width, c.height);
  const PicturePair pair = read_pair(picture.image, picture.reference, ppm);
  return fmt::format(
      "<div class=\"pair\"><figure><div class=\"slide\" tabindex=\"0\" role=\"slider\" aria-label=\"divider\" "
      "aria-valuemin=\"0\" aria-valuemax=\"100\" aria-valuenow=\"50\">"
      "<img alt=\"baseline\" src=\"{}\"><img alt=\"rendered\" class=\"top\" src=\"{}\"><span "
      "class=\"bar\"></span></div>"
      "<figcaption>left of the divider: rendered; right: baseline (pointer, or ← → Home End)</figcaption></figure>\n"
      "<figure><img alt=\"FLIP\" src=\"{}\"><div class=\"scale\"></div><div class=\"marks\"><span>0</span>"
      "<span>0.5</span><span>1</span></div><figcaption>FLIP of each pixel</figcaption></figure></div>\n",
      data_of(pair.reference), data_of(pair.image), data_of(flip));
}

/// The rows of the noise, of what was tested.
std::string noise_rows(const NoiseScores& s, const std::optional<double>& limit) {
  std::string text = row("z of the means", *std::max_element(s.mean_z.begin(), s.mean_z.end()), limit) +
                     row("z of the blocks", s.block_z, limit);
  if (s.compares_outliers) text += row("z of outliers", s.outlier_z, limit);
  return text +
         fmt::format("<tr><th>blocks: cannot tell</th><td>{} of {}</td><td>–</td></tr>\n", s.unclear_blocks, s.blocks);
}

std::string table_of(const CheckedPicture& picture) {
  const Comparison& c = *picture.comparison;
  std::string text = "<table><tr><th></th><th>measured</th><th>at most</th></tr>\n";
  if (c.noise) text += noise_rows(*c.noise, picture.limits.z);
  text += row("FLIP", c.flip, picture.limits.flip) + row("relMSE", c.error.rel_mse, picture.limits.rel_mse) +
          row("RMSE", c.error.rmse, picture.limits.rmse) + row("PSNR (dB)", c.error.psnr, {});
  if (c.outside.values > 0) {
    const bool looked_at = picture.limits == usual_tolerance;
    text += row("relMSE outside [0, 1]", c.outside.rel_mse, looked_at ? std::optional(usual_outside) : std::nullopt);
  }
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

void write_html_report(const std::filesystem::path& file, const std::vector<CheckedPicture>& pictures, PpmCurve ppm) {
  std::size_t failed = 0;
  for (const CheckedPicture& picture : pictures) failed += !picture.failures.empty();
  std::string rows, sections;
  std::size_t number = 0;
  for (const bool good : {false, true})  // failures first
    for (const CheckedPicture& picture : pictures) {
      if (picture.failures.empty() != good) continue;
      rows += summary_row(picture, ++number);
      sections += section(picture, number, ppm);
    }
  const std::string sentence =
      fmt::format("{} of {} pictures look like their baseline", pictures.size() - failed, pictures.size());
  write_text_or_rescue(
      file, from_template("report.html",
                          {{"stops", css_stops()}, {"sentence", sentence}, {"rows", rows}, {"sections", sections}}));
}

std::string junit_report(const std::vector<CheckedPicture>& pictures) {
  std::size_t failed = 0;
  double seconds = 0;
  std::string cases;
  for (const CheckedPicture& picture : pictures) {
    seconds += picture.seconds;
    cases += fmt::format("  <testcase classname=\"pictures\" name=\"{}\" time=\"{:.3f}\"", in_xml(picture.name),
                         picture.seconds);
    if (picture.failures.empty()) {
      cases += "/>\n";
      continue;
    }
    ++failed;
    cases += ">\n    <failure message=\"" + in_xml(joined(picture.failures, "; ")) + "\"/>\n  </testcase>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"tyndall compare\" tests=\"{}\" failures=\"{}\" "
      "errors=\"0\" time=\"{:.3f}\">\n{}</testsuite>\n",
      pictures.size(), failed, seconds, cases);
}

}  // namespace tyndall
