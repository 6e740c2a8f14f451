#include "app/cli/verify.h"
#include "app/text/progress.h"
#include "app/text/values.h"
#include "core/scene/json_read.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

namespace tyndall {
namespace {

const std::string& text_at(const JsonObject& object, const Place& at, const char* key, const char* what) {
  return read_as<std::string>(member_at(object, at, key, what), {at, key}, what);
}

const JsonArray& list_at(const JsonObject& object, const Place& at, const char* key, const char* what) {
  return read_as<JsonArray>(member_at(object, at, key, what), {at, key}, what);
}

/// A switch that is off where it is not given.
bool flag_of(const JsonObject& object, const Place& at, const char* key, const char* what) {
  const JsonValue* json = find(object, key);
  if (json && !std::holds_alternative<bool>(json->value)) fail({at, key}, describe(*json), what);
  return json && std::get<bool>(json->value);
}

/// Appends what is under "set".
void read_overrides(const JsonObject& object, const Place& at, std::vector<Override>& out) {
  const JsonValue* json = find(object, "set");
  if (!json) return;
  const Place here{at, "set"};
  const char* expected = "overrides of the scene, such as { \"/camera/vfov\": 20 }";
  for (const JsonMember& member : read_as<JsonObject>(*json, here, expected)) {
    if (!member.key.starts_with('/')) fail({here, member.key}, "no JSON pointer", expected);
    out.push_back({member.key, print_json(member.value)});
  }
}

/// One case of a group, which is given as a case without its own values.
VerifyCase read_case(const JsonValue& json, const Place& at, const VerifyCase& group) {
  const JsonObject& object = read_as<JsonObject>(json, at, "a case: { \"name\", \"set\", \"expected\" }");
  allow_keys(object, at, {"name", "set", "expected", "source"});
  VerifyCase out = group;
  out.name += "/" + text_at(object, at, "name", "the case's name");
  read_overrides(object, at, out.overrides);
  const Field expected{"expected", &VerifyCase::expected, any_number(), Slider{}, "", "mean radiance", true};
  read_field(object, at, expected, out);
  if (find(object, "source")) out.source = text_at(object, at, "source", "where the expected number is from");
  return out;
}

void read_group(const JsonValue& json, const Place& at, const std::filesystem::path& folder,
                std::vector<VerifyCase>& out) {
  const JsonObject& object = read_as<JsonObject>(json, at, "a group of cases");
  allow_keys(object, at, {"name", "scene", "source", "set", "light_sampling", "chains", "cases"});
  VerifyCase group;
  group.name = text_at(object, at, "name", "the group's name");
  group.scene = folder / text_at(object, at, "scene", "the name of a scene file beside this one");
  group.source = text_at(object, at, "source", "where the expected numbers are from");
  group.requires_light_sampling =
      flag_of(object, at, "light_sampling", "true if chance alone does not find the lights, else false");
  group.requires_specular_paths =
      flag_of(object, at, "chains", "true if exact chains alone find the light, else false");
  read_overrides(object, at, group.overrides);
  const JsonArray& list = list_at(object, at, "cases", "the group's cases");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place cases{at, "cases"};
    out.push_back(read_case(list[i], {cases, i}, group));
    const auto same_name = [&](const VerifyCase& other) { return other.name == out.back().name; };
    if (std::find_if(out.begin(), out.end() - 1, same_name) != out.end() - 1)
      fail({cases, i}, in_quotes(out.back().name) + " twice", "each name once");
  }
}

std::vector<VerifyCase> read_table(std::string_view text, const std::filesystem::path& folder) {
  const JsonDocument json = parse_json(text);
  const Place top;
  const JsonObject& object = read_as<JsonObject>(json.root, top, "{ \"groups\": [ … ] }");
  allow_keys(object, top, {"groups"});
  const JsonArray& groups = list_at(object, top, "groups", "the groups of cases");
  std::vector<VerifyCase> cases;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Place place{top, "groups"};
    read_group(groups[i], {place, i}, folder, cases);
  }
  return cases;
}

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

std::vector<VerifyCase> read_verify_cases(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw SceneError(file.string(), "a file that cannot be read",
                     "the table of cases (TYNDALL_ASSETS names the folder that has verify/)");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    return read_table(text, file.parent_path());
  } catch (const ParseError& error) {
    throw SceneError(file.string(), error.where, error.found, error.expected);
  }
}

std::vector<VerifyCase> chosen_cases(const std::vector<VerifyCase>& cases, const std::vector<std::string>& names) {
  const auto begins = [](const VerifyCase& c, const std::string& name) { return c.name.starts_with(name); };
  for (const std::string& name : names)
    if (std::none_of(cases.begin(), cases.end(), [&](const VerifyCase& c) { return begins(c, name); })) {
      std::set<std::string> known;  // groups and cases
      for (const VerifyCase& c : cases) known.insert({c.name, c.name.substr(0, c.name.find('/'))});
      const std::string hint = did_you_mean(name, {known.begin(), known.end()});
      throw UsageError("found no case " + in_quotes(name) + hint + ", expected the beginning of a case's name");
    }
  std::vector<VerifyCase> chosen;
  for (const VerifyCase& c : cases)
    if (names.empty() || std::any_of(names.begin(), names.end(), [&](const auto& name) { return begins(c, name); }))
      chosen.push_back(c);
  return chosen;
}

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
