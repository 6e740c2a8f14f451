#include "core/base/error.h"
#include "tests/bench/machine.h"
#include "tests/bench/options.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>

namespace tyndall::bench {

const std::vector<Part>& parts() {
  static const std::vector<Part> list = {
      {"throughput", "samples and rays a second on one thread, by scene and instruction set", measure_throughput},
      {"accuracy", "seconds to relMSE 0.01 on two threads, and relMSE x spp", measure_accuracy},
      {"closest", "closest hits a second among spheres, beside Embree's", measure_closest},
      {"tree", "build time, memory and speed of trees over spheres", measure_tree},
      {"edits", "milliseconds from an edit to its picture, interactive renderer", measure_edits},
      {"clean", "milliseconds that the clean view of a film takes", measure_clean},
      {"approximations", "how far each approximation moves the mean of pictures; minutes", measure_approximations},
      {"start", "wall time of the smallest render as a process", measure_start},
      {"against", "speed and seconds to relMSE 0.01 beside the program that --against names, in pairs",
       measure_against},
  };
  return list;
}

namespace {

constexpr int wrong_result = 1, wrong_usage = 2, input_output_error = 3;

void complain(const std::string& text) { std::fprintf(stderr, "tyndall_bench: %s\n", text.c_str()); }

void print_machine(const Json& json) {
  std::printf("Tyndall %s, %s, %s, %d cores\n", json["version"].get<std::string>().c_str(),
              json["compiler"].get<std::string>().c_str(), json["processor"].get<std::string>().c_str(),
              json["cores"].get<int>());
}

/// Runs the wanted parts and puts their rows into json; answers the exit code.
int measure(const Settings& settings, Json& json) {
  int code = 0;
  for (const Part& part : parts()) {
    if (std::find(settings.parts.begin(), settings.parts.end(), part.name) == settings.parts.end()) continue;
    try {
      json["parts"][part.name] = part.measure(settings);
    } catch (const WrongResult& error) {
      complain(std::string(part.name) + ": " + error.what());
      code = wrong_result;
    }
  }
  return code;
}

int run(const Settings& settings) {
  std::ofstream file;
  const auto check_file = [&] {
    if (!settings.json.empty() && !file) throw std::runtime_error(settings.json.string() + ": cannot be written");
  };
  if (!settings.json.empty()) file.open(settings.json);  // before minutes are spent
  check_file();
  Json json = machine();
  json["quick"] = settings.quick;
  print_machine(json);
  const int code = measure(settings, json);
  if (file.is_open()) file << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n" << std::flush;
  check_file();
  return code;
}

int main(const std::vector<std::string>& arguments) {
  try {
    const auto settings = read_settings(arguments);
    return settings ? run(*settings) : 0;
  } catch (const UsageError& error) {
    complain(error.what());
    return wrong_usage;
  } catch (const SceneError& error) {
    complain(error.what());
    return wrong_usage;
  } catch (const std::exception& error) {
    complain(error.what());
    return input_output_error;
  }
}

}  // namespace
}  // namespace tyndall::bench

int main(int argc, char** argv) { return tyndall::bench::main({argv + (argc > 0 ? 1 : 0), argv + argc}); }
