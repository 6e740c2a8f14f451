#include "app/cli/verify.h"
#include "app/cli/pictures.h"
#include "app/text/standard_streams.h"
#include "core/base/seconds.h"
#include "core/base/thread_pool.h"
#include "core/scene/json_read.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

namespace tyndall {

static void read_value(const JsonValue& json, const Place& at, const Meaning&, std::string& out) {
  out = read_as<std::string>(json, at, "a text");
}

/// Appends the overrides.
static void read_value(const JsonValue& json, const Place& at, const Meaning&, std::vector<Override>& out) {
  const char* expected = "overrides of the scene, such as { \"/camera/vfov\": 20 }";
  for (const JsonMember& member : read_as<JsonObject>(json, at, expected)) {
    if (!member.key.starts_with('/')) fail({at, member.key}, "no JSON pointer", expected);
    out.push_back({member.key, print_json(member.value)});
  }
}

namespace {

using Json = nlohmann::ordered_json;

/// Reads a group, or a case, into `out`. more: keys of it beside those of fields().
const JsonObject& read_members(const JsonValue& json, const Place& at, std::initializer_list<const char*> keys,
                               std::initializer_list<std::string_view> more, VerifyCase& out) {
  const JsonObject& object = read_as<JsonObject>(json, at, "a group of cases, or a case");
  read_fields(object, at, fields_of<VerifyCase>(), more, out);
  for (const char* key : keys) member_at(object, at, key, key == std::string_view("expected") ? "a number" : "it");
  return object;
}

void read_group(const JsonValue& json, const Place& at, const std::filesystem::path& folder,
                std::vector<VerifyCase>& out) {
  VerifyCase group;
  const JsonObject& object = read_members(json, at, {"name", "scene", "source", "cases"}, {"cases"}, group);
  group.scene = (folder / group.scene).string();
  const Place cases{at, "cases"};
  const JsonArray& list = read_as<JsonArray>(*find(object, "cases"), cases, "the group's cases");
  for (std::size_t i = 0; i < list.size(); ++i) {
    VerifyCase one = group;
    read_members(list[i], {cases, i}, {"name", "expected"}, {}, one);
    one.name = group.name + "/" + one.name;
    if (std::ranges::count(out, one.name, &VerifyCase::name) > 0)
      fail({cases, i}, in_quotes(one.name) + " twice", "each name once");
    out.push_back(one);
  }
}

constexpr double max_z = 4;

std::string line_of(const VerifyRow& row, std::size_t name_width) {
  const std::string start = fmt::format("  {:<{}}", row.name, name_width + 2);
  if (row.verdict == "skipped")
    return start + fmt::format("{:<12.7g} {:<45} skipped\n", row.expected,
                               row.requires_specular_paths ? "needs chains" : "needs light sampling");
  const Measured& m = row.measured;
  std::string text = start + fmt::format("{:<12.7g} {:<12.7g} {:<9.2g} {:7.2f} {:9}   {}", row.expected, m.value.mean,
                                         m.value.error, row.z, m.totals.truncated, row.verdict);
  if (m.totals.rejected > 0) text += fmt::format(", {} samples rejected", m.totals.rejected);
  return text + "\n";
}

std::string sum_up(const VerifyRun& run) {
  const ZStatistic z = z_statistic(run.rows);
  std::uint64_t samples = 0, rejected = 0;
  for (const VerifyRow& row : run.rows)
    samples += row.measured.totals.samples, rejected += row.measured.totals.rejected;
  std::string text = std::to_string(run.rows.size()) + " cases";
  for (const char* verdict : {"ok", "FAIL", "vague", "skipped"})
    if (const auto n = std::ranges::count(run.rows, verdict, &VerifyRow::verdict))
      text += fmt::format(", {} {}", n, verdict);
  text +=
      fmt::format("; {:.3g} samples, {} rejected; {}\n", static_cast<double>(samples), rejected, duration(run.seconds));
  if (z.count == 0) return text;
  return text + fmt::format("z-scores of {} cases: mean square {:.2f}, expected 1 ({:.2f} to {:.2f}): {}\n", z.count,
                            z.mean_square, z.band.low, z.band.high, z.ok() ? "ok" : "FAIL");
}

Json json_of(const VerifyRow& row) {
  Json overrides = Json::object();
  for (const Override& o : row.overrides) overrides[o.pointer] = Json::parse(o.value);
  const auto number = [&row](double v) { return row.verdict == "skipped" ? Json() : Json(v); };
  return {{"name", row.name},
          {"scene", row.scene},
          {"set", overrides},
          {"expected", row.expected},
          {"source", row.source},
          {"integrator", name_of(row.method.integrator)},
          {"sampler", name_of(row.method.sampler)},
          {"fresnel", name_of(row.method.fresnel)},
          {"measured", number(row.measured.value.mean)},
          {"standard_error", number(row.measured.value.error)},
          {"z", number(row.z)},
          {"verdict", lower_case(row.verdict)},
          {"samples", row.measured.totals.samples},
          {"rejected_samples", row.measured.totals.rejected},
          {"truncated_paths", row.measured.totals.truncated},
          {"seconds", row.measured.seconds}};
}

/// A seed from a case's name, so that it stays the same when other cases are added. Fowler, Noll, Vo: The FNV
/// Non-Cryptographic Hash Algorithm.
std::uint32_t seed_of(const std::string& name) {
  std::uint32_t hash = 0x811c9dc5u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
  return hash;
}

/// A case's scene with the command's method.
Scene scene_of(const CommandRequest& command, const VerifyCase& what) {
  SceneRequest request = command.scene;
  request.what = what.scene;
  request.overrides = what.overrides;
  set(request.render, &RenderSettings::seed, seed_of(what.name) + max_rounds * command.scene.render.values.seed);
  return open_scene(request).scene;
}

/// Whether a method finds the light of a case only by rare chance.
bool is_out_of_reach(const VerifyCase& what, const RenderSettings& method) {
  if (what.requires_light_sampling && method.integrator == Integrator::path) return true;
  const bool solved = method.integrator == Integrator::mis && method.caustics == Caustics::chains &&
                      method.fresnel == FresnelKind::exact;
  return what.requires_specular_paths && !solved;
}

VerifyRun verify(const CommandRequest& command, const std::vector<VerifyCase>& cases, const SignalWatch& signals) {
  const auto start = Clock::now();
  ProgressReport report(command.progress);
  VerifyRun run;
  run.precision = command.thorough ? 1e-4 : 1e-3;
  run.isa = find_kernels(command.isa).isa;
  run.threads = ThreadPool(command.threads).size();
  for (const VerifyCase& what : cases) {
    const Scene scene = scene_of(command, what);
    VerifyRow row{what, scene.render};
    if (!is_out_of_reach(what, scene.render)) {
      const MeasureOptions options{command.threads, command.isa, run.precision * std::abs(what.expected),
                                   what.expected};
      const auto done = static_cast<double>(run.rows.size()), all = static_cast<double>(cases.size());
      const Measured measured = measure_mean(scene, options, [&](const RenderProgress&) {
        const double seconds = seconds_since(start);
        report.show(seconds, done / all,
                    fmt::format("{}/{} {}, {}", run.rows.size(), cases.size(), what.name, duration(seconds)));
        return signals.received() == 0;
      });
      if (measured.interrupted) break;
      row = judge(row, measured, run.precision);
    }
    run.rows.push_back(row);
  }
  run.seconds = seconds_since(start);
  run.interrupted = signals.received() != 0;
  report.finish(std::to_string(run.rows.size()) + " cases done, " + duration(run.seconds));
  return run;
}

}  // namespace

std::vector<VerifyCase> read_verify_cases(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw SceneError(file.string(), "a file that cannot be read",
                     "the table of cases (TYNDALL_ASSETS names the folder that has verify/)");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  try {
    const JsonDocument json = parse_json(text);
    const Place top, groups{top, "groups"};
    const JsonObject& object = read_as<JsonObject>(json.root, top, "{ \"groups\": [ … ] }");
    allow_keys(object, top, {"groups"});
    const auto& list = read_as<JsonArray>(member_at(object, top, "groups", "them"), groups, "the groups of cases");
    std::vector<VerifyCase> cases;
    for (std::size_t i = 0; i < list.size(); ++i) read_group(list[i], {groups, i}, file.parent_path(), cases);
    return cases;
  } catch (const ParseError& error) {
    throw SceneError(file.string(), error.where, error.found, error.expected);
  }
}

std::vector<VerifyCase> chosen_cases(std::vector<VerifyCase> cases, const std::vector<std::string>& names) {
  std::set<std::string> known;  // groups and cases
  for (const VerifyCase& c : cases) known.insert({c.name, c.name.substr(0, c.name.find('/'))});
  for (const std::string& name : names)
    if (std::ranges::none_of(known, [&](const std::string& one) { return one.starts_with(name); }))
      refuse("found no case {}{}, expected the beginning of a case's name", in_quotes(name),
             did_you_mean(name, {known.begin(), known.end()}));
  std::erase_if(cases, [&](const VerifyCase& c) {
    return !names.empty() && std::ranges::none_of(names, [&](const auto& name) { return c.name.starts_with(name); });
  });
  return cases;
}

VerifyRow judge(VerifyRow row, const Measured& measured, double precision) {
  row.measured = measured;
  row.z = z_score(measured.value, row.expected);
  const bool sharp = measured.value.error <= precision * std::abs(row.expected);
  const bool right = std::abs(row.z) <= max_z && measured.totals.rejected == 0;
  row.verdict = !right ? "FAIL" : sharp ? "ok" : "vague";
  return row;
}

ZStatistic z_statistic(const std::vector<VerifyRow>& rows) {
  ZStatistic scores;
  for (const VerifyRow& row : rows) {
    const double rounding = rounding_fraction * std::abs(row.expected);
    if (row.verdict == "skipped" || row.measured.value.error <= 10 * rounding) continue;
    scores.mean_square += row.z * row.z, ++scores.count;
  }
  if (scores.count == 0) return scores;
  scores.mean_square /= scores.count;
  scores.band = mean_square_band(scores.count);
  return scores;
}

bool passed(const VerifyRun& run) {
  const auto bad = [](const VerifyRow& row) { return row.verdict == "FAIL" || row.verdict == "vague"; };
  return std::ranges::none_of(run.rows, bad) && z_statistic(run.rows).ok();
}

std::string verify_table(const VerifyRun& run) {
  std::size_t width = 4;
  for (const VerifyRow& row : run.rows) width = std::max(width, row.name.size());
  std::string text, source;
  for (const VerifyRow& row : run.rows) {
    if (row.source != source) {
      source = row.source;
      text += (text.empty() ? "" : "\n") + source + "\n  case" + std::string(width - 2, ' ') +
              "expected     measured     error           z truncated   verdict\n";
    }
    text += line_of(row, width);
  }
  return text + "\n" + sum_up(run);
}

std::string verify_json(const VerifyRun& run) {
  Json cases = Json::array();
  for (const VerifyRow& row : run.rows) cases.push_back(json_of(row));
  const ZStatistic z = z_statistic(run.rows);
  const Json json{{"version", TYNDALL_VERSION},
                  {"isa", run.isa},
                  {"threads", run.threads},
                  {"precision", run.precision},
                  {"cases", cases},
                  {"z_count", z.count},
                  {"z_mean_square", z.mean_square},
                  {"z_mean_square_band", {z.band.low, z.band.high}},
                  {"interrupted", run.interrupted},
                  {"passed", passed(run)},
                  {"seconds", run.seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int run_verify(const CommandRequest& command) {
  const auto table = assets_folder() / "verify" / "cases.json";
  const std::vector<VerifyCase> cases = chosen_cases(read_verify_cases(table), command.operands);
  const SignalWatch signals;
  const VerifyRun run = verify(command, cases, signals);
  write_standard_output(command.json ? verify_json(run) : verify_table(run));
  if (run.interrupted) return 128 + signals.received();
  return passed(run) ? 0 : 1;
}

}  // namespace tyndall
