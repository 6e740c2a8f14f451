#include "app/cli/verify.h"

#include "app/text/progress.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tyndall {
namespace {

constexpr double max_z = 4;

int count(const VerifyRun& run, Verdict verdict) {
  return static_cast<int>(
      std::count_if(run.rows.begin(), run.rows.end(), [=](const VerifyRow& row) { return row.verdict == verdict; }));
}

std::string line_of(const VerifyRow& row, std::size_t name_width) {
  const std::string start = "  " + row.what.name + std::string(name_width + 2 - row.what.name.size(), ' ');
  if (row.verdict == Verdict::skipped)
    return start + fmt::format("{:<12.7g} {:<45} skipped\n", row.what.expected,
                               row.what.requires_specular_paths ? "needs chains" : "needs light sampling");
  const Measured& m = row.measured;
  std::string text = start + fmt::format("{:<12.7g} {:<12.7g} {:<9.2g} {:7.2f} {:9}   {}", row.what.expected,
                                         m.value.mean, m.value.error, row.z, m.totals.truncated, name_of(row.verdict));
  if (m.totals.rejected > 0) text += fmt::format(", {} samples rejected", m.totals.rejected);
  return text + "\n";
}

std::string sum_up(const VerifyRun& run) {
  const ZStatistic z = z_statistic(run.rows);
  std::uint64_t samples = 0, rejected = 0;
  for (const VerifyRow& row : run.rows)
    samples += row.measured.totals.samples, rejected += row.measured.totals.rejected;
  std::string text = std::to_string(run.rows.size()) + " cases";
  for (int i = 0; i < count_of<Verdict>(); ++i) {
    const auto verdict = static_cast<Verdict>(i);
    if (const int n = count(run, verdict)) text += fmt::format(", {} {}", n, name_of(verdict));
  }
  text +=
      fmt::format("; {:.3g} samples, {} rejected; {}\n", static_cast<double>(samples), rejected, duration(run.seconds));
  if (z.count == 0) return text;
  return text + fmt::format("z-scores of {} cases: mean square {:.2f}, expected 1 ({:.2f} to {:.2f}): {}\n", z.count,
                            z.mean_square, z.band.low, z.band.high, z.ok() ? "ok" : "FAIL");
}

nlohmann::ordered_json json_of(const VerifyRow& row) {
  nlohmann::ordered_json json;
  json["name"] = row.what.name;
  json["scene"] = row.what.scene.string();
  json["set"] = nlohmann::ordered_json::object();
  for (const Override& o : row.what.overrides) json["set"][o.pointer] = nlohmann::ordered_json::parse(o.value);
  json["expected"] = row.what.expected;
  json["source"] = row.what.source;
  json["integrator"] = name_of(row.method.integrator);
  json["sampler"] = name_of(row.method.sampler);
  json["fresnel"] = name_of(row.method.fresnel);
  const bool known = row.verdict != Verdict::skipped;
  const auto number = [known](double v) { return known && std::isfinite(v) ? nlohmann::ordered_json(v) : nullptr; };
  json["measured"] = number(row.measured.value.mean);
  json["standard_error"] = number(row.measured.value.error);
  json["z"] = number(row.z);
  json["verdict"] = row.verdict == Verdict::fail ? "fail" : name_of(row.verdict);
  json["samples"] = row.measured.totals.samples;
  json["rejected_samples"] = row.measured.totals.rejected;
  json["truncated_paths"] = row.measured.totals.truncated;
  json["seconds"] = row.measured.seconds;
  return json;
}

}  // namespace

VerifyRow judge(VerifyRow row, const Measured& measured, double precision) {
  row.measured = measured;
  row.z = z_score(measured.value, row.what.expected);
  const bool sharp = measured.value.error <= precision * std::abs(row.what.expected);
  const bool right = std::abs(row.z) <= max_z && measured.totals.rejected == 0;
  row.verdict = !right ? Verdict::fail : sharp ? Verdict::ok : Verdict::vague;
  return row;
}

ZStatistic z_statistic(const std::vector<VerifyRow>& rows) {
  ZStatistic scores;
  double sum = 0;
  for (const VerifyRow& row : rows) {
    const double rounding = rounding_fraction * std::abs(row.what.expected);
    if (row.verdict == Verdict::skipped || row.measured.value.error <= 10 * rounding) continue;
    sum += row.z * row.z;
    ++scores.count;
  }
  if (scores.count == 0) return scores;
  scores.mean_square = sum / scores.count;
  scores.band = mean_square_band(scores.count);
  return scores;
}

bool passed(const VerifyRun& run) {
  return count(run, Verdict::fail) == 0 && count(run, Verdict::vague) == 0 && z_statistic(run.rows).ok();
}

std::string verify_table(const VerifyRun& run) {
  std::size_t width = 4;
  for (const VerifyRow& row : run.rows) width = std::max(width, row.what.name.size());
  std::string text, source;
  for (const VerifyRow& row : run.rows) {
    if (row.what.source != source) {
      source = row.what.source;
      text += (text.empty() ? "" : "\n") + source + "\n  case" + std::string(width - 2, ' ') +
              "expected     measured     error           z truncated   verdict\n";
    }
    text += line_of(row, width);
  }
  return text + "\n" + sum_up(run);
}

std::string verify_json(const VerifyRun& run) {
  nlohmann::ordered_json json;
  json["version"] = TYNDALL_VERSION;
  json["isa"] = run.isa;
  json["threads"] = run.threads;
  json["precision"] = run.precision;
  json["cases"] = nlohmann::ordered_json::array();
  for (const VerifyRow& row : run.rows) json["cases"].push_back(json_of(row));
  const ZStatistic z = z_statistic(run.rows);
  json["z_count"] = z.count;
  json["z_mean_square"] = z.mean_square;
  json["z_mean_square_band"] = {z.band.low, z.band.high};
  json["interrupted"] = run.interrupted;
  json["passed"] = passed(run);
  json["seconds"] = run.seconds;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tyndall
