#include "app/curves/curve.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace tyndall::test::convergence_test {

namespace {

void run(Convergence& runs, std::uint64_t edit, const std::string& method, double seconds) {
  for (double s = 0.1; s <= seconds; s *= 1.2) runs.add(edit, method, {s, 0.01 / s});
}

/// Runs of three seconds, one after the other.
Convergence runs_of(std::initializer_list<const char*> methods) {
  Convergence runs;
  for (const char* method : methods) run(runs, runs.current().edit + 1, method, 3);
  return runs;
}

}  // namespace

TEST_CASE("runs that lasted for a while are kept, the short ones of a drag are not") {
  Convergence runs = runs_of({"path · random"});
  for (std::uint64_t edit = 2; edit < 50; ++edit) run(runs, edit, "mis · sobol", 0.3);
  run(runs, 50, "mis · sobol", 3);
  REQUIRE(runs.earlier().size() == 1);
  CHECK(runs.earlier()[0].method == "path · random");
  CHECK(runs.current().edit == 50);
}

TEST_CASE("a newer run takes the place of the one of its method; of many methods a few stay") {
  const Convergence runs = runs_of({"mis", "path", "mis", "nee"});
  REQUIRE(runs.earlier().size() == 2);
  CHECK(runs.earlier()[0].method == "mis");
  CHECK(runs.earlier()[0].edit == 3);
  CHECK(runs.earlier()[1].method == "path");
  Convergence many;
  for (std::uint64_t edit = 1; edit < 20; ++edit) run(many, edit, "method " + std::to_string(edit % 7), 2);
  CHECK(many.earlier().size() == Convergence::max_earlier);
  CHECK(many.earlier().back().edit == 18);
  for (std::uint64_t edit = 20; edit < 24; ++edit) run(many, edit, "same", 2);
  CHECK(std::count_if(many.earlier().begin(), many.earlier().end(),
                      [](const auto& one) { return one.method == "same"; }) == 1);
}

TEST_CASE("many frames make few points, and the last frame always has one") {
  Convergence runs;
  for (int k = 1; k <= 100000; ++k) runs.add(1, "a", {k * 0.001, 1.0 / k});
  CHECK(runs.current().points.size() < 300);
  CHECK(runs.current().points.back().seconds == doctest::Approx(100));
}

TEST_CASE("errors that are unknown, or were not estimated anew, leave no point") {
  Convergence runs;
  runs.add(1, "a", {0.1, std::numeric_limits<double>::infinity()});
  runs.add(1, "a", {0.2, std::numeric_limits<double>::quiet_NaN()});
  runs.add(1, "a", {0.0, 0.5});
  CHECK(runs.current().points.empty());
  CHECK(runs.current().method == "a");
  for (int k = 1; k < 100; ++k) runs.add(1, "a", {0.1 * k, k < 50 ? 0.5 : 0.25});
  REQUIRE(runs.current().points.size() == 2);
  CHECK(runs.current().points[1].seconds == doctest::Approx(5));
}

TEST_CASE("the same picture at an earlier time, as a repeated filter gives it, leaves the curve as it is") {
  Convergence runs = runs_of({"a"});
  const std::size_t points = runs.current().points.size();
  ErrorPoint again = runs.current().points.back();
  again.seconds *= 0.99;
  runs.add(1, "a", again);
  CHECK(runs.current().points.size() == points);
  CHECK(runs.earlier().empty());
  runs.add(1, "a", {0.05, 1});  // starting over, which is a run of its own though the edit is the same
  CHECK(runs.current().points.size() == 1);
  CHECK(runs.earlier().size() == 1);
}

TEST_CASE("curves have names of their own: two of one method, and the halves of a split view") {
  const Convergence runs = runs_of({"mis", "path", "mis", "path"}), kept = runs_of({"nee"});
  const auto named = named_curves(runs, &kept);
  REQUIRE(named.size() == 4);
  CHECK(named[0].name == "mis");
  CHECK(named[1].name == "path before");
  CHECK(named[2].name == "A: nee");
  CHECK(named[2].curve == &kept.current());
  CHECK(named[3].name == "B: path");
  CHECK(named[3].role == NamedCurve::Role::current);
  CHECK(named_curves(runs, nullptr).back().name == "path");
}

TEST_CASE("methods are named by what differs from the file's") {
  RenderSettings file, settings;
  file.max_depth = settings.max_depth = 50;
  CHECK(method_of(settings, file) == "mis · sobol");
  settings.max_depth = 5;
  settings.seed = 3;
  settings.fresnel = FresnelKind::schlick;
  CHECK(method_of(settings, file) == "mis · sobol · schlick · depth 5 · seed 3");
}

}  // namespace tyndall::test::convergence_test
