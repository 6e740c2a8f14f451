#include "app/cli/verify.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace tyndall::test::verify_report_test {

namespace {

Measured measured(double mean, double error, std::uint64_t rejected = 0) {
  Measured m;
  m.value = {mean, error};
  m.totals.samples = 1000;
  m.totals.rejected = rejected;
  return m;
}

VerifyRow row(const Measured& m, const std::string& name = "plate/a") {
  return judge({{name, "plate.json", {{"/camera", "{ \"vfov\": 20 }\n"}}, 0.5, "Fresnel"}, {}}, m, 1e-3);
}

/// A run whose z-scores are these.
VerifyRun run_of(const std::vector<double>& scores) {
  VerifyRun run;
  for (const double z : scores) run.rows.push_back(row(measured(0.5 + 4e-4 * z, 4e-4)));
  return run;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("verdicts: four standard errors, no rejected sample, a sharp measurement") {
  CHECK(row(measured(0.5015, 4e-4)).verdict == Verdict::ok);
  CHECK(row(measured(0.5017, 4e-4)).verdict == Verdict::fail);
  CHECK(row(measured(0.4983, 4e-4)).verdict == Verdict::fail);
  CHECK(row(measured(0.5, 0)).verdict == Verdict::ok);
  CHECK(row(measured(0.50001, 0)).verdict == Verdict::fail);
  CHECK(row(measured(0.5, 4e-4, 1)).verdict == Verdict::fail);
  CHECK(row(measured(0.5, 6e-4)).verdict == Verdict::vague);
  CHECK(row(measured(0.6, 6e-4)).verdict == Verdict::fail);
  CHECK(row(measured(std::nan(""), 4e-4)).verdict == Verdict::fail);
}

TEST_CASE("a run passes if all cases do and their z-scores are neither too large nor too small together") {
  CHECK(passed(run_of({0.5, -1, 1.5, 0.1, -0.7, 1, 0.9, -1.2})));
  CHECK_FALSE(passed(run_of({0.5, -1, 1.5, 0.1, -0.7, 1, 0.9, -5})));
  CHECK_FALSE(passed(run_of(std::vector<double>(50, 0.1))));  // each is fine
  CHECK_FALSE(passed(run_of(std::vector<double>(50, 2.0))));
  VerifyRun vague = run_of({0.5, -1});
  vague.rows.push_back(row(measured(0.5, 6e-4)));
  CHECK_FALSE(passed(vague));
  VerifyRun skipped = run_of({0.5, -1});
  skipped.rows.push_back({});
  CHECK(passed(skipped));
}

TEST_CASE("z-scores: only standard errors above the rounding count") {
  VerifyRun run = run_of({1, -1});
  run.rows.push_back(row(measured(0.5, 0)));
  run.rows.push_back({});
  const ZStatistic scores = z_statistic(run.rows);
  CHECK(scores.count == 2);
  CHECK(scores.mean_square == doctest::Approx(1).epsilon(1e-5).scale(0));
}

TEST_CASE("table: expected, from where, measured, error, z, truncated paths, verdict; what was rejected; a summary") {
  VerifyRun run = run_of({1, -1});
  run.rows.push_back(row(measured(0.6, 4e-4, 3), "plate/long-name"));
  run.rows[0].measured.totals.truncated = 77;
  const std::string text = verify_table(run);
  CHECK(has(text, "Fresnel\n  case             expected     measured     error           z truncated   verdict\n"));
  CHECK(has(text, "\n  plate/a          0.5          0.5004       0.0004       1.00        77   ok\n"));
  CHECK(has(text, "FAIL, 3 samples rejected\n"));
  CHECK(has(text, "3 cases, 2 ok, 1 FAIL; 3e+03 samples, 3 rejected"));
  CHECK(has(text, "z-scores of 3 cases: mean square "));
}

TEST_CASE("json: the same for machines") {
  VerifyRun run = run_of({1});
  run.rows.push_back({});
  const auto json = nlohmann::json::parse(verify_json(run));
  CHECK(json["cases"][0]["name"] == "plate/a");
  CHECK(json["cases"][0]["set"]["/camera"]["vfov"] == 20);
  CHECK(json["cases"][0]["z"].get<double>() == doctest::Approx(1).epsilon(1e-5).scale(0));
  CHECK(json["cases"][0]["verdict"] == "ok");
  CHECK(json["cases"][0]["source"] == "Fresnel");
  CHECK(json["cases"][1]["measured"].is_null());
  CHECK(json["cases"][1]["verdict"] == "skipped");
  CHECK(json["passed"] == true);
}

}  // namespace tyndall::test::verify_report_test
