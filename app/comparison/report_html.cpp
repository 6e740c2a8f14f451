#include "app/comparison/baseline.h"
#include "app/comparison/pair.h"
#include "app/files/outputs.h"
#include "app/report/heat_map.h"
#include "app/text/markup.h"
#include "core/base/text.h"
#include "core/image/image_io.h"
#include "core/image/image_io_file.h"

#include <fmt/core.h>

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

std::string limit_text(const std::optional<double>& limit) { return limit ? fmt::format("{:.6g}", *limit) : "–"; }

std::string row(const char* name, double value, const std::optional<double>& limit) {
  const char* bad = limit && !(value <= *limit) ? " class=\"bad\"" : "";
  return fmt::format("<tr{}><th>{}</th><td>{:.6g}</td><td>{}</td></tr>\n", bad, name, value, limit_text(limit));
}

std::string pictures_of(const CheckedPicture& picture, PpmCurve ppm) {
  const Comparison& c = *picture.comparison;
  const LinearImage flip = heat_map(c.flip_map, c.width, c.height);
  const PicturePair pair = read_pair(picture.image, picture.reference, ppm);
  return fmt::format(
      "<div class=\"pair\"><figure><div class=\"slide\" style=\"max-width:{0}px\">"
      "<img alt=\"baseline\" src=\"{1}\"><img alt=\"rendered\" class=\"top\" src=\"{2}\">"
      "<span class=\"bar\"></span></div>"
      "<input type=\"range\" min=\"0\" max=\"100\" value=\"50\" aria-label=\"divider\" "
      "style=\"max-width:max({0}px,8rem)\">"
      "<figcaption>left of the divider: rendered; right: baseline</figcaption></figure>\n"
      "<figure><img alt=\"FLIP\" src=\"{3}\"><figcaption>FLIP of each pixel</figcaption></figure></div>\n",
      c.width, data_of(pair.reference), data_of(pair.image), data_of(flip));
}

std::string section(const CheckedPicture& picture, PpmCurve ppm) {
  const bool good = picture.failures.empty();
  std::string text = fmt::format("<section class=\"{}\"><h2>{} <em>{}</em></h2>\n", good ? "good" : "failed",
                                 in_html(picture.name), good ? "passed" : "failed");
  for (const std::string& failure : picture.failures) text += "<p class=\"bad\">" + in_html(failure) + "</p>\n";
  if (!picture.comparison) return text + "</section>\n";
  const Comparison& c = *picture.comparison;
  text += "<table><tr><th></th><th>measured</th><th>at most</th></tr>\n" + row("FLIP", c.flip, picture.limits.flip) +
          row("relMSE", c.error.rel_mse, picture.limits.rel_mse) + row("RMSE", c.error.rmse, picture.limits.rmse) +
          row("PSNR (dB)", c.error.psnr, {});
  if (c.outside.values > 0) {
    const bool looked_at = picture.limits == usual_tolerance;
    text += row("relMSE outside [0, 1]", c.outside.rel_mse, looked_at ? std::optional(usual_outside) : std::nullopt);
  }
  text += "</table>\n";
  const std::string overlap = overlap_text(c);
  if (!overlap.empty()) text += "<p>Pixels: " + overlap + ".</p>\n";
  return text + pictures_of(picture, ppm) + "</section>\n";
}

constexpr char page_start[] = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Pictures against their baseline</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem; color: #1d2b3a; background: #f4f6f8 }
section { background: #fff; border-left: 6px solid #2e8b57; padding: 1rem 1.5rem; margin: 1.2rem 0; border-radius: 4px }
section.failed { border-color: #c0392b }
h2 em { font-size: 80%; font-style: normal; color: #66788a }
.bad, .bad th { color: #c0392b }
table { border-collapse: collapse; margin: .5rem 0 1rem }
th, td { text-align: right; padding: .15rem 1rem .15rem 0; font-variant-numeric: tabular-nums }
tr th:first-child { text-align: left }
.pair { display: flex; flex-wrap: wrap; gap: 1.5rem }
figure { margin: 0 }
.slide { position: relative; --at: 50%; line-height: 0 }
.slide .top { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--at)) 0 0) }
.bar { position: absolute; top: 0; bottom: 0; left: var(--at); width: 2px; margin-left: -1px; background: #fff }
img { max-width: 100% }
input { width: 100%; margin: .4rem 0 0 }
figcaption { color: #66788a; font-size: 90% }
</style></head><body>
)";
constexpr char page_end[] = R"(<script>
document.querySelectorAll('input[type=range]').forEach(function (input) {
  const slide = input.parentElement.querySelector('.slide');
  const move = function () { slide.style.setProperty('--at', input.value + '%'); };
  input.addEventListener('input', move);
  slide.addEventListener('pointermove', function (event) {
    const box = slide.getBoundingClientRect();
    input.value = 100 * (event.clientX - box.left) / box.width;
    move();
  });
});
</script>
</body></html>
)";

}  // namespace

void write_html_report(const std::filesystem::path& file, const std::vector<CheckedPicture>& pictures, PpmCurve ppm) {
  std::size_t failed = 0;
  for (const CheckedPicture& picture : pictures) failed += !picture.failures.empty();
  std::string text = page_start + fmt::format("<h1>{} of {} pictures look like their baseline</h1>\n",
                                              pictures.size() - failed, pictures.size());
  for (const bool good : {false, true})  // failures first
    for (const CheckedPicture& picture : pictures)
      if (picture.failures.empty() == good) text += section(picture, ppm);
  write_text_or_rescue(file, text + page_end);
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
