#include "core/base/error.h"
#include "core/scene/load.h"
#include "core/system/processors.h"
#include "tests/bench/bench.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tyndall::bench {

Table::Table(const std::string& title, std::vector<std::string> headings) : headings_(std::move(headings)) {
  std::printf("\n%s\n", title.c_str());
  add(headings_);
}

void Table::add(const std::vector<std::string>& cells) const {
  std::printf("%-24s", cells[0].c_str());
  for (std::size_t i = 1; i < cells.size(); ++i)
    std::printf("  %*s", std::max(static_cast<int>(headings_[i].size()), 12), cells[i].c_str());
  std::printf("\n");
  std::fflush(stdout);
}

std::string cell(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return std::isfinite(value) ? text : "-";
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

int two_threads() { return std::min(thread_count().count, 2); }

Scene built_in(const std::string& name, int width, int height) {
  Scene scene = load_scene(name).scene;
  scene.width = width;
  scene.height = height;
  return scene;
}

namespace {

constexpr int wrong_result = 1, wrong_usage = 2, input_output_error = 3;

struct Part {
  const char* name;
  const char* about;
  void (*measure)(const Settings& settings);
};
constexpr Part parts[] = {
    {"accuracy", "seconds to relMSE 0.01, relMSE x spp; beside the program that --against names", measure_accuracy},
    {"closest", "closest hits a second among spheres, beside Embree's", measure_closest},
    {"clean", "milliseconds that the clean view of a film takes", measure_clean},
    {"approximations", "how far each approximation moves the mean of pictures; minutes", measure_approximations}};

/// Runs the wanted parts; answers the exit code.
int measure(const Settings& settings) {
  int code = 0;
  for (const Part& part : parts) {
    if (!settings.parts.empty() && std::count(settings.parts.begin(), settings.parts.end(), part.name) == 0) continue;
    try {
      part.measure(settings);
    } catch (const WrongResult& error) {
      std::fprintf(stderr, "tyndall_bench: %s: %s\n", part.name, error.what());
      code = wrong_result;
    }
  }
  return code;
}

int main(int argc, char** argv) {
  Settings settings;
  std::vector<std::string> names;
  std::string list = "Parts:\n";
  for (const Part& part : parts) {
    names.emplace_back(part.name);
    list += "  " + names.back() + std::string(16 - names.back().size(), ' ') + part.about + "\n";
  }
  CLI::App app("Measures how fast and how accurate Tyndall is on this machine.", "tyndall_bench");
  app.footer(list);
  app.add_option("PART", settings.parts, "what to measure; default: everything")->check(CLI::IsMember(names));
  app.add_flag("--quick", settings.quick, "shorter and less exact");
  app.add_option("--against", settings.against, "another program \"tyndall\", such as the last release")
      ->check(CLI::ExistingFile);
  try {
    app.parse(argc, argv);
    std::printf("Tyndall %s, %d cores\n", TYNDALL_VERSION, thread_count().count);
    return measure(settings);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : wrong_usage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tyndall_bench: %s\n", error.what());
    return input_output_error;
  }
}

}  // namespace
}  // namespace tyndall::bench

int main(int argc, char** argv) { return tyndall::bench::main(argc, argv); }
