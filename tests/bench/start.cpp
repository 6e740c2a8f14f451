#include "tests/bench/bench.h"
#include "tests/bench/measure.h"

#include <sys/wait.h>
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

namespace tyndall::bench {
namespace {

namespace fs = std::filesystem;

/// The program beside this one, or in the folder above; empty if there is none.
fs::path find_tyndall() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& file : {folder / "tyndall", folder.parent_path() / "tyndall"})
    if (fs::is_regular_file(file, error)) return file;
  return {};
}

/// Runs a program with its output thrown away and waits for it; answers whether it ended well.
bool run_process(std::vector<std::string> words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failed = posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failed == 0 && waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// A folder of our own that goes with its contents.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "tyndall_bench_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

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
  const std::vector<std::string> words = {"render", "cornell-box", "--spp", "1", "--size", "64x64", "-o"};
  std::vector<std::string> command = {program.string()};
  std::string shown = "tyndall";
  for (const std::string& word : words) command.push_back(word), shown += " " + word;
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
