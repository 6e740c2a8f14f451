#include "tests/bench/bench.h"
#include "tests/bench/measure.h"
#include "tests/bench/process.h"

namespace tyndall::bench {

namespace fs = std::filesystem;

Json measure_start(const Settings& settings) {
  const int repeat = settings.repeat > 0 ? settings.repeat : 11;
  Table table("Start: wall time of a whole process, median of " + std::to_string(repeat),
              {{"command", "command", -1, 60}, {"median_ms", "ms", 1, 6}, {"least_ms", "least", 1, 6}});
  const fs::path program = find_tyndall();
  if (program.empty()) {
    print_note("not measured: there is no program \"tyndall\" beside this one; build it first");
    return table.rows();
  }
  const ScratchFolder scratch;
  const std::vector<std::string> arguments = {"render", "cornell-box", "--spp", "1", "--size", "64x64", "-o"};
  std::vector<std::string> command = {program.string()};
  std::string shown = "tyndall";
  for (const std::string& word : arguments) command.push_back(word), shown += " " + word;
  command.push_back((scratch.path() / "x.png").string());
  std::vector<double> ms;
  for (int i = 0; i < repeat; ++i) {
    bool well = false;
    ms.push_back(1000 * seconds_of([&] { well = run_process(command); }));
    if (!well) throw WrongResult(shown + " x.png failed");
  }
  Json row;
  row["command"] = shown + " x.png";
  row["median_ms"] = median(ms), row["least_ms"] = quantile(ms, 0);
  row["ms"] = ms;
  table.add(row);
  return table.rows();
}

}  // namespace tyndall::bench
